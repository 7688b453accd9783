// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Recordings of a track as measuring cars write them, made from one known track, against that track.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/read_irregularities.hpp"
#include "treadmark/io/simulations/recording_names.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// The track [mm], x in m.
double wave(double amplitude, double length, double x) { return amplitude * std::sin(2.0 * kPi * x / length); }
double level(double x) { return wave(1.5, 9.2, x) + wave(0.7, 21.0, x); }
double cross(double x) { return wave(0.8, 9.0, x); }
double align(double x) { return wave(1.0, 17.0, x); }
double gauge(double x) { return 1.0 + wave(0.6, 21.0, x); }
const std::array<double (*)(double), kIrregularities> kDeviations{level, cross, align, gauge};

constexpr double kStep = 0.25;
constexpr int kRows = 401;

/// A line a row; x from 0 on by kStep.
std::string recording(const std::string& header, const std::function<std::string(int, double)>& row, int rows = kRows) {
  std::string text = header + '\n';
  for (int i = 0; i < rows; ++i) text += row(i, kStep * i) + '\n';
  return text;
}
std::string four(double distance, double x, double nominal = 0.0) {
  return fmt::format("{:.6f},{:.4f},{:.4f},{:.4f},{:.4f}", distance, level(x), cross(x), align(x), nominal + gauge(x));
}
const std::string kFour = "distance_m,longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm";

/// Largest deviation [mm] of a table from the track, whose x is that of the table less `from`.
double deviation(const IrregularityTable& table, double from, const std::vector<int>& functions = {0, 1, 2, 3}) {
  double most = 0.0;
  for (const int f : functions) {
    const auto& values = table.values[static_cast<std::size_t>(f)];
    if (values.size() != table.distance.size()) return kInfinity;
    for (std::size_t i = 0; i < values.size(); ++i)
      most = std::max(
          most, std::abs(values[i] * kMilli - kDeviations[static_cast<std::size_t>(f)](table.distance[i] - from)));
  }
  return most;
}
constexpr double kWritten = 6e-5;  // four decimals [mm]

struct Read {
  IrregularityTable table;
  std::vector<std::string> notes;
};
Read read(const std::string& text, const RecordingSettings& settings = {}) {
  Read result;
  result.table = parse_irregularity_text(text, "car.csv", &result.notes, settings);
  return result;
}
std::string error_of(const std::string& text, const RecordingSettings& settings = {}) {
  try {
    parse_irregularity_text(text, "car.csv", nullptr, settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    return error.what();
  }
  return "accepted";
}

TEST(Recording, FoundFilesAreTheSameTrack) {
  TREADMARK_REQUIRE_SHARED();
  const auto field = *shared / "found" / "field";
  if (!std::filesystem::exists(field)) GTEST_SKIP() << "no inputs of the field";
  std::vector<std::string> notes;
  const IrregularityTable plus = read_irregularity_file(field / "track_km_plus.csv");
  EXPECT_DOUBLE_EQ(plus.distance.front(), 44000.0);
  EXPECT_DOUBLE_EQ(plus.distance.back(), 44100.0);
  const std::pair<double, double> ranges[] = {{-2.0, 1.961}, {-0.8, 0.8}, {-1.0, 1.0}, {0.4, 1.6}};
  for (std::size_t f = 0; f < 4; ++f) {
    EXPECT_NEAR(*ranges::min_element(plus.values[f]) * kMilli, ranges[f].first, 1e-3);
    EXPECT_NEAR(*ranges::max_element(plus.values[f]) * kMilli, ranges[f].second, 1e-3);
  }
  constexpr double kDecimals = 1e-6;  // three of mm
  for (const char* name : {"track_gauge_abs.csv", "track_trc.csv", "track_six.csv", "track_km_dec.csv"}) {
    const IrregularityTable table = read_irregularity_file(field / name, &notes);
    const bool falling = std::string(name) == "track_km_dec.csv", six = std::string(name) == "track_six.csv";
    ASSERT_EQ(table.distance.size(), plus.distance.size()) << name;
    for (std::size_t i = 0; i < table.distance.size(); ++i) {
      EXPECT_NEAR(table.distance[i] - table.distance[0], kStep * static_cast<double>(i), 1e-6) << name;
      const std::size_t k = falling ? table.distance.size() - 1 - i : i;
      for (std::size_t f = 0; f < 4; ++f) {
        // Of its six columns the alignment of the left rail is that of the other files.
        const double turned = six && f == 2 ? 0.5 * (plus.values[3][k] - 1e-3) : 0.0;
        ASSERT_NEAR(table.values[f][i], plus.values[f][k] + turned, kDecimals) << name << ' ' << f << ' ' << i;
      }
    }
  }
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("track_gauge_abs.csv"), HasSubstr("what lies beyond 1435 mm"))));
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("track_trc.csv"), HasSubstr("what lies beyond 1676 mm"))));
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("track_six.csv"), HasSubstr("cross_level stands beside"))));
  EXPECT_THAT(notes, Contains(AllOf(HasSubstr("track_km_dec.csv"), HasSubstr("the distances fall"))));
}

