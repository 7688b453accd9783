// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "samples.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using samples::kSimulation;
using samples::with;

const std::string kStudy = R"([study]
title = "Speed"
base = "base.toml"

[[study.vary]]
key = "simulation.speed_m_s"
values = [5, 10.5]
label = "speed [m/s]"

[[study.vary]]
label = "theory"
values = [
  { label = "full", set = ["contact.reference_surface=plane"] },
  { label = "FASTSIM", set = ["solver.tangential_model=fastsim", "case.regime=\"steady\""] },
]

[[study.vary]]
key = "wheel.flats.0.depth_mm"
from = 0.1
to = 10
count = 3
spacing = "logarithmic"

[[study.figures]]
file = "force.svg"
kind = "summary"
title = "Greatest force"
x = "simulation.speed_m_s"
y = ["max_force_N"]
series = "theory"
labels = ["exact", "simplified"]
x_range = [0, 40]
mark = [{ x = 7, y = 1.5, label = "measured" }]
)";

class Study : public ::testing::Test {
 protected:
  Study() {
    folder_.write("vehicle.toml", samples::kVehicle);
    folder_.write("track.toml", samples::kTrack);
    folder_.write("base.toml", kSimulation);
    folder_.write(
        "case.toml",
        "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n");
  }
  StudyFile read(const std::string& text, const std::vector<std::string>& overrides = {}) const {
    return read_study_file(folder_.write("study.toml", text), overrides);
  }
  std::string error(const std::string& part, const std::string& other,
                    const std::vector<std::string>& overrides = {}) const {
    return samples::error_of([&] { read(with(kStudy, part, other), overrides); });
  }
  treadmark::testing::TemporaryFolder folder_;
};

TEST_F(Study, RunsAreTheProductLastFastest) {
  const StudyFile study = read(kStudy);
  EXPECT_EQ(study.title, "Speed");
  EXPECT_EQ(study.sha256, sha256_hex(kStudy));
  EXPECT_EQ(study.base, folder_.path() / "base.toml");
  EXPECT_TRUE(study.base_is_simulation);
  ASSERT_EQ(study.variations.size(), 3u);
  EXPECT_EQ(study.variations[0].label, "speed [m/s]");
  EXPECT_EQ(study.variations[0].values[1].label, "10.5");
  EXPECT_EQ(study.variations[0].values[1].number.value(), 10.5);
  EXPECT_EQ(study.variations[1].values[1].label, "FASTSIM");
  EXPECT_FALSE(study.variations[1].values[1].number);
  EXPECT_EQ(study.variations[2].label, "wheel.flats.0.depth_mm");
  ASSERT_EQ(study.runs.size(), 12u);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(study.runs[i].number, static_cast<int>(i) + 1);
    EXPECT_THAT(study.runs[i].values, ::testing::ElementsAre(i / 6, i / 3 % 2, i % 3));
  }
  EXPECT_THAT(study.runs[11].overrides,
              ::testing::ElementsAre("simulation.speed_m_s=10.5", "solver.tangential_model=fastsim",
                                     "case.regime=\"steady\"", "wheel.flats.0.depth_mm=10"));
}

TEST_F(Study, LogarithmicValuesHaveOneRatio) {
  const auto values = read(kStudy).variations[2].values;
  ASSERT_EQ(values.size(), 3u);
  EXPECT_DOUBLE_EQ(values[0].number.value(), 0.1);
  EXPECT_NEAR(values[1].number.value(), 1.0, 1e-14);
  EXPECT_EQ(values[2].number.value(), 10.0);
  const auto linear = read(with(kStudy, "\"logarithmic\"", "\"linear\"")).variations[2].values;
  EXPECT_DOUBLE_EQ(linear[1].number.value(), 5.05);
}

TEST_F(Study, ARunIsTheBaseWithItsOverrides) {
  const StudyFile study = read(kStudy);
  const auto file = std::get<SimulationFile>(read_study_run(study, study.runs[11]));
  EXPECT_EQ(file.settings.speed, 10.5);
  EXPECT_EQ(file.contact.tangential_model, TangentialModel::fastsim);
  EXPECT_EQ(file.contact.regime, Regime::steady);
  EXPECT_DOUBLE_EQ(file.contact.wheel.defects.flats.at(0).depth, 10e-3);
  EXPECT_EQ(file.sha256, sha256_hex(kSimulation));
}

