// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/simulation_store.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"
#include "treadmark/tests/io/results/same_run.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

class SimulationStore : public ::testing::Test {
 protected:
  void expect_refused(const std::string& words) {
    try {
      io::write_simulation(path_, result_);
      FAIL() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::configuration);
      EXPECT_NE(error.message().find(words), std::string::npos) << error.message();
    }
    EXPECT_EQ(folder_.count_files(), 0u);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "run.h5";
  io::SimulationResult result_ = testing::sample_simulation(40.0);
};

TEST_F(SimulationStore, ReadsBackWhatWasWritten) {
  result_.values[6] = std::numeric_limits<double>::quiet_NaN();
  io::write_simulation(path_, result_);
  const io::SimulationResult read = io::read_simulation(path_);
  EXPECT_EQ(read.version, result_.version);
  EXPECT_EQ(read.git, result_.git);
  EXPECT_EQ(read.input_file, result_.input_file);
  EXPECT_EQ(read.input_sha256, result_.input_sha256);
  EXPECT_EQ(read.geometry_sha256, result_.geometry_sha256);
  EXPECT_EQ(read.inputs, result_.inputs);
  EXPECT_EQ(read.settings, result_.settings);
  EXPECT_EQ(read.title, result_.title);
  EXPECT_EQ(read.status, result_.status);
  EXPECT_EQ(read.message, result_.message);
  EXPECT_EQ(read.swept, result_.swept);
  EXPECT_EQ(read.checkpoint, result_.checkpoint);
  ASSERT_EQ(read.columns.size(), 4u);
  EXPECT_EQ(read.columns[2].name, "ws1_right.Q_N");
  EXPECT_EQ(read.columns[2].unit, "N");
  EXPECT_EQ(read.columns[2].description, "vertical force");
  ASSERT_EQ(read.values.size(), result_.values.size());
  EXPECT_TRUE(std::isnan(read.values[6]));
  for (std::size_t i = 0; i < read.values.size(); ++i)
    if (i != 6) {
      ASSERT_EQ(read.values[i], result_.values[i]) << i;
    }
  ASSERT_EQ(read.events.size(), 2u);
  EXPECT_EQ(read.events[1].time, 0.05);
  EXPECT_EQ(read.events[1].position, 2.0);
  EXPECT_EQ(read.events[1].wheel, "ws1_right");
  EXPECT_EQ(read.events[0].kind, "contact lost");
  ASSERT_EQ(read.summary.size(), 2u);
  EXPECT_EQ(read.summary[0].name, "q_max_N");
  EXPECT_EQ(read.summary[0].value, result_.summary[0].value);
  EXPECT_EQ(read.summary[0].description, "largest vertical force");
  ASSERT_EQ(read.statics.size(), 1u);
  EXPECT_EQ(read.statics[0].unit, "N");
  ASSERT_EQ(read.modes.size(), 2u);
  EXPECT_EQ(read.modes[1].shape, "wheelset, \"vertical\"");
  EXPECT_EQ(read.modes[1].frequency_Hz, 45.0);
  EXPECT_EQ(read.modes[0].damping_ratio, 0.15);
}

TEST_F(SimulationStore, TheHeadIsAllButHistoryAndCheckpoint) {
  io::write_simulation(path_, result_);
  const io::SimulationResult head = io::read_simulation_head(path_);
  EXPECT_TRUE(head.values.empty() && head.checkpoint.empty());
  // Written again it equals a simulation that has neither.
  io::SimulationResult rest = io::read_simulation(path_);
  rest.values.clear();
  rest.checkpoint.clear();
  const std::filesystem::path other = folder_.path() / "rest.h5";
  io::write_simulation(other, rest);
  io::write_simulation(path_, head);
  EXPECT_EQ(head.columns.size(), 4u);
  EXPECT_EQ(head.summary.size(), 2u);
  EXPECT_TRUE(testing::read_text(path_) == testing::read_text(other));
}

TEST_F(SimulationStore, EqualResultsGiveEqualBytes) {
  io::write_simulation(path_, result_);
  const std::string first = testing::read_text(path_);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 counts time in seconds
  result_.snapshots.cases[0].seconds = 77.0;
  result_.snapshots.seconds = 99.0;
  const std::filesystem::path other = folder_.path() / "another name.h5";
  io::write_simulation(other, result_);
  EXPECT_TRUE(testing::read_text(other) == first);
  result_.values[5] += 1e-9;
  io::write_simulation(other, result_);
  EXPECT_FALSE(testing::read_text(other) == first);
}

TEST_F(SimulationStore, SnapshotsLieAsTheCasesOfARun) {
  io::write_simulation(path_, result_);
  const io::Hdf5Reader file(path_);
  const io::Hdf5GroupReader one = file.root().open_group("fields").open_group("case_0001");
  const io::Hdf5GroupReader patch = one.open_group("patch_2");
  EXPECT_EQ(patch.numbers("pressure"), result_.snapshots.cases[0].patches[1].fields.pressure);
  EXPECT_EQ(patch.text_of("pressure", "unit"), "Pa");
  EXPECT_EQ(one.text("status"), "ok");
}