/// Both rails, cross level and gauge by other names.
struct Names {
  std::string header;
  char separator = ',';
  bool comma = false;
  double unit = 1.0;  ///< of the numbers [mm]
};
class RecordingNames : public ::testing::TestWithParam<Names> {};
TEST_P(RecordingNames, AreRead) {
  const Names& p = GetParam();
  const Read found = read(recording(p.header, [&](int, double x) {
    const double lateral = align(x), apart = gauge(x);
    std::string row = fmt::format("{:.5f}", 44.0 + x / 1000.0);
    for (const double value : {level(x) - 0.5 * cross(x), level(x) + 0.5 * cross(x), lateral - 0.5 * apart,
                               lateral + 0.5 * apart, cross(x), 1435.0 + apart})
      row += fmt::format("{}{:.4f}", p.separator, value / p.unit);
    if (p.comma) ranges::replace(row, '.', ',');
    return row;
  }));
  EXPECT_LT(deviation(found.table, 44000.0), 2.0 * kWritten) << p.header;
  EXPECT_THAT(found.notes,
              Contains(HasSubstr("cross_level stands beside longitudinal_level of both rails and agrees")));
  EXPECT_THAT(found.notes, Contains(HasSubstr("gauge stands beside alignment of both rails and agrees")));
  EXPECT_THAT(found.notes, Not(Contains(HasSubstr("warning"))));
}
INSTANTIATE_TEST_SUITE_P(
    All, RecordingNames,
    ::testing::Values(
        Names{"distance_km,longitudinal_level_left_mm,longitudinal_level_right_mm,alignment_left_mm,"
              "alignment_right_mm,cross_level_mm,gauge_mm"},
        Names{"km;LL_L [mm];LL_R [mm];AL_L [mm];AL_R [mm];CL [mm];TG [mm]", ';'},
        Names{"Kilometer;L\u00e4ngsh\u00f6he links [mm];L\u00e4ngsh\u00f6he rechts [mm];Ausrichtung links "
              "[mm];Ausrichtung rechts "
              "[mm];\u00dcberh\u00f6hung [mm];Spurweite [mm]",
              ';', true},
        Names{"\"Chainage [km]\",\"Longitudinal level left (mm)\",\"Longitudinal level right (mm)\",\"Alignment left "
              "(mm)\",\"Alignment right (mm)\",\"Cross level (mm)\",\"Track gauge (mm)\""},
        Names{
            "KM\tLEFT_PROFILE_MM\tRIGHT_PROFILE_MM\tLEFT_ALIGNMENT_MM\tRIGHT_ALIGNMENT_MM\tSUPERELEVATION_MM\tGAGE_MM",
            '\t'},
        Names{"Km,TopLeftMm,TopRightMm,AlignLeftMm,AlignRightMm,CrossLevelMm,GaugeMm"},
        Names{"KM,UNL_MM,UNR_MM,ALL_MM,ALR_MM,XLVL_MM,GA_MM"},
        Names{
            "\u91cc\u7a0b,\u5de6\u9ad8\u4f4e(mm),\u53f3\u9ad8\u4f4e(mm),\u5de6\u8f68\u5411(mm),\u53f3\u8f68\u5411(mm),"
            "\u6c34\u5e73(mm),\u8f68\u8ddd(mm)"},
        Names{"PK [km];Nivellement longitudinal gauche [mm];Nivellement longitudinal droite [mm];Dressage gauche "
              "[mm];Dressage droite [mm];D\u00e9vers [mm];\u00c9cartement [mm]",
              ';', true},
        Names{"mileage_km,L_Prof_SC_70_mm,R_Prof_SC_70_mm,L_Align_SC_70_mm,R_Align_SC_70_mm,Crosslevel_mm,Gauge_mm"},
        Names{"km;LLL [1/100 mm];LLR [1/100 mm];ALL [1/100 mm];ALR [1/100 mm];CL [1/100 mm];G [1/100 mm]", ';', false,
              0.01},
        Names{"km|LL left (\u00b5m)|LL right (\u00b5m)|AL left (\u00b5m)|AL right (\u00b5m)|CL (\u00b5m)|G (\u00b5m)",
              '|', false, 1e-3},
        Names{"distance [km];Level;;Alignment;;Cross level;Gauge\n;left [mm];right [mm];left [mm];right [mm];[mm];[mm]",
              ';'},
        Names{"Kilometer LL-L[mm] LL-R[mm] AL-L[mm] AL-R[mm] CL[mm] GAUGE[mm]", ' '},
        Names{"Measuring run of line 12\nVehicle;7\n\nkm;LL left;LL right;AL left;AL "
              "right;CL;Gauge\n[km];[mm];[mm];[mm];[mm];"
              "[mm];[mm]",
              ';', true},
        Names{"km;LL left;LL right;AL left;AL right;CL;Gauge", ';'}));

