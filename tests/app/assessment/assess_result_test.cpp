// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/assessment/assess_result.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/histories/channels.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using treadmark::testing::refusal_of;

constexpr double kSpeedOfRun = 20.0;

/// Four seconds: the right wheel, which is watched, swings at 3 Hz, its axle box at 100 Hz.
std::shared_ptr<io::SimulationResult> sample_run(double step = 2e-4) {
  auto result = std::make_shared<io::SimulationResult>();
  result->title = "made up";
  result->columns = {{"t_s", "s", "time"},
                     {"x_m", "m", "distance travelled"},
                     {"Q_N", "N", "vertical force on the rail (ws1_right)"},
                     {"Y_N", "N", "lateral force on the rail (ws1_right)"},
                     {"ws1_left.Q_N", "N", "vertical force on the rail"},
                     {"ws1_left.Y_N", "N", "lateral force on the rail"},
                     {"ws1_left.Tgamma_N", "N", "wear number"},
                     {"axle_box.ws1_right.az_m_s2", "m/s2", "vertical acceleration"}};
  result->statics = {{"wheelset1.load_N", 120e3, "N", "weight that the two wheels carry"}};
  for (double t = 0.0; t < 4.0 + 0.5 * step; t += step) {
    const double swing = std::sin(2.0 * std::numbers::pi * 3.0 * t);
    for (const double v : {t, kSpeedOfRun * t, 60e3 + 20e3 * swing, 6e3, 60e3, -3e3, 40.0,
                           3.0 * std::sin(2.0 * std::numbers::pi * 100.0 * t)})
      result->values.push_back(v);
  }
  return result;
}

const measures::Assessed& find(const AssessedRun& run, const std::string& place, const std::string& quantity) {
  const auto at = ranges::find_if(
      run.quantities, [&](const measures::Assessed& a) { return a.place == place && a.quantity == quantity; });
  if (at == run.quantities.end()) throw Error(ErrorKind::configuration, "no " + quantity + " of " + place);
  return *at;
}

TEST(Channels, HaveNamesAndPatterns) {
  const auto run = sample_run();
  EXPECT_EQ(io::channel_name(run->columns[2]), "ws1_right.Q_N");
  EXPECT_EQ(io::channel_name(run->columns[4]), "ws1_left.Q_N");
  EXPECT_EQ(io::channel_name(run->columns[0]), "t_s");
  EXPECT_TRUE(io::fits("ws1_left.Q_N", "ws*.Q_N"));
  EXPECT_TRUE(io::fits("ws1_left.Q_N", "*"));
  EXPECT_TRUE(io::fits("ws1_left.Q_N", "*left*N"));
  EXPECT_TRUE(io::fits("aab", "*ab"));
  EXPECT_FALSE(io::fits("ws1_left.Q_N", "ws1_left.Q"));
  EXPECT_FALSE(io::fits("ws1_left.Q_N", "*.Y_N"));
  EXPECT_FALSE(io::fits("", "a"));
  const auto columns = [&](std::vector<std::string> patterns) { return io::fitting_columns(run->columns, patterns); };
  EXPECT_THAT(columns({"ws1_*.Q_N"}), ElementsAre(2, 4));
  EXPECT_THAT(columns({"Q_N", "t_s"}), ElementsAre(0, 2));
  EXPECT_THAT(refusal_of([&] { columns({"ws1_rigth.Q_N"}); }),
              HasSubstr("no channel of the history is called 'ws1_rigth.Q_N' (did you mean 'ws1_right.Q_N'?)"));
}

TEST(AssessResult, FindsWheelsPointsAndLoadsByTheirNames) {
  AssessmentRequest request;
  request.sections = {{"curve", 10.0, 70.0, SectionKind::curve}};
  const AssessedRun run = assess_result("one", sample_run(), request);
  EXPECT_NEAR(find(run, "ws1_right", "Q").most, 80e3, 100.0);
  EXPECT_NEAR(find(run, "ws1_right", "Q").limit, 150e3, 1.0);
  EXPECT_NEAR(find(run, "ws1_left", "Y").middle, 3e3, 1.0);  // outwards
  EXPECT_NEAR(find(run, "ws1_left", "Tgamma").value, 40.0, 1e-9);
  EXPECT_NEAR(find(run, "ws1", "sumY_2m").value, 3e3, 1.0);
  EXPECT_NEAR(find(run, "ws1", "sumY_2m").limit, 50e3, 1.0);
  EXPECT_NEAR(find(run, "ws1_right", "az_box").rms, 3.0 / std::numbers::sqrt2, 0.05);
  // 60 m hold no window of 100 m
  ASSERT_EQ(run.doubts.size(), 1u);
  EXPECT_THAT(run.doubts.front(), AllOf(HasSubstr("sumY_rms of ws1 in curve"), HasSubstr("too_short")));
  EXPECT_EQ(worst_of(run, "curve", "Q")->place, "ws1_right");
  EXPECT_EQ(worst_of(run, "curve", "ay_ride"), nullptr);
}

