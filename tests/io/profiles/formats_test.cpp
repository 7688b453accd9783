// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "samples.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::parse;
using testing::Point;
using testing::rail_points;
using testing::TemporaryFolder;
using testing::wheel_points;

/// The rail sample as lines of text: y, separator, z, with this decimal sign.
std::string lines(char separator, char decimal, const std::string& end = "\n") {
  std::string text;
  for (const Point& p : rail_points()) {
    std::string y = std::to_string(p.y), z = std::to_string(p.z);
    std::replace(y.begin(), y.end(), '.', decimal);
    std::replace(z.begin(), z.end(), '.', decimal);
    text += y + separator + z + end;
  }
  return text;
}

std::string quoted(const std::string& text, char separator) {
  std::string out = "\"";
  for (const char c : text)
    if (c == separator)
      out += std::string("\"") + c + '"';
    else if (c == '\n')
      out += "\"\n\"";
    else
      out += c;
  return out.substr(0, out.size() - 1);
}

std::string utf16(const std::string& text, bool big, bool mark) {
  std::string out;
  const auto put = [&](char high, char low) { out += big ? high : low, out += big ? low : high; };
  if (mark) put('\xFE', '\xFF');
  for (const char c : text) put('\0', c);
  return out;
}

TEST(ProfileText, EveryWayToWriteTwoColumnsGivesTheSamePoints) {
  const Profile expected = parse(columns(rail_points()), Body::rail);
  const std::string plain = lines(' ', '.');
  const std::vector<std::pair<const char*, std::string>> texts = {
      {"comma", lines(',', '.')},
      {"semicolon", lines(';', '.')},
      {"tab", lines('\t', '.')},
      {"decimal comma, semicolon", lines(';', ',')},
      {"decimal comma, blank", lines(' ', ',')},
      {"decimal comma, tab", lines('\t', ',')},
      {"quotes", quoted(lines(',', '.'), ',')},
      {"quotes, decimal comma", quoted(lines(';', ','), ';')},
      {"CR LF", lines(' ', '.', "\r\n")},
      {"CR", lines(' ', '.', "\r")},
      {"UTF-8 with mark", "\xEF\xBB\xBF" + plain},
      {"UTF-16 little", utf16(plain, false, true)},
      {"UTF-16 big", utf16(plain, true, true)},
      {"UTF-16 little without mark", utf16(plain, false, false)},
      {"UTF-16 big without mark", utf16(plain, true, false)},
      {"names", "y,z\n" + lines(',', '.')},
      {"names in quotes", "\"y\",\"z\"\n" + lines(',', '.')},
      {"names with units", "y [mm];z [mm]\n" + lines(';', ',')},
      {"names as a comment", "# y z\n" + plain},
      {"x and y", "X Y\n" + plain},
      {"a title", "Profile 7, left of the points\n" + plain},
      {"comments", "// a\n! b\n% c\n# d\n; e\n" + plain + "// end\n"},
      {"comments behind", "% x\n" + lines(' ', '.', " // e\n")},
      {"empty lines", "\n\n" + plain + "\n\n"},
  };
  for (const auto& [name, text] : texts) {
    SCOPED_TRACE(name);
    Profile p;
    ASSERT_NO_THROW(p = parse(text, Body::rail));
    EXPECT_EQ(p.y, expected.y);
    EXPECT_EQ(p.z, expected.z);
  }
}