TEST(Recording, WordsThatAreNotKnownMakeNoColumn) {
  for (const char* name :
       {"TWIST_MM", "Twist 3m [mm]", "gauge change [mm]", "SD_LL_mm", "speed", "TGI", "LL_10m_chord_mm", "LL std [mm]",
        "gauge_left_mm", "L_L", "alignment [1/m]", "curvature", "cross level rate", "Left profile 62 [in]",
        "peak gauge", "level alignment", "LL left right", "D4 LL", "date"})
    EXPECT_FALSE(recorded_column(name)) << name;
  EXPECT_EQ(recorded_unit("1/100 mm"), 1e-5);
  EXPECT_EQ(recorded_unit("(0,01mm)"), 1e-5);
  EXPECT_EQ(recorded_unit("\u03bcm"), 1e-6);
  EXPECT_EQ(recorded_unit("mm/m"), 0.0);
  EXPECT_EQ(recorded_column("LL_\u00b5m")->unit, 1e-6);
  EXPECT_EQ(recorded_column("gauge (1435) [mm]")->nominal, 1435.0);
  EXPECT_EQ(recorded_column("LL_D2_L [mm]")->band, 2);
  EXPECT_EQ(recorded_column("LL 25-70 m left [mm]")->band, 2);
  EXPECT_EQ(recorded_column("Top 35m left [mm]")->longest, 35);
}

