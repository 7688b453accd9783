// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/study_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

class StudyStore : public ::testing::Test {
 protected:
  StudyStore() {
    study_.version = "0.1.0";
    study_.input_file = "study.toml";
    for (int i = 1; i <= 3; ++i) {
      const io::SimulationResult result = testing::sample_simulation(20.0 * i, 201);
      io::SimulationRun run;
      run.number = i;
      run.swept = {{"vehicle.speed", std::to_string(20 * i)}, {"rail.cant", i == 2 ? "1:40, \"new\"" : "0"}};
      run.label = "V" + std::to_string(i);
      run.status = "complete";
      run.summary = result.summary;
      run.store = folder_.path() / ("run" + std::to_string(i) + ".h5");
      io::write_simulation(run.store, result);
      study_.runs.push_back(run);
    }
    io::SimulationRun failed;
    failed.number = 4;
    failed.swept = {{"vehicle.speed", "1e4"}};
    failed.status = "failed";
    failed.message = "no balance, see log";
    study_.runs.push_back(failed);
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "study.h5";
  io::StudyResult study_;
};

TEST_F(StudyStore, ItsHeadReadsBack) {
  study_.title = "Speeds <and> cants";
  study_.input_sha256 = "abc";
  study_.settings = {"a=1", "b=\"2\""};
  study_.labels = {{"rail.cant", "cant of the rails"}};
  io::write_study_store(path_, study_);
  const io::StudyResult head = io::read_study_head(path_);
  EXPECT_EQ(head.title, study_.title);
  EXPECT_EQ(head.version, study_.version);
  EXPECT_EQ(head.input_file, "study.toml");
  EXPECT_EQ(head.input_sha256, "abc");
  EXPECT_EQ(head.settings, study_.settings);
  EXPECT_EQ(head.labels, study_.labels);
  EXPECT_EQ(io::label_of_key(head, "vehicle.speed"), "vehicle.speed");
  EXPECT_THROW(io::read_study_head(study_.runs.front().store), Error);
}

TEST_F(StudyStore, HoldsTheRunsAndTheTable) {
  io::write_study_store(path_, study_);
  const io::Hdf5Reader file(path_);
  const io::Hdf5GroupReader& root = file.root();
  EXPECT_EQ(root.text("input"), "study.toml");
  for (int i = 1; i <= 3; ++i) {
    const io::Hdf5GroupReader run = root.open_group("run_000" + std::to_string(i));
    const io::SimulationResult alone = io::read_simulation(study_.runs[static_cast<std::size_t>(i - 1)].store);
    EXPECT_EQ(run.text("title"), alone.title);
    EXPECT_EQ(run.open_group("history").numbers("ws1_right.Q_N"), io::column_values(alone, 2));
    EXPECT_TRUE(run.open_group("fields").has("case_0001"));
  }
  EXPECT_FALSE(root.has("run_0004"));
  const io::Hdf5GroupReader sweep = root.open_group("sweep");
  EXPECT_EQ(sweep.numbers("number"), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(sweep.strings("status").at(3), "failed");
  EXPECT_EQ(sweep.open_group("swept").strings("rail.cant"), (std::vector<std::string>{"0", "1:40, \"new\"", "0", ""}));
  const auto peaks = sweep.open_group("summary").numbers("q_max_N");
  EXPECT_EQ(peaks.at(1), study_.runs[1].summary[0].value);
  EXPECT_TRUE(std::isnan(peaks.at(3)));
  EXPECT_EQ(sweep.open_group("summary").text_of("q_max_N", "unit"), "N");
}

TEST_F(StudyStore, TheOrderOfTheRunsDoesNotMatter) {
  io::write_study_store(path_, study_);
  const std::string first = testing::read_text(path_);
  std::reverse(study_.runs.begin(), study_.runs.end());
  std::swap(study_.runs[0], study_.runs[2]);
  io::write_study_store(path_, study_);
  EXPECT_TRUE(testing::read_text(path_) == first);
}

TEST_F(StudyStore, TheTableBeginsWithTheSweptKeys) {
  std::reverse(study_.runs.begin(), study_.runs.end());
  io::write_sweep_csv(folder_.path() / "sweep.csv", study_);
  const auto lines = testing::read_lines(testing::read_text(folder_.path() / "sweep.csv"));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "vehicle.speed,rail.cant,q_max_N,q_min_N,run,label,status,message");
  const std::string first = "40,\"1:40, \"\"new\"\"\",";
  EXPECT_EQ(lines[2].substr(0, first.size()), first);
  EXPECT_EQ(std::stod(lines[2].substr(first.size())), study_.runs[2].summary[0].value);
  EXPECT_EQ(lines[4], "1e4,,,,4,,failed,\"no balance, see log\"");
}

TEST_F(StudyStore, RefusesWhatIsThereTwiceAndWhatIsNot) {
  io::StudyResult twice = study_;
  twice.runs[1].number = 1;
  EXPECT_THROW(io::write_study_store(path_, twice), Error);
  twice = study_;
  twice.runs[0].swept.push_back(twice.runs[0].swept.front());
  EXPECT_THROW(io::write_sweep_csv(path_, twice), Error);
  study_.runs[2].store = folder_.path() / "none.h5";
  try {
    io::write_study_store(path_, study_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_NE(std::string(error.what()).find("none.h5"), std::string::npos);
  }
  EXPECT_EQ(folder_.count_files(), 3u);
}

}  // namespace
}  // namespace treadmark