TEST(AssessResult, LevelsOfAxleBoxesAreInTheirBand) {
  AssessmentRequest request;
  request.spectra = {"axle_box.*", "ws1_right.Q_N"};
  const AssessedRun run = assess_result("one", sample_run(), request);
  ASSERT_EQ(run.spectra.size(), 2u);
  EXPECT_EQ(run.spectra[0].channel, "ws1_right.Q_N");
  const ChannelSpectrum& box = run.spectra[1];
  EXPECT_NEAR(box.density.highest, 1.0 / (8.0 * 2e-4), 1.0);
  const auto band = ranges::find(box.bands, 100.0, &measures::FrequencyBand::nominal);
  ASSERT_NE(band, box.bands.end());
  EXPECT_NEAR(acceleration_level(band->rms), 20.0 * std::log10(3.0 / std::numbers::sqrt2 / 1e-6), 0.1);
  EXPECT_LT(acceleration_level((band - 2)->rms), 80.0);
  EXPECT_THAT(spectra_csv(std::span(&run, 1)), HasSubstr("one,axle_box.ws1_right.az_m_s2,third_octave,100,"));
}

TEST(AssessResult, RefusesWhatIsNotThere) {
  const auto with = [](AssessmentRequest request) {
    return refusal_of([&] { assess_result("one", sample_run(), request); });
  };
  AssessmentRequest request;
  request.sections = {{"a", 10.0, 90.0}};
  EXPECT_THAT(with(request), HasSubstr("section a from 10 to 90 m does not lie within the run of one, 0 to 80 m"));
  request.sections = {{"a", 30.0, 10.0}};
  EXPECT_THAT(with(request), HasSubstr("section a from 30 to 10 m is none"));
  request.sections = {{"a", 10.0, 20.0}, {"a", 20.0, 30.0}};
  EXPECT_THAT(with(request), HasSubstr("two sections have the name a"));
  request.sections.clear();
  request.from = 80.0;
  EXPECT_THAT(with(request), HasSubstr("the beginning of the assessment, 80 m,"));
  request.from = 0.0;
  request.spectra = {"axlebox.*"};
  EXPECT_THAT(with(request), HasSubstr("no channel of the history is called 'axlebox.*'"));
  const auto cases = std::make_shared<io::SimulationResult>();
  cases->columns = {{"case", "1", "number"}};
  EXPECT_THAT(refusal_of([&] { assess_result("one", cases, {}); }), HasSubstr("the history has no column t_s"));
}

TEST(AssessResult, DoubtsAreNamed) {
  AssessmentRequest request;
  request.sections = {{"short", 10.0, 11.0}, {"beyond", 70.0, 90.0}};
  request.spectra = {"Q_N"};
  const auto stopped = sample_run(0.05);
  stopped->status = "interrupted";
  const AssessedRun run = assess_result("one", stopped, request);
  const std::string text = assessment_text(std::span(&run, 1));
  EXPECT_THAT(text, HasSubstr("warning: the run is interrupted"));
  EXPECT_THAT(text, HasSubstr("(outside)"));
  EXPECT_THAT(text, HasSubstr("(too_short)"));
  EXPECT_THAT(text, HasSubstr("for one-third octaves"));
  for (const measures::Assessed& a : run.quantities)
    if (a.status != measures::AssessedStatus::ok) {
      EXPECT_TRUE(std::isnan(a.value)) << a.quantity;
    }
  AssessmentRequest whole;
  const AssessedRun coarse = assess_result("one", sample_run(0.05), whole);
  EXPECT_EQ(find(coarse, "ws1_left", "Q").status, measures::AssessedStatus::too_coarse);
}