TEST(Recording, Encodings) {
  const std::string text = recording(
      "Kilometer;L\u00e4ngsh\u00f6he [mm];Querh\u00f6he [mm];Richtung [mm];Spurweite [mm]", [](int, double x) {
        std::string row = fmt::format("{:.5f};{:.4f};{:.4f};{:.4f};{:.4f}", x / 1000.0, level(x), cross(x), align(x),
                                      1435.0 + gauge(x));
        ranges::replace(row, '.', ',');
        return row;
      });
  std::string little = "\xFF\xFE", big = "\xFE\xFF", latin, minus = text;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned code = static_cast<unsigned char>(text[i]);
    if (code >= 0xC0) code = (code & 0x1Fu) << 6 | (static_cast<unsigned char>(text[++i]) & 0x3Fu);
    latin += static_cast<char>(code);
    little += {static_cast<char>(code), '\0'};
    big += {'\0', static_cast<char>(code)};
  }
  for (std::size_t at = minus.find('-'); at != std::string::npos; at = minus.find('-')) minus.replace(at, 1, "\u2212");
  for (const std::string& one : {text, "\xEF\xBB\xBF" + text, little, big, latin, minus})
    EXPECT_LT(deviation(read(one).table, 0.0), kWritten);
}

TEST(Recording, KilometresInManyForms) {
  const auto written = [](const char* header, const std::function<std::string(double)>& distance) {
    return read(recording(std::string(header) + ",longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm",
                          [&](int, double x) { return distance(x) + four(0.0, x).substr(8); }));
  };
  EXPECT_LT(deviation(written("Chainage", [](double x) { return fmt::format("44+{:07.3f}", x); }).table, 44e3),
            kWritten);
  EXPECT_LT(deviation(written("km", [](double x) { return fmt::format("km 44 + {:.2f}", x); }).table, 44e3), kWritten);
  EXPECT_LT(deviation(written("PK", [](double x) { return fmt::format("K44+{:.2f}", x); }).table, 44e3), kWritten);
  EXPECT_LT(deviation(written("KM,METER", [](double x) { return fmt::format("44,{:.2f}", x); }).table, 44e3), kWritten);
  EXPECT_LT(deviation(written("position", [](double x) { return fmt::format("{:.2f}", x); }).table, 0.0), kWritten);
  EXPECT_LT(deviation(written("position", [](double x) { return fmt::format("{:.5f}", x / 1e3); }).table, 0.0),
            kWritten);
  // to whole metres, and to tenths
  const Read coarse = written("km", [](double x) { return fmt::format("{:.3f}", std::floor(x) / 1e3); });
  EXPECT_THAT(coarse.notes, Contains(HasSubstr("evenly 0.25 m apart")));
  EXPECT_LT(deviation(coarse.table, coarse.table.distance.front()), kWritten);
  EXPECT_NEAR(coarse.table.distance.front(), -0.375, 0.1);
  const Read tenths = written("km", [](double x) { return fmt::format("{:.4f}", (x + 0.01) / 1e3); });
  EXPECT_LT(deviation(tenths.table, tenths.table.distance.front()), kWritten);
}

TEST(Recording, FallingKilometresAreTheSameTrack) {
  const std::string text = recording(kFour, [](int, double x) { return four(100.0 - x, 100.0 - x); });
  const Read found = read(text);
  EXPECT_LT(deviation(found.table, 0.0), kWritten);
  EXPECT_THAT(found.notes, Contains(HasSubstr("as seen along rising distances")));
  // As the car saw it: the track turned about z, of which right is left.
  RecordingSettings settings;
  settings.seen_backwards = true;
  const Read turned = read(text, settings);
  for (std::size_t i = 0; i < turned.table.distance.size(); ++i) {
    EXPECT_EQ(turned.table.values[0][i], found.table.values[0][i]);
    EXPECT_EQ(turned.table.values[1][i], -found.table.values[1][i]);
    EXPECT_EQ(turned.table.values[2][i], -found.table.values[2][i]);
    EXPECT_EQ(turned.table.values[3][i], found.table.values[3][i]);
  }
}

