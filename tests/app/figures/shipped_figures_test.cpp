// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "treadmark/app/simulation/run_study.hpp"
#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

std::string example(const std::string& name) { return std::string(TREADMARK_SOURCE_DIR) + "/examples/" + name; }

/// A light vehicle on coarse grids. The flat is on the left here, where wheels are seen in a mirror.
const std::vector<std::string> kQuick{
    "simulation.vehicle=" + example("vehicles/wheel-on-mass.toml"),
    R"(simulation.wheels=[{ wheelset = 1, side = "left", contact = "full", pitch_deg = 60.0 }, { wheelset = 1, side = "right", contact = "full", defects = false }])",
    "discretisation.dx_mm=2", "discretisation.ds_mm=2", "simulation.tolerance_um=1"};

std::vector<std::string> with(const std::vector<std::string>& settings) {
  std::vector<std::string> all = kQuick;
  all.insert(all.end(), settings.begin(), settings.end());
  return all;
}

io::SimulationResult simulated(const std::vector<std::string>& settings, const SimulationOptions& options = {},
                               const Progress& progress = {}) {
  const io::SimulationFile file = io::read_simulation_file(example("figure7.toml"), settings);
  SurfaceStore store;
  return run_simulation(file, store, options, progress);
}

TEST(ShippedFigures, EightPanelsOverTheFlat) {
  const testing::TemporaryFolder folder;
  const io::SimulationResult result = simulated(kQuick);
  const std::vector<pictures::PatchesPanel> panels = patches_panels(result);
  ASSERT_EQ(panels.size(), 8u);
  const std::vector<double> wanted{8.0, 5.0, 3.0, 1.0, -1.0, -3.0, -5.0, -10.0};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    EXPECT_NEAR(panels[i].result->pitch / kDegree, wanted[i], 0.6);  // the step after the passage, of 4 mm
    ASSERT_EQ(panels[i].round_wheel, panels[0].round_wheel);
    EXPECT_THAT(panels[i].title, HasSubstr("kN"));
    ASSERT_EQ(panels[i].depth.size(), panels[i].depth_grid.size());
  }
  EXPECT_EQ(panels[0].round_wheel, &result.snapshots.cases[0]);
  EXPECT_NEAR(panels[0].round_wheel->pitch / kDegree, 60.0, 1e-9);
  // The middle of the flat, 1.4 mm deep, lies where theta + pitch = 0.
  for (const std::size_t i : {2u, 3u, 4u, 5u}) {
    double deepest = 0.0, at = 0.0;
    const Grid2& grid = panels[i].depth_grid;
    for (std::size_t k = 0; k < panels[i].depth.size(); ++k)
      if (panels[i].depth[k] > deepest) deepest = panels[i].depth[k], at = grid.x(static_cast<int>(k) % grid.nx);
    EXPECT_NEAR(deepest, 1.4e-3, 0.03e-3);
    EXPECT_NEAR(at, 0.46 * std::sin(panels[i].result->pitch), 1.5e-3);
  }
  write_simulation_folder(folder.path(), result);
  const testing::XmlElement root = testing::read_xml(io::read_text(folder.path() / "patches.svg"));
  EXPECT_EQ(root.find("g", "class", "panel").size(), 8u);
  EXPECT_GT(root.find("path", "class", "depth").size(), 5u);
  EXPECT_THAT(io::read_text(folder.path() / "patches.csv"), HasSubstr("\n8,"));
}

TEST(ShippedFigures, OnlyTheFirstPassageOfTheWatchedWheelIsDrawn) {
  const io::SimulationResult result = simulated(with(
      {"simulation.fields.pitch_deg=[40, 59]", "simulation.distance_m=3.2", "simulation.speed_m_s=60",
       R"(simulation.wheels=[{ wheelset = 1, side = "left", contact = "full", pitch_deg = 60.0, defects = false }, { wheelset = 1, side = "right", contact = "full", defects = false }])"}));
  EXPECT_EQ(result.snapshots.cases.size(), 10u);  // of both wheels: the start, and two revolutions
  const auto panels = patches_panels(result);
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_EQ(panels[0].result, &result.snapshots.cases[2]);
  EXPECT_EQ(panels[1].result, &result.snapshots.cases[4]);
  EXPECT_TRUE(panels[0].depth.empty());  // a round wheel
}

TEST(ShippedFigures, AnInterruptedRunDrawsTheSame) {
  const testing::TemporaryFolder folder;
  // The first angle is passed in the first step, after which the run is stopped.
  const auto settings = with({"simulation.fields.pitch_deg=[52, 59.9999]", "simulation.distance_m=0.1"});
  const io::SimulationResult undisturbed = simulated(settings);
  ASSERT_EQ(patches_panels(undisturbed).size(), 2u);
  SimulationOptions options;
  options.checkpoint_file = folder.path() / "unfinished.h5";
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t, std::size_t, const std::string&) { stop = true; };
  const io::SimulationResult part = simulated(settings, options, progress);
  ASSERT_EQ(part.status, "interrupted");
  EXPECT_EQ(patches_panels(part).size(), 1u);
  const io::SimulationResult resumed = simulated(settings, options);
  ASSERT_EQ(resumed.status, "complete");
  EXPECT_EQ(pictures::patches_csv(patches_panels(resumed)), pictures::patches_csv(patches_panels(undisturbed)));
}

