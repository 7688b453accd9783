// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <thread>
#include <vector>

#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/app/simulation/run_study.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;
using treadmark::testing::SampleSimulation;

class RunStudy : public ::testing::Test {
 protected:
  void SetUp() override {
    input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
    options.folder = input.path("out");
  }
  io::StudyFile study() const { return io::read_study_file(input.path("study.toml")); }

  SampleSimulation input;
  StudyOptions options;
};

TEST_F(RunStudy, SolvesEveryRunOnce) {
  options.workers = 2;
  Progress progress;
  std::vector<std::size_t> told;
  progress.report = [&](std::size_t finished, std::size_t total, const std::string&) {
    told.push_back(finished);
    EXPECT_EQ(total, 4u);
  };
  const StudyOutcome outcome = run_study(study(), options, progress);
  EXPECT_TRUE(outcome.complete);
  EXPECT_EQ(outcome.found_finished, 0u);
  EXPECT_EQ(told, (std::vector<std::size_t>{1, 2, 3, 4}));
  ASSERT_EQ(outcome.study.runs.size(), 4u);
  EXPECT_EQ(outcome.study.runs[2].label, "40, 0.5");
  EXPECT_EQ(io::read_simulation(outcome.study.runs[2].store).settings,
            (std::vector<std::string>{"simulation.speed_m_s=40", "wheel.flats.0.depth_mm=0.5"}));
  EXPECT_EQ(run_study(study(), options, {}).found_finished, 4u);
}

TEST_F(RunStudy, AStopRequestLeavesTheRest) {
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t, const std::string&) { stop = finished >= 2; };
  const StudyOutcome outcome = run_study(study(), options, progress);
  EXPECT_FALSE(outcome.complete);
  EXPECT_EQ(outcome.study.runs.size(), 2u);
  EXPECT_FALSE(fs::exists(input.path("out/runs/run_0004/simulation.h5")));
}

TEST_F(RunStudy, LeavesTheRunThatSomebodyElseHoldsToThem) {
  fs::create_directories(input.path("out/runs/run_0001"));
  auto held = FileLock::attempt(input.path("out/runs/run_0001/lock"));
  ASSERT_TRUE(held);
  Progress progress;
  std::vector<std::string> order;
  progress.report = [&](std::size_t finished, std::size_t, const std::string& label) {
    order.push_back(label);
    if (finished == 3) held.reset();  // the holder died without a result
  };
  EXPECT_TRUE(run_study(study(), options, progress).complete);
  EXPECT_EQ(order, (std::vector<std::string>{"20, 0.9", "40, 0.5", "40, 0.9", "20, 0.5"}));
}

TEST_F(RunStudy, ResultsDoNotTellWhatElseTheWorkerRead) {
  fs::copy_file(input.path("rail.prr"), input.path("other.prr"));
  input.edit("simulation.toml", "shape.standard = \"60E1\"", "shape.file = \"rail.prr\"");
  input.edit("study.toml", "key = \"wheel.flats.0.depth_mm\"\nvalues = [0.5, 0.9]",
             "key = \"rail.shape.file\"\nvalues = [\"rail.prr\", \"other.prr\"]");
  input.edit("study.toml", "series = \"wheel.flats.0.depth_mm\"", "series = \"rail.shape.file\"");
  const StudyOutcome outcome = run_study(study(), options, {});
  ASSERT_TRUE(outcome.complete);
  for (const io::SimulationRun& run : outcome.study.runs) {
    std::vector<std::string> files;
    for (const auto& [name, hash] : io::read_simulation(run.store).geometry_sha256) files.push_back(name);
    EXPECT_EQ(files,
              (std::vector<std::string>{run.number % 2 == 1 ? "rail.prr" : "other.prr", "vehicle.toml", "track.toml"}));
  }
}

TEST_F(RunStudy, ARunWithoutEquilibriumTellsWhereItComesFrom) {
  input.edit("vehicle.toml", "mass_kg = 9000", "mass_kg = 900000");
  input.edit("study.toml", "values = [20, 40]", "values = [20]");
  input.edit("study.toml", "key = \"wheel.flats.0.depth_mm\"\nvalues = [0.5, 0.9]",
             "key = \"simulation.gravity_m_s2\"\nvalues = [1000]");
  input.edit("study.toml", "series = \"wheel.flats.0.depth_mm\"", "series = \"simulation.gravity_m_s2\"");
  const StudyOutcome outcome = run_study(study(), options, {});
  ASSERT_EQ(outcome.study.runs.size(), 1u);
  EXPECT_EQ(outcome.study.runs[0].status, "failed");
  const io::SimulationResult result = io::read_simulation(outcome.study.runs[0].store);
  EXPECT_EQ(result.rows(), 0u);
  EXPECT_EQ(result.settings, (std::vector<std::string>{"simulation.speed_m_s=20", "simulation.gravity_m_s2=1000"}));
  std::vector<std::string> files;
  for (const auto& [name, hash] : result.geometry_sha256) files.push_back(name);
  EXPECT_EQ(files, (std::vector<std::string>{"vehicle.toml", "track.toml"}));
}

TEST_F(RunStudy, IdentityIsOfWhatResultsDependOn) {
  const std::string before = study_identity(study());
  input.edit("study.toml", "title = \"Two flats at two speeds\"", "title = \"Two flats\"");
  EXPECT_EQ(study_identity(study()), before);
  input.edit("track.toml", "mass_kg = 80", "mass_kg = 90");
  EXPECT_NE(study_identity(study()), before);
}

TEST_F(RunStudy, ErrorsOfARunStopTheStudy) {
  input.edit("simulation.toml", "shape.standard = \"60E1\"", "shape.file = \"rail.prr\"");
  input.write("rail.prr", "no profile at all");
  options.workers = 2;
  EXPECT_THROW(run_study(study(), options, {}), Error);
  EXPECT_FALSE(fs::exists(input.path("out/runs/run_0001/simulation.h5")));
}

void forget_launchers() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMI_SIZE", "PMI_RANK", "SLURM_NTASKS",
                           "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"})
    unsetenv(name);
}

TEST(ProcessPlace, IsThatOfTheLauncher) {
  forget_launchers();
  EXPECT_EQ(process_place().count, 1);
  EXPECT_EQ(process_place().rank, 0);
  // A batch script without srun: one process, whatever was allotted.
  setenv("SLURM_NTASKS", "8", 1);
  EXPECT_EQ(process_place().count, 1);
  setenv("SLURM_STEP_NUM_TASKS", "8", 1);
  setenv("SLURM_PROCID", "3", 1);
  EXPECT_EQ(process_place().count, 8);
  EXPECT_EQ(process_place().rank, 3);
  setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  setenv("OMPI_COMM_WORLD_RANK", "2", 1);
  EXPECT_EQ(process_place().count, 4);
  EXPECT_EQ(process_place().rank, 2);
  forget_launchers();
}

}  // namespace
}  // namespace treadmark::app