/// Chainage that jumps at row 200 while the track goes on.
class BrokenChain : public ::testing::TestWithParam<double> {};
TEST_P(BrokenChain, RowsAreCountedOn) {
  const double by = GetParam();
  for (const bool falling : {false, true}) {
    std::string text = kFour + '\n';
    for (int k = 0; k < kRows; ++k) {
      const int i = falling ? kRows - 1 - k : k;
      text += four(1000.0 + kStep * i + (i >= 200 ? by : 0.0), kStep * i) + '\n';
    }
    const Read found = read(text);
    EXPECT_LT(deviation(found.table, 1000.0), kWritten) << by;
    EXPECT_THAT(found.notes, Contains(HasSubstr("a broken chain"))) << by;
    EXPECT_EQ(found.table.distance.size(), static_cast<std::size_t>(kRows));
  }
}
INSTANTIATE_TEST_SUITE_P(All, BrokenChain, ::testing::Values(-0.25, -0.2, -3.0, -17.0, -400.0, 0.85, 3.0, 21.0, 500.0));

TEST(Recording, MissingRowsAreSaid) {
  const auto without = [](int from, int to) {
    std::string text = kFour + '\n';
    for (int i = 0; i < kRows; ++i)
      if (i < from || i >= to) text += four(kStep * i, kStep * i) + '\n';
    return text;
  };
  const Read found = read(without(201, 205));
  EXPECT_LT(deviation(found.table, 0.0), kWritten);
  EXPECT_EQ(found.table.distance.size(), static_cast<std::size_t>(kRows - 4));
  EXPECT_THAT(found.notes, Contains(HasSubstr("rows are missing in 1 place, at most over 1.25 m at 50 m")));
  EXPECT_THAT(error_of(without(201, 241)), AllOf(HasSubstr("car.csv:203:1: rows are missing over 10.25 m, from 50 to"),
                                                 HasSubstr("irregularities.sampling_m")));
  RecordingSettings settings;
  settings.as_stated = true;
  EXPECT_LT(deviation(read(without(201, 241), settings).table, 0.0), kWritten);
}

TEST(Recording, RowsRecordedTwiceAreLeftOut) {
  std::string twice = kFour + '\n', again = twice;
  for (int i = 0; i < kRows; ++i) {
    twice += four(kStep * i, kStep * i) + '\n';
    if (i == 170) twice += four(kStep * i, kStep * i) + '\n';
    again += four(kStep * i, kStep * i) + '\n';
    if (i == 200)  // the car goes back and starts again
      for (int k = 150; k <= 200; ++k) again += four(kStep * k, kStep * k) + '\n';
  }
  for (const std::string& text : {twice, again}) {
    const Read found = read(text);
    EXPECT_LT(deviation(found.table, 0.0), kWritten);
    EXPECT_EQ(found.table.distance.size(), static_cast<std::size_t>(kRows));
    EXPECT_THAT(found.notes, Contains(HasSubstr("rows recorded twice, left out: ")));
  }
}

TEST(Recording, ARowASamplingIsTakenAsGiven) {
  RecordingSettings settings;
  settings.sampling = kStep;
  const auto nonsense = [](int i, double x) { return four(static_cast<double>((i * 7919) % 401) + 3.0 * i, x); };
  EXPECT_THAT(error_of(recording(kFour, nonsense)), AllOf(HasSubstr("it must increase"), HasSubstr("sampling_m")));
  EXPECT_LT(deviation(read(recording(kFour, nonsense), settings).table, 0.0), kWritten);
}

TEST(Recording, CellsWithoutAValue) {
  for (const std::string mark : {"", "N/A", "NaN", "-9999", "-9999.00", "---", "1.#QNAN", "-32768", "#N/A"}) {
    const auto row = [&](int i, double x) {
      const bool none = (i >= 100 && i < 103) || i < 2 || i == kRows - 1;
      return fmt::format("{:.2f},{},{:.4f},{:.4f},{:.4f}", x, none ? mark : fmt::format("{:.4f}", level(x)), cross(x),
                         align(x), i == 300 ? 0.0 : 1435.0 + gauge(x));
    };
    const Read found = read(recording(kFour, row));
    EXPECT_LT(deviation(found.table, 0.0, {1, 2, 3}), 4e-3) << mark;  // (pi 0.5 m / 21 m)^4 ... of one cell
    EXPECT_LT(deviation(found.table, 0.0, {0}), 0.03) << mark;
    EXPECT_EQ(found.table.distance.size(), static_cast<std::size_t>(kRows - 3)) << mark;
    EXPECT_THAT(found.notes,
                Contains(HasSubstr("cells without a value, bridged by smooth curves: 4, the longest way 1 m")))
        << mark;
    EXPECT_THAT(found.notes, Contains(HasSubstr("rows without all values at the ends, left out: 3"))) << mark;
  }
  EXPECT_THAT(error_of(recording(kFour,
                                 [](int i, double x) {
                                   std::string text = four(x, x);
                                   return i >= 100 && i < 130 ? text.substr(0, text.find(',')) + ",N/A,0,0,1" : text;
                                 })),
              HasSubstr("car.csv:102:1: longitudinal_level_mm has no value over 7.75 m, from 24.75 to 32.5 m"));
}