TEST(ShippedFigures, StudiesAreValid) {
  EXPECT_EQ(io::read_study_file(example("figure5.toml"), {}).runs.size(), 6u);
  EXPECT_EQ(io::read_study_file(example("figure6.toml"), {}).runs.size(), 240u);
  EXPECT_EQ(io::read_study_file(example("figure6-track.toml"), {}).runs.size(), 20u);
  EXPECT_EQ(io::read_study_file(example("flat-between-sleepers.toml"), {}).runs.size(), 24u);
}

/// Runs a study of examples/, changed to take no time.
void draw(const std::string& name, const std::vector<std::string>& changes, const std::filesystem::path& folder) {
  const std::vector<std::string> settings = changes;
  const io::StudyFile study = io::read_study_file(example(name), settings);
  StudyOptions options;
  options.folder = folder;
  options.settings = settings;
  const StudyOutcome outcome = run_study(study, options, {});
  ASSERT_TRUE(outcome.complete);
  for (const io::SimulationRun& run : outcome.study.runs) ASSERT_EQ(run.status, "complete") << run.label << run.message;
  write_study_folder(study, options, outcome.study);
}

TEST(ShippedFigures, TheoriesGetALineEachInTwoPanels) {
  const testing::TemporaryFolder folder;
  std::vector<std::string> settings(kQuick.begin(), kQuick.begin() + 2);
  settings.insert(settings.end(),
                  {R"(study.vary.1.values=[{label="2 mm", set=["discretisation.dx_mm=2", "discretisation.ds_mm=2"]}])",
                   "study.figures.0.x_range=[0, 0.022]"});
  draw("figure5.toml", settings, folder.path());
  const std::string svg = io::read_text(folder.path() / "figure5.svg");
  testing::read_xml(svg);
  for (const char* text : {"FASTSIM, 2 mm", "steady rolling, 2 mm", "transient rolling, 2 mm", "Q [kN]", "Ty [kN]"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(io::read_text(folder.path() / "figure5.csv"), HasSubstr("run,panel,t_s,Q_N,Ty_N"));
}

TEST(ShippedFigures, SpeedsArePointsAndSomeOfThemPanels) {
  const testing::TemporaryFolder folder;
  draw("figure6.toml",
       with({"study.vary.0.values=[20, 40, 60]",
             R"(study.vary.1.values=[{ label = "none", set = ["track.cant_rad=0.0", "simulation.distance_m=0.06"] }, )"
             R"({ label = "1:40", set = ["track.cant_rad=0.025", "simulation.distance_m=0.06"] }])",
             R"(study.vary.2.values=[{ label = "fitted", set = ["simulation.track=tracks/zhai-fitted.toml"] }])",
             R"(study.figures.1.only=["V [m/s]=20", "simulation.speed_m_s=60"])", "study.figures.1.x_range=[0, 0.06]"}),
       folder.path());
  const std::string speeds = io::read_text(folder.path() / "figure6-speed.svg"),
                    histories = io::read_text(folder.path() / "figure6-histories.svg");
  testing::read_xml(speeds);
  testing::read_xml(histories);
  for (const char* text : {"cant = none", "cant = 1:40", "published, 1:40", "published, no cant"})
    EXPECT_THAT(speeds, HasSubstr(text));
  for (const char* text : {"V = 20 m/s", "V = 60 m/s", "no cant"}) EXPECT_THAT(histories, HasSubstr(text));
  EXPECT_EQ(histories.find("V = 40 m/s"), std::string::npos);
  EXPECT_EQ(io::read_text(folder.path() / "figure6-histories.csv").find("V = 40"), std::string::npos);
}

TEST(ShippedFigures, TracksAreCompared) {
  const testing::TemporaryFolder folder;
  draw("figure6-track.toml",
       with({"simulation.distance_m=0.04", "study.figures.1.x_range=[0, 0.04]", "study.figures.2.x_range=[0, 0.04]"}),
       folder.path());
  for (const char* file : {"figure6-track.svg", "figure6-track-8.svg", "figure6-track-60.svg"}) {
    const std::string svg = io::read_text(folder.path() / file);
    testing::read_xml(svg);
    EXPECT_THAT(svg, HasSubstr("stiffness x 0.5")) << file;
    EXPECT_THAT(svg, HasSubstr("gm-tt0088")) << file;
  }
}

TEST(ShippedFigures, OnlyNamesValuesThatTheStudyHas) {
  const auto refused = [](const std::string& only) -> std::string {
    try {
      io::read_study_file(example("figure6.toml"), std::vector<std::string>{"study.figures.1.only=" + only});
    } catch (const Error& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_THAT(refused(R"(["simulation.speed_m_s=7.5"])"), HasSubstr("has no value '7.5'"));
  EXPECT_THAT(refused(R"(["speed=7"])"), HasSubstr("'speed' is not known"));
  EXPECT_THAT(refused(R"(["cant"])"), HasSubstr("is not \"key=value\""));
  EXPECT_EQ(refused(R"(["cant=1:40", "simulation.speed_m_s=200"])"), "");
}

}  // namespace
}  // namespace treadmark::app