TEST_F(Study, FiguresArePlainData) {
  const StudyFigure figure = read(kStudy).figures.at(0);
  EXPECT_EQ(figure.file, "force.svg");
  EXPECT_EQ(figure.kind, StudyFigure::Kind::summary);
  EXPECT_EQ(figure.title, "Greatest force");
  EXPECT_EQ(figure.x, "simulation.speed_m_s");
  EXPECT_THAT(figure.y, ::testing::ElementsAre("max_force_N"));
  EXPECT_EQ(figure.series, "theory");
  EXPECT_THAT(figure.labels, ::testing::ElementsAre("exact", "simplified"));
  EXPECT_EQ(figure.x_range->at(1), 40.0);
  ASSERT_EQ(figure.marks.size(), 1u);
  EXPECT_EQ(figure.marks[0].y, 1.5);
  EXPECT_EQ(figure.marks[0].label, "measured");
}

TEST_F(Study, BaseMayStandInTheSameFile) {
  const StudyFile study =
      read(kSimulation + "[[study.vary]]\nkey = \"track_model.scale_stiffness\"\nvalues = [0.5, 1, 2]\n");
  EXPECT_EQ(study.title, "A flat");
  EXPECT_EQ(study.base, study.path);
  ASSERT_EQ(study.runs.size(), 3u);
  const auto file = std::get<SimulationFile>(read_study_run(study, study.runs[2]));
  EXPECT_EQ(file.track->springs[0].stiffness[2], 320e6);
}

TEST_F(Study, BaseMayBeACaseFile) {
  const StudyFile study = read(
      "[study]\nbase = \"case.toml\"\n[[study.vary]]\nkey = \"rail.shape.standard\"\nvalues = [\"60E1\"]\n"
      "[[study.vary]]\nkey = \"wheelset.y_mm\"\nvalues = [0, 1.5]\n");
  EXPECT_FALSE(study.base_is_simulation);
  ASSERT_EQ(study.runs.size(), 2u);
  const auto file = std::get<CaseFile>(read_study_run(study, study.runs[1]));
  EXPECT_DOUBLE_EQ(std::get<WheelRailCase>(file.cases.at(0).content).state.position.y, 1.5e-3);
}

TEST_F(Study, ListsAndTextsBecomeToml) {
  const StudyFile study = read(
      "[study]\nbase = \"base.toml\"\n[[study.vary]]\nkey = \"vehicle.springs.primary.stiffness_N_per_m\"\n"
      "values = [[1e6, 2e6, 3e6], [2e6, 4e6, 6e6]]\n[[study.vary]]\nkey = \"title\"\nvalues = ['a \"b\" \\c']\n");
  const auto file = std::get<SimulationFile>(read_study_run(study, study.runs.at(1)));
  EXPECT_EQ(file.vehicle.springs[0].stiffness[2], 6e6);
  EXPECT_EQ(file.title, "a \"b\" \\c");
}

TEST_F(Study, OverridesChangeStudyOrAllRuns) {
  const StudyFile study = read(kStudy, {"study.vary.2.count=5", "simulation.distance_m=1", "study.title=Other"});
  EXPECT_EQ(study.title, "Other");
  ASSERT_EQ(study.runs.size(), 20u);
  for (const StudyRun& run : study.runs) EXPECT_EQ(run.overrides.at(0), "simulation.distance_m=1");
  EXPECT_EQ(std::get<SimulationFile>(read_study_run(study, study.runs[3])).settings.distance, 1.0);
}

TEST_F(Study, EveryRunIsCheckedBeforehand) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error("simulation.speed_m_s\"\nvalues", "simulation.sped_m_s\"\nvalues"),
              HasSubstr("study.toml:7:11: run 1 (speed [m/s] = 5, theory = full, wheel.flats.0.depth_mm = 0.1): "
                        "unknown key 'simulation.sped_m_s'"));
  EXPECT_THAT(error("values = [5, 10.5]", "values = [5, 0]"), HasSubstr("study.toml:7:14: run 7"));
  EXPECT_THAT(error("=fastsim", "=fastsims"), HasSubstr("study.toml:14:3: run 4"));
  EXPECT_THAT(error("to = 10", "to = 1000"), HasSubstr("run 3"));
}