/// At 20 m/s in a curve of 500 m with 60 mm: b v^2/(g R) less the cant.
TEST(AssessResult, CantDeficiencyIsThatOfTheLine) {
  const auto in_curve = [](std::vector<io::NamedValue> statics) {
    const auto plain = sample_run(0.01), run = std::make_shared<io::SimulationResult>(*plain);
    run->values.clear();
    for (const char* name : {"line.speed_m_s", "line.curvature_1_m", "line.cant_m"})
      run->columns.push_back({name, "", ""});
    for (std::size_t row = 0; row < plain->rows(); ++row) {
      for (std::size_t c = 0; c < plain->columns.size(); ++c)
        run->values.push_back(plain->values[row * plain->columns.size() + c]);
      for (const double v : {kSpeedOfRun, 1.0 / 500.0, 0.06}) run->values.push_back(v);
    }
    run->statics.insert(run->statics.end(), statics.begin(), statics.end());
    return assess_result("one", run, {});
  };
  const AssessedRun own = in_curve({{kCantBaseName, 1.1, "m", ""}, {kGravityName, 9.8, "m/s2", ""}});
  ASSERT_EQ(own.cant_deficiency.size(), 1u);
  EXPECT_NEAR(own.cant_deficiency[0], 1.1 / 9.8 * 0.8 - 0.06, 1e-12);
  const AssessedRun old = in_curve({});
  EXPECT_NEAR(old.cant_deficiency[0], 1.5 / 9.81 * 0.8 - 0.06, 1e-12);
  const auto says = [](const AssessedRun& run) {
    return ranges::any_of(run.doubts,
                          [](const std::string& d) { return d.find("base of 1.5 m") != std::string::npos; });
  };
  EXPECT_TRUE(says(old));
  EXPECT_FALSE(says(own));
}

TEST(AssessmentOutputs, HoldTheSameNumbersAndAreReadBack) {
  AssessmentRequest request;
  request.vehicle = VehicleKind::freight;
  request.from = 4.0;
  request.spectra = {"ws1_*.Q_N"};
  request.sections = {{"first, half", 4.0, 40.0}, {"second", 40.0, 80.0, SectionKind::curve}};
  const AssessedRun runs[] = {assess_result("one", sample_run(), request),
                              assess_result("two", sample_run(1e-3), request)};
  const testing::TemporaryFolder folder;
  const std::string channels[] = {"ws1_right.Q_N"};
  write_assessment_folder(folder.path(), runs, channels);
  for (const char* file : {"assessment.csv", "assessment.json", "spectra.csv", "spectra.svg", "runs.svg", "runs.csv"})
    EXPECT_GT(std::filesystem::file_size(folder.path() / file), 200u) << file;
  const auto json = nlohmann::json::parse(io::read_text(folder.path() / "assessment.json"));
  ASSERT_EQ(json.at("runs").size(), 2u);
  const std::string csv = io::read_text(folder.path() / "assessment.csv");
  EXPECT_EQ(static_cast<std::size_t>(ranges::count(csv, '\n')),
            1 + runs[0].quantities.size() + runs[1].quantities.size());
  EXPECT_THAT(csv, HasSubstr("one,\"first, half\",4,40,straight,ws1_right,Q,N,ok,"));
  EXPECT_EQ(json.at("runs")[0].at("assessed").size(), runs[0].quantities.size());
  for (std::size_t i = 0; i < runs[0].quantities.size(); ++i) {
    const auto& row = json.at("runs")[0].at("assessed")[i];
    EXPECT_TRUE(json.at("quantities").contains(row.at("quantity").get<std::string>()));
    if (row.at("status") != "ok") {  // no section holds a window of 100 m
      EXPECT_TRUE(row.at("value").is_null()) << row;
      continue;
    }
    EXPECT_NEAR(row.at("value").get<double>() / runs[0].quantities[i].value, 1.0, 1e-11);
  }
  // of one run the request is read again
  EXPECT_THROW(request_in(folder.path() / "assessment.json"), Error);
  write_assessment_folder(folder.path(), std::span(runs, 1), {});
  const AssessmentRequest again = request_in(folder.path() / "assessment.json");
  EXPECT_EQ(again.vehicle, request.vehicle);
  EXPECT_EQ(again.from, request.from);
  EXPECT_EQ(again.spectra, request.spectra);
  ASSERT_EQ(again.sections.size(), 2u);
  EXPECT_EQ(again.sections[1].name, "second");
  EXPECT_EQ(again.sections[1].kind, SectionKind::curve);
  const AssessedRun recomputed = assess_result("one", sample_run(), again);
  EXPECT_EQ(assessment_csv(std::span(&recomputed, 1)), assessment_csv(std::span(runs, 1)));
}

}  // namespace
}  // namespace treadmark::app