TEST(Recording, NominalGauges) {
  const auto with = [](double nominal, const std::string& before = {}, const RecordingSettings& settings = {}) {
    return read(before + recording(kFour, [&](int, double x) { return four(x, x, nominal); }), settings);
  };
  for (const double nominal : {1000.0, 1067.0, 1435.0, 1520.0, 1600.0, 1668.0, 1676.0}) {
    const Read found = with(nominal);
    EXPECT_LT(deviation(found.table, 0.0), kWritten) << nominal;
    EXPECT_THAT(found.notes, Contains(HasSubstr(fmt::format("what lies beyond {:g} mm", nominal)))) << nominal;
  }
  EXPECT_LT(deviation(with(1432.0, "# Nominal gauge: 1432 mm\n").table, 0.0), kWritten);
  EXPECT_LT(deviation(with(1432.0, "Spurweite;1432 mm\n").table, 0.0), kWritten);
  RecordingSettings settings;
  settings.track_gauge = 1.432;
  EXPECT_LT(deviation(with(1432.0, {}, settings).table, 0.0), kWritten);
  EXPECT_THAT(with(1676.0, {}, settings).notes,
              Contains(HasSubstr("a recording of a track of 1676 mm, used on one of 1432")));
  settings.nominal_gauge = 1.440;
  EXPECT_LT(deviation(with(1440.0, {}, settings).table, 0.0), kWritten);
  EXPECT_THAT(error_of(recording(kFour, [](int, double x) { return four(x, x, 1250.0); })),
              HasSubstr("the gauge is about 1251.04 mm, its nominal value 1372 mm"));
  EXPECT_THAT(error_of(recording(kFour, [](int i, double x) { return four(x, x, i == 7 ? 1335.0 - 5.0 : 1435.0); })),
              HasSubstr("car.csv:9:"));
}

TEST(Recording, ContradictionsOfTheRailsAreSaid) {
  const auto rails = [](double level_sign, double lateral_sign, bool exchanged) {
    return read(recording("distance_m,LL_L_mm,LL_R_mm,AL_L_mm,AL_R_mm,CL_mm,gauge_mm", [=](int, double x) {
      double l = level_sign * (level(x) - 0.5 * cross(x)), r = level_sign * (level(x) + 0.5 * cross(x)),
             al = lateral_sign * (align(x) - 0.5 * gauge(x)), ar = lateral_sign * (align(x) + 0.5 * gauge(x));
      if (exchanged) std::swap(l, r), std::swap(al, ar);
      return fmt::format("{:.2f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}", x, l, r, al, ar, cross(x), gauge(x));
    }));
  };
  EXPECT_THAT(rails(1.0, 1.0, false).notes, Not(Contains(HasSubstr("warning"))));
  EXPECT_THAT(rails(-1.0, 1.0, false).notes,
              Contains(AllOf(HasSubstr("warning: longitudinal_level and cross_level have opposite signs"),
                             HasSubstr("longitudinal_level_factor = -1 or cross_level_factor = -1"))));
  EXPECT_THAT(rails(1.0, -1.0, false).notes,
              Contains(AllOf(HasSubstr("warning: alignment and gauge have opposite signs"),
                             HasSubstr("alignment_factor = -1"))));
  const Read exchanged = rails(1.0, 1.0, true);
  EXPECT_LT(deviation(exchanged.table, 0.0), 2.0 * kWritten);
  EXPECT_THAT(exchanged.notes, Contains(HasSubstr("left and right seem to be exchanged")));
  // A cross level of another track, and a mean level that is none.
  EXPECT_THAT(read(recording("distance_m,LL_L_mm,LL_R_mm,CL_mm",
                             [](int, double x) {
                               return fmt::format("{:.2f},{:.4f},{:.4f},{:.4f}", x, level(x), level(x) + cross(x),
                                                  wave(1.0, 5.0, x));
                             }))
                  .notes,
              Contains(HasSubstr("warning: cross_level does not follow from longitudinal_level")));
  EXPECT_THAT(read(recording("distance_m,LL_L_mm,LL_R_mm,level_mm",
                             [](int, double x) {
                               return fmt::format("{:.2f},{:.4f},{:.4f},{:.4f}", x, level(x), level(x) + cross(x),
                                                  wave(1.0, 5.0, x));
                             }))
                  .notes,
              Contains(HasSubstr("warning: longitudinal_level of the track is not the mean of its rails")));
}