TEST_F(Study, ErrorsOfVariations) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error("values = [5, 10.5]", "values = []"),
              HasSubstr("study.toml:7:10: study.vary.values must be a list with at least one value"));
  EXPECT_THAT(error("values = [5, 10.5]\n", ""), HasSubstr("study.toml:5:1: study.vary.values is missing"));
  EXPECT_THAT(error("key = \"simulation.speed_m_s\"\n", ""), HasSubstr("study.toml:6:11: study.vary.key is missing"));
  EXPECT_THAT(error("key = \"wheel.flats.0.depth_mm\"\n", ""), HasSubstr("study.vary.key is missing"));
  EXPECT_THAT(error("key = \"simulation.speed_m_s\"", "key = \"a=3\""), HasSubstr("must be a key only"));
  EXPECT_THAT(error("key = \"simulation.speed_m_s\"", "key = \"wheel.flats.0.depth_mm\""),
              HasSubstr("wheel.flats.0.depth_mm is varied twice"));
  EXPECT_THAT(error("from = 0.1\n", "from = 0\n"), HasSubstr("study.vary.from = 0 must be greater than 0"));
  EXPECT_THAT(error("from = 0.1\n", ""), HasSubstr("study.vary.to needs study.vary.from"));
  EXPECT_THAT(error("count = 3\n", ""), HasSubstr("study.vary.count is missing"));
  EXPECT_THAT(error("count = 3", "count = 1"), HasSubstr("must be at least 2"));
  EXPECT_THAT(error("count = 3", "count = 99999"), HasSubstr("a study of 399996 runs is too large"));
  EXPECT_THAT(error("from = 0.1", "from = 0.1\nvalues = [1]"),
              HasSubstr("study.vary.values and study.vary.from exclude each other"));
  EXPECT_THAT(error("label = \"full\", ", ""), HasSubstr("study.vary.values.label is missing"));
  EXPECT_THAT(error("set = [\"contact.reference_surface=plane\"]", "set = []"),
              HasSubstr("study.toml:13:27: study.vary.values.set is empty"));
  EXPECT_THAT(error("contact.reference_surface=plane", "contact.reference_surface"),
              HasSubstr("study.toml:13:28: 'contact.reference_surface': '=' is missing"));
  EXPECT_THAT(error("spacing", "spacin"), HasSubstr("did you mean 'study.vary.spacing'?"));
  EXPECT_THAT(
      error("label = \"theory\"", "label = \"full/simplified\""),
      HasSubstr("study.toml:11:9: study.vary.label without a key is the name of a dataset, which has no slash"));
  EXPECT_THAT(error("label = \"theory\"", "label = \".\""), HasSubstr("study.vary.label without a key"));
  EXPECT_THAT(error("label = \"theory\"", "label = \"simulation.speed_m_s\""),
              HasSubstr("two variations are called simulation.speed_m_s"));
  EXPECT_THAT(error("[study]", "[study]", {"simulation.speed_m_s=3"}),
              HasSubstr("the study varies simulation.speed_m_s itself"));
}

TEST_F(Study, ErrorsOfBaseAndFigures) {
  using ::testing::HasSubstr;
  EXPECT_THAT(error("base.toml", "basis.toml"), HasSubstr("study.toml:3:8: study.base: there is no file"));
  EXPECT_THAT(error("base = \"base.toml\"\n", ""), HasSubstr("study.base is missing"));
  EXPECT_THAT(error("base.toml", "study.toml"), HasSubstr("study.base is a study itself"));
  EXPECT_THAT(error("[study]", "rail.shape.standard = \"60E1\"\n[study]"),
              HasSubstr("study.toml:1:1: rail stands beside study.base"));
  EXPECT_THAT(samples::error_of([&] { read(kSimulation); }), HasSubstr("study.toml:1:1: [study] is missing"));
  EXPECT_THAT(error("force.svg", "force.png"),
              HasSubstr("study.toml:25:8: study.figures.file = 'force.png' must end with .svg"));
  // neither out of the folder of results nor over its sweep.csv
  for (const char* name : {"../force.svg", "/tmp/force.svg", "a/force.svg", "./force.svg", "sweep.svg"})
    EXPECT_THAT(error("force.svg", name), HasSubstr(std::string("study.figures.file = '") + name + "' is no name"));
  EXPECT_THAT(error("\"summary\"", "\"sumary\""), HasSubstr("is not one of \"history\", \"summary\", \"patches\""));
  EXPECT_THAT(error("x = \"simulation.speed_m_s\"\n", ""), HasSubstr("study.figures.x is missing"));
  EXPECT_THAT(error("y = [\"max_force_N\"]", "y = []"), HasSubstr("study.figures.y is empty"));
  EXPECT_THAT(error("x_range = [0, 40]", "x_range = [40, 0]"),
              HasSubstr("study.figures.x_range must be two increasing numbers"));
  EXPECT_THAT(error("series = \"theory\"", "series = \"teory\""),
              HasSubstr("the variation 'teory' is not known (did you mean 'theory'?)"));
  EXPECT_THAT(error("labels = [\"exact\", \"simplified\"]", "labels = [\"exact\"]"),
              HasSubstr("study.figures.labels has 1 texts for 2 values of theory"));
  EXPECT_THAT(error("{ x = 7, y", "{ x = 7, z"), HasSubstr("unknown key 'study.figures.mark.z'"));
  EXPECT_THAT(
      error("[[study.figures]]", "[[study.figures]]\nfile = \"force.svg\"\nkind = \"patches\"\n[[study.figures]]"),
      HasSubstr("two figures would be written to force.svg"));
}

}  // namespace
}  // namespace treadmark::io