TEST(ProfileText, ColumnsGoByTheirNames) {
  const Profile expected = parse(columns(rail_points()), Body::rail);
  std::string numbered = "n;z;y\n", three = "x y z\n";
  int n = 0;
  for (const Point& p : rail_points()) {
    numbered += std::to_string(++n) + ";" + std::to_string(p.z) + ";" + std::to_string(p.y) + "\n";
    three += "12.5 " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  EXPECT_EQ(parse(numbered, Body::rail).z, expected.z);
  EXPECT_EQ(parse("n,y,z\n1,-10,1\n2,0,0\n3,10,1\n", Body::rail).y.size(), 3u);  // whole numbers
  EXPECT_EQ(parse(three, Body::rail).y, expected.y);
}

TEST(ProfileText, AUnitInTheFileCountsWhereNoScaleIsAskedFor) {
  std::string metres = "y [m],z [m]\n", inches = "# unit: inch\n";
  for (const Point& p : rail_points()) {
    metres += std::to_string(1e-3 * p.y) + "," + std::to_string(1e-3 * p.z) + "\n";
    inches += std::to_string(p.y / 25.4) + " " + std::to_string(p.z / 25.4) + "\n";
  }
  constexpr double kSixDecimals = 1e-6;  // m; a millionth of an inch is less
  EXPECT_NEAR(parse(metres, Body::rail).y.front(), -0.036, kSixDecimals);
  EXPECT_NEAR(parse(inches, Body::rail).y.front(), -0.036, kSixDecimals);
  ProfileOptions options;
  options.scale = 1000.0;
  EXPECT_NEAR(parse(metres, Body::rail, options).y.front(), -0.036, kSixDecimals);
}

TEST(ProfileText, RefusesWhatMayMeanTwoThings) {
  TREADMARK_EXPECT_ERROR(parse("-10,5,1,5\n0,0,0,0\n10,5,1,5\n", Body::rail), "the commas may separate numbers", 1, 1);
  TREADMARK_EXPECT_ERROR(parse("-10 1\n0 0\ny,z\n10 1\n", Body::rail), "keep one in a file", 3, 1);
  TREADMARK_EXPECT_ERROR(parse("y,y,z\n1,2,3\n", Body::rail), "named twice", 1, 1);
  TREADMARK_EXPECT_ERROR(parse("y [mm],z [m]\n1,2\n", Body::rail), "different units", 1, 1);
  TREADMARK_EXPECT_ERROR(parse("only words\n", Body::rail), "numbers are expected", 1, 1);
  TREADMARK_EXPECT_ERROR(parse("VAMPIRE wheel profile\n-10 1\n0 0\n10 1\n", Body::rail), "VAMPIRE", 1, 1);
  TREADMARK_EXPECT_ERROR(parse("1x0 2\n-10 1\n0 0\n10 1\n", Body::rail), "this is '1x0'", 1, 1);
  TREADMARK_EXPECT_ERROR(parse("-10 1.#QNAX\n0 0\n10 1\n", Body::rail), "1.#QNAX", 1, 5);
}

TEST(ProfileText, AColumnThatCountsIsNoPosition) {
  std::string few, many;
  for (int i = 0; i < 37; ++i) {
    const Point p = rail_points()[static_cast<std::size_t>(i)];
    few += std::to_string(i + 1) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  }
  TREADMARK_EXPECT_ERROR(parse(few, Body::rail), "counts the points (1, 2, 3 ...)", 1, 1);
  for (int i = 0; i <= 400; ++i) {
    const double y = 0.18 * (i - 200);
    many += std::to_string(i) + " " + std::to_string(y) + " " + std::to_string(y * y / 150.0) + "\n";
  }
  EXPECT_NEAR(parse(many, Body::rail).y.front(), -0.036, 1e-9);  // no profile is 400 mm wide
  std::string heights;
  for (int i = 0; i <= 400; ++i) heights += std::to_string(i) + " " + std::to_string(0.01 * i * i / 400) + "\n";
  TREADMARK_EXPECT_ERROR(parse(heights, Body::rail), "counts the points", 1, 1);
  // every millimetre, with weights
  std::string weighted;
  for (int i = 0; i <= 36; ++i) weighted += std::to_string(i) + " " + std::to_string(i * i / 100.0) + " 1\n";
  EXPECT_EQ(parse(weighted, Body::rail).y.size(), 37u);
}

struct Header {
  const char* name;
  const char* text;
};

class MiniProfHeader : public ::testing::TestWithParam<Header> {};

INSTANTIATE_TEST_SUITE_P(
    All, MiniProfHeader,
    ::testing::Values(
        Header{"Of1994",
               "MINIPROF 101 148 1994 3 24\navg.prd\nStock.......: \nCar Number..:\n32.58 37.11 14.71  (Sd/Sh/qR)\n\n"},
        Header{"Of2020", "#MINIWHEELPROF\nCar7.whl\nMINIPROF 2020\nStock.......:\n32.58 37.11 14.71\n(Sd/Sh/qR)\n\n"},
        Header{"KeyAndValue", "ProgramName=MiniProf\nXYPoints=65\nDiameterTaperline=920\nColumnDef=X,Y\n\n"},
        Header{"NoHeader", ""},
        Header{"Sections",
               "[FileInfo]\nProgramName=MiniProf\n\n[Profile1Info]\nColumnDef=X,Y\nXYPoints=65\n\n[Profile1Points]\n"}),
    [](const auto& which) { return std::string(which.param.name); });

TEST_P(MiniProfHeader, TheSamePointsFollow) {
  const Profile expected = parse(columns(wheel_points()), Body::wheel);
  for (const std::string end : {"\n", "\r\n"}) {
    std::string text;
    for (const char c : GetParam().text + columns(wheel_points()))
      if (c == '\n')
        text += end;
      else
        text += c;
    const Profile p = parse(text, Body::wheel, {}, ProfileFormat::miniprof);
    EXPECT_EQ(p.y, expected.y);
    EXPECT_EQ(p.z, expected.z);
  }
}

TEST(MiniProf, FilesAreKnownByWhatTheySay) {
  const TemporaryFolder folder;
  const std::string text = columns(wheel_points());
  const SourcedProfile p =
      read_sourced_profile(folder.write(
                               "a.txt",
                               "Date=1/2/2003\nDiameterTaperline=921.5\nGauge=1435\nSide=Left\nSuperElevation=0\n"
                               "ColumnDef=X,Y,A,C,N,K\n\n" +
                                   [&] {
                                     std::string more;
                                     for (const Point& q : wheel_points())
                                       more += std::to_string(q.y) + " " + std::to_string(q.z) + " 0.1 0 1 0\n";
                                     return more;
                                   }()),
                           Body::wheel, {});
  EXPECT_EQ(p.profile.y, parse(text, Body::wheel).y);
  ASSERT_TRUE(p.source.nominal_radius);
  EXPECT_NEAR(*p.source.nominal_radius, 0.46075, 1e-12);
  std::string notes;
  for (const std::string& note : p.source.notes) notes += note + "\n";
  EXPECT_NE(notes.find("Gauge=1435 is not used: set track.gauge_mm"), std::string::npos) << notes;
  EXPECT_NE(notes.find("Side=Left"), std::string::npos) << notes;
  EXPECT_EQ(notes.find("SuperElevation"), std::string::npos) << notes;  // 0 says nothing
  EXPECT_NE(notes.find("columns not used: A, C, N, K"), std::string::npos) << notes;
}

std::string two_sections(const std::string& first_program, const std::string& second_program) {
  auto other = wheel_points();
  for (Point& p : other) p.z += 1.0;
  return "[FileInfo]\nProgramName=MiniProf\n\n[Profile1Info]\nProgramName=" + first_program + "\n\n[Profile1Points]\n" +
         columns(other) + "\n[Profile2Info]\nProgramName=" + second_program + "\nColumnDef=X,Y\n\n[Profile2Points]\n" +
         columns(wheel_points());
}

TEST(MiniProf, OfSeveralProfilesTheMeasuredOneCounts) {
  const TemporaryFolder folder;
  const Profile expected = parse(columns(wheel_points()), Body::wheel);
  const SourcedProfile p =
      read_sourced_profile(folder.write("a.mpt", two_sections("AutoCAD", "MiniProf for Windows")), Body::wheel, {});
  EXPECT_EQ(p.profile.z, expected.z);
  ASSERT_FALSE(p.source.notes.empty());
  EXPECT_NE(p.source.notes.back().find("the measured one: 2"), std::string::npos) << p.source.notes.back();

  const auto file = folder.write("b.mpt", two_sections("AutoCAD", "AutoCAD"));
  TREADMARK_EXPECT_ERROR(read_profile(file, Body::wheel, {}), "several profiles: 1 (65 points, drawn with AutoCAD)", 0,
                         0);
  TREADMARK_EXPECT_ERROR(read_profile(file, Body::wheel, {}), "put its number behind the name: 'b.mpt#1' to '#2'", 0,
                         0);
  EXPECT_EQ(read_profile(file.string() + "#2", Body::wheel, {}).z, expected.z);
  EXPECT_NE(read_profile(file.string() + "#1", Body::wheel, {}).z, expected.z);
  TREADMARK_EXPECT_ERROR(read_profile(file.string() + "#3", Body::wheel, {}), "there is no profile 3", 0, 0);
}

TEST(MiniProf, RefusesTheOtherBodyAndAHeaderWithoutEnd) {
  const auto read = [](const std::string& text, Body body) { return parse(text, body, {}, ProfileFormat::miniprof); };
  const std::string points = columns(wheel_points());
  TREADMARK_EXPECT_ERROR(read("#MINIRAILPROF\nMINIPROF 2020\n\n" + points, Body::wheel), "this is a rail profile", 1,
                         1);
  TREADMARK_EXPECT_ERROR(read("#MINIWHEELPROF\nMINIPROF 2020\n1 2 3\n", Body::wheel), "the header does not end", 3, 0);
  TREADMARK_EXPECT_ERROR(read("[FileInfo]\n1 2\n", Body::wheel), "numbers before a section", 2, 1);
  TREADMARK_EXPECT_ERROR(read("DiameterTaperline=-920\n\n" + points, Body::wheel), "must be positive", 1, 19);
}

TEST(Gensys, WheelsPointToTheMiddleOfTheTrack) {
  const TemporaryFolder folder;
  auto points = wheel_points();
  for (Point& p : points) p.y = -p.y;
  const Profile expected = parse(columns(wheel_points()), Body::wheel);
  const Profile p = read_profile(folder.write("a.wheel", "# GENSYS\n" + columns(points)), Body::wheel, {});
  EXPECT_EQ(p.y, expected.y);
  EXPECT_EQ(p.z, expected.z);
  try {
    read_profile(folder.write("a.rail", columns(rail_points())), Body::rail, {});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("rename it to .txt"), std::string::npos) << error.what();
  }
}