TEST_F(SimulationStore, TheCheckpointComesWithItsIdentity) {
  io::write_simulation(path_, result_);
  io::SimulationCheckpoint read = io::read_checkpoint(path_);
  EXPECT_EQ(read.bytes, result_.checkpoint);
  EXPECT_EQ(read.version, result_.version);
  EXPECT_EQ(read.git, result_.git);
  EXPECT_EQ(read.input_sha256, result_.input_sha256);
  EXPECT_EQ(read.settings, result_.settings);
  EXPECT_EQ(read.geometry_sha256, result_.geometry_sha256);
  result_.checkpoint.clear();
  io::write_simulation(path_, result_);
  EXPECT_TRUE(io::read_checkpoint(path_).bytes.empty());
  EXPECT_FALSE(io::Hdf5Reader(path_).root().has("checkpoint"));
}

TEST_F(SimulationStore, AnEmptySimulationIsOneToo) {
  io::write_simulation(path_, {});
  const io::SimulationResult read = io::read_simulation(path_);
  EXPECT_TRUE(read.columns.empty() && read.values.empty() && read.events.empty() && read.modes.empty());
  EXPECT_EQ(read.status, "complete");
  result_.values.clear();  // columns without an instant
  io::write_simulation(path_, result_);
  EXPECT_EQ(io::read_simulation(path_).columns.size(), 4u);
}

TEST_F(SimulationStore, RefusesRowsThatAreNotWhole) {
  result_.values.pop_back();
  expect_refused("8003 values are no whole rows of 4 columns");
}

TEST_F(SimulationStore, RefusesTimesThatDoNotFitTheSnapshots) {
  result_.snapshot_times.pop_back();
  expect_refused("3 times for 4 snapshots");
}

TEST_F(SimulationStore, RefusesNamesThatCannotBe) {
  result_.columns[1].name = "t_s";
  expect_refused("two columns have the name t_s");
  result_.columns[1].name = "a/b";
  expect_refused("\"a/b\" cannot be the name of a column");
  result_.columns[1].name = "";
  expect_refused("\"\" cannot be");
}

TEST_F(SimulationStore, RefusesOtherContradictions) {
  result_.snapshots.cases[1].number = result_.snapshots.cases[0].number;
  expect_refused("two snapshots have the number 1");
  result_ = testing::sample_simulation(1.0);
  result_.status = "done";
  expect_refused("\"done\" is no status");
  result_ = testing::sample_simulation(1.0);
  result_.snapshots.cases[0].patches[1].fields.slip_x.pop_back();
  expect_refused("field slip_x has 479 values on a grid of 480 elements");
}

void expect_unreadable(const std::filesystem::path& path) {
  try {
    io::read_simulation(path);
    FAIL() << path;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_EQ(error.where().file, path.string());
  }
  EXPECT_THROW(io::read_simulation_head(path), Error);
  EXPECT_THROW(io::read_checkpoint(path), Error);
}

TEST_F(SimulationStore, OtherFilesAreRefused) {
  expect_unreadable(folder_.path() / "none.h5");
  std::ofstream(path_) << "not HDF5";
  expect_unreadable(path_);
  {
    io::Hdf5Writer file(path_);
    file.root().add({"format", std::string("something else")});
    file.commit();
  }
  expect_unreadable(path_);
  io::write_simulation(path_, result_);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  expect_unreadable(path_);
}

TEST_F(SimulationStore, SnapshotsComeBackWithTimesFlagsAndSurfaces) {
  result_.snapshots.sampled = testing::sample_surfaces();
  result_.snapshots.cases[0].wheel_surface = "wheel_1";
  result_.snapshots.cases[0].bodies =
      io::CaseResult::Bodies{{Vec3(0.1, 0.2, 0.3), rotation_y(1.0)}, {Vec3(0.4, 0.5, 0.6), rotation_x(0.1)}};
  result_.snapshot_scenes.resize(result_.snapshots.cases.size());
  result_.snapshot_scenes[0].nominal = true;
  result_.snapshot_scenes[2].drawn = true;
  for (io::CaseResult& c : result_.snapshots.cases)
    for (io::PatchResult& patch : c.patches) patch.npot = static_cast<int>(patch.fields.grid.size());
  io::write_simulation(path_, result_);
  const io::SnapshotSeries read = io::read_snapshots(path_);
  EXPECT_EQ(read.run.version, result_.version);
  EXPECT_EQ(read.run.git, result_.git);
  EXPECT_EQ(read.times, result_.snapshot_times);
  ASSERT_EQ(read.scenes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read.scenes[i].nominal, i == 0);
    EXPECT_EQ(read.scenes[i].drawn, i == 2);
    testing::expect_same_case(read.run.cases[i], result_.snapshots.cases[i], false);
    EXPECT_EQ(read.run.cases[i].seconds, 0.0);
  }
  ASSERT_EQ(read.run.sampled.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) testing::expect_same_surface(read.run.sampled[i], result_.snapshots.sampled[i]);

  result_.snapshots = {};
  result_.snapshot_times.clear();
  result_.snapshot_scenes.clear();
  io::write_simulation(path_, result_);
  EXPECT_TRUE(io::read_snapshots(path_).run.cases.empty());
  io::write_hdf5(path_, testing::sample_run());
  EXPECT_THROW(io::read_snapshots(path_), Error);
}

}  // namespace
}  // namespace treadmark