TEST(Recording, BandsOfWavelengths) {
  const Read added = read(recording("distance_m,LL D1 [mm],LL D2 [mm],LL D0 [mm]", [](int, double x) {
    return fmt::format("{:.2f},{:.4f},{:.4f},9.0", x, wave(1.5, 9.2, x), level(x) - wave(1.5, 9.2, x));
  }));
  EXPECT_LT(deviation(added.table, 0.0, {0}), 2.0 * kWritten);
  EXPECT_THAT(added.notes, Contains(HasSubstr("bands of wavelengths that follow each other: added")));
  EXPECT_THAT(added.notes, Contains(HasSubstr("'LL D0 [mm]' is not used")));
  const Read longest = read(recording("distance_m,Top 35m [mm],Top 70m [mm]",
                                      [](int, double x) { return fmt::format("{:.2f},9,{:.4f}", x, level(x)); }));
  EXPECT_LT(deviation(longest.table, 0.0, {0}), kWritten);
}

TEST(Recording, UnitsAreNeverGuessedSilently) {
  const auto text = [](const std::string& header, double nominal) {
    return recording(header, [=](int, double x) { return four(x, x, nominal); });
  };
  EXPECT_THAT(error_of(text("distance_m,LL,CL,AL,gauge", 0.0)),
              HasSubstr("car.csv:1:12: the column LL has no unit (call it longitudinal_level_mm, or write the unit"));
  EXPECT_THAT(read(text("distance_m,LL,CL,AL,gauge", 1435.0)).notes,
              Contains(HasSubstr("no units are stated; the gauge shows that they are 1 mm")));
  EXPECT_LT(deviation(read("# all values in mm\n" + text("distance_m,LL,CL,AL,gauge", 0.0)).table, 0.0), kWritten);
  EXPECT_THAT(error_of(text("weight,LL_mm,CL_mm,AL_mm,gauge_mm", 0.0)), HasSubstr("no column holds the distance"));
}

TEST(Recording, TheCantOfCurvesIsSaid) {
  EXPECT_THAT(read(recording("distance_m,cant_mm,cross level_mm",
                             [](int, double x) { return fmt::format("{:.2f},150,{:.4f}", x, cross(x)); }))
                  .notes,
              Contains(HasSubstr("'cant_mm' is not used, as another column holds the cross level")));
  EXPECT_THAT(read(recording("distance_m,cant_mm",
                             [](int, double x) { return fmt::format("{:.2f},{:.4f}", x, 150.0 + cross(x)); }))
                  .notes,
              Contains(HasSubstr("it seems to hold the cant of curves")));
}

TEST(Recording, WordsAreDocumented) { treadmark::testing::expect_in_document("layout.md", recording_names_table()); }

}  // namespace
}  // namespace treadmark::io