TEST(Simpack, IsKnownByItsFirstLine) {
  const std::string text = testing::simpack(Body::rail, rail_points());
  EXPECT_EQ(parse(text, Body::rail).y, parse(text, Body::rail, {}, ProfileFormat::simpack).y);
}

/// What becomes of each real file: points and ends in mm, or words of the refusal.
struct Outcome {
  const char* file;
  Body body;
  std::size_t points;
  double y_low, y_high, z;  ///< z down, of the tip of the flange or the top of the rail
  const char* refusal;
};

TEST(RealFieldProfiles, AreReadOrRefusedAsStated) {
  TREADMARK_REQUIRE_SHARED();
  const std::filesystem::path folder = *shared / "data/real/profiles";
  const Outcome outcomes[] = {
      // z points up in all but the first, whose flange has its back at y = 0
      {"Car7422_0001r.whl", Body::wheel, 644, -0.107, 131.382, 28.5935, nullptr},
      {"RUIC519A.dat", Body::wheel, 1001, -70.0, 65.0, 28.0, nullptr},
      {"SUIC519A.dat", Body::rail, 1001, -32.5, 39.0, -0.492, nullptr},
      {"SNX00500.mpt#1", Body::rail, 4217, 27.1672, 72.9974, 5.873, nullptr},
      {"SNX00500.mpt#2", Body::rail, 4598, -37.2282, 35.3221, 0.0, nullptr},
      {"SNX00500.mpt", Body::rail, 0, 0.0, 0.0, 0.0, "'SNX00500.mpt#1' to '#2'"},
      {"miniprof_1994_header.txt", Body::wheel, 0, 0.0, 0.0, 0.0, "at least 2 points, there are 0"},
      {"miniprof_2020_header.txt", Body::wheel, 0, 0.0, 0.0, 0.0, "the header does not end"},
  };
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files += entry.is_regular_file();
  EXPECT_EQ(files, 6u) << "a file without a row here";
  for (const Outcome& o : outcomes) {
    SCOPED_TRACE(o.file);
    if (o.refusal != nullptr) {
      const Error error = testing::error_thrown_by([&] { read_profile(folder / o.file, o.body, {}); });
      EXPECT_NE(std::string(error.what()).find(o.refusal), std::string::npos) << error.what();
      continue;
    }
    Profile p;
    ProfileOptions as_in_file;
    as_in_file.placement = ProfileOptions::Placement::as_in_file;
    ASSERT_NO_THROW(p = read_profile(folder / o.file, o.body, as_in_file));
    EXPECT_EQ(p.y.size(), o.points);
    constexpr double kNear = 0.1e-3;  // m, of the rounded numbers above
    EXPECT_NEAR(*std::min_element(p.y.begin(), p.y.end()), 1e-3 * o.y_low, kNear);
    EXPECT_NEAR(*std::max_element(p.y.begin(), p.y.end()), 1e-3 * o.y_high, kNear);
    const auto [top, tip] = std::minmax_element(p.z.begin(), p.z.end());
    EXPECT_NEAR(o.body == Body::wheel ? *tip : *top, 1e-3 * o.z, kNear);
    // the flange is on the side of small y
    if (o.body == Body::wheel) {
      EXPECT_LT(p.y[static_cast<std::size_t>(tip - p.z.begin())] - *std::min_element(p.y.begin(), p.y.end()), 0.025);
    }
  }
}

}  // namespace
}  // namespace treadmark::io
