// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr int kPackagesAreMissing = 77;

ProgramResult shell(const std::string& command) { return RunningProgram({"bash", "-c", command}).wait(); }

class SlurmSweep : public ::testing::Test {
 protected:
  ProgramResult sweep(const std::string& folder, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"sweep", input.path("study.toml"), "-o", input.path(folder)});
    return run_program(options);
  }
  SampleSimulation input;
};

TEST_F(SlurmSweep, SharesOfRunsMakeTheWhole) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
  ASSERT_EQ(sweep("alone").status, 0);
  EXPECT_EQ(sweep("shared", {"--merge"}).status, 2) << "there is no study to gather";
  ASSERT_EQ(sweep("shared", {"--runs", "2-3"}).status, 0);
  EXPECT_FALSE(fs::exists(input.path("shared/sweep.h5")));
  EXPECT_THAT(sweep("shared", {"--status"}).out, HasSubstr("4 runs: 2 finished, 0 being solved, 0 interrupted"));
  const ProgramResult early = sweep("shared", {"--merge"});
  EXPECT_EQ(early.status, 1);
  EXPECT_THAT(early.err, HasSubstr("nothing is gathered yet: 2 of 4 runs finished"));
  EXPECT_THAT(sweep("shared", {"--runs", "5-6"}).err, HasSubstr("its runs are 1 to 4"));
  for (const char* none : {"2", "1-99999999999", "1--5", "1-2x", "-"})
    EXPECT_THAT(sweep("shared", {"--runs", none}).err, HasSubstr("for example --runs 11-20")) << none;
  ASSERT_EQ(sweep("shared", {"--runs", "4-9"}).status, 0);
  ASSERT_EQ(sweep("shared", {"--runs", "1-1"}).status, 0);
  ASSERT_EQ(sweep("shared", {"--merge"}).status, 0);
  for (const char* file : {"sweep.h5", "sweep.csv", "force-by-speed.svg"})
    EXPECT_TRUE(input.read(std::string("alone/") + file) == input.read(std::string("shared/") + file)) << file;
  // A share knows its own part of the study by what it depends on.
  input.edit("study.toml", "values = [20, 40]", "values = [20, 41]");
  EXPECT_EQ(sweep("shared", {"--runs", "1-2"}).status, 0);
  EXPECT_THAT(sweep("shared", {"--runs", "2-3"}).err, HasSubstr("holds the results of another study"));
}

TEST_F(SlurmSweep, ScriptsDoWhatTheyAreFor) {
  const ProgramResult r =
      sweep("out", {"--slurm", "--slurm-tasks", "3", "--slurm-option=--partition=short", "--set", "title=\"it's\""});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("2 tasks"));
  EXPECT_THAT(r.out, HasSubstr("sh " + input.path("out/slurm/submit.sh")));
  const std::string array = input.read("out/slurm/array.sh");
  EXPECT_THAT(array, HasSubstr("#SBATCH --array=0-1\n")) << "two runs in each of two tasks";
  EXPECT_THAT(array, HasSubstr("#SBATCH --partition=short\n"));
  EXPECT_THAT(array, HasSubstr("'title=\"it'\\''s\"'"));
  // What Slurm would do.
  for (const char* task : {"0", "1"})
    EXPECT_EQ(shell(std::string("SLURM_ARRAY_TASK_ID=") + task + " sh " + input.path("out/slurm/array.sh")).status, 0);
  EXPECT_EQ(shell("sh " + input.path("out/slurm/merge.sh")).status, 0);
  EXPECT_TRUE(fs::exists(input.path("out/sweep.h5")));
  EXPECT_EQ(sweep("out", {"--slurm", "--slurm-option=partition"}).status, 2);
}

/// A cluster of two nodes on this machine.
class SlurmCluster : public SlurmSweep {
 protected:
  void SetUp() override {
    const ProgramResult started = sandbox("start");
    if (started.status == kPackagesAreMissing) {
      const char* in_ci = getenv("CI");
      if (in_ci != nullptr && std::string(in_ci) == "true") FAIL() << started.err;
      GTEST_SKIP() << started.err;
    }
    ASSERT_EQ(started.status, 0) << started.err << started.out;
    setenv("SLURM_CONF", input.path("cluster/slurm.conf").c_str(), 1);
  }
  void TearDown() override { sandbox("stop"); }
  ProgramResult sandbox(const std::string& action, const std::string& node = {}) const {
    return shell("bash " TREADMARK_SOURCE_DIR "/scripts/slurm-sandbox.sh " + action + ' ' + input.path("cluster") +
                 ' ' + node);
  }
  /// Waits until it is so; false: not within a minute.
  static bool until(const std::function<bool()>& so) {
    for (int i = 0; i < 1200; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(50)))
      if (so()) return true;
    return false;
  }
  std::string logs() const { return shell("tail -n +1 " + input.path("out/slurm/") + "*.log").out; }
};

TEST_F(SlurmCluster, ANodeThatDiesInTheMiddleLeavesTheBytesAsTheyAre) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.12");
  ASSERT_EQ(sweep("alone").status, 0);
  ASSERT_EQ(sweep("out", {"--slurm", "--slurm-tasks", "4"}).status, 0);
  const std::string submit = "sh " + input.path("out/slurm/submit.sh");
  const ProgramResult submitted = shell(submit);
  ASSERT_EQ(submitted.status, 0) << submitted.err;
  EXPECT_THAT(submitted.out, HasSubstr("gathers them"));
  EXPECT_THAT(sweep("out", {"--status"}).out,
              ContainsRegex("squeue -j 1,[0-9]"));  // tasks that begin at once take numbers, too
  const ProgramResult twice = shell(submit);
  EXPECT_EQ(twice.status, 1);
  EXPECT_THAT(twice.err, HasSubstr("still wait or run"));

  // The node that has come to a checkpoint loses its power.
  std::string node, task;
  ASSERT_TRUE(until([&] {
    for (const char* run : {"1", "2", "3", "4"})
      if (fs::exists(input.path(std::string("out/runs/run_000") + run + "/unfinished.h5"))) {
        task = std::to_string(std::stoi(run) - 1);
        node = shell("squeue -h -t R -o '%K %N' | awk '$1 == " + task + " { printf \"%s\", $2 }'").out;
      }
    return !node.empty();
  })) << logs();
  ASSERT_EQ(sandbox("kill", node).status, 0);
  // Slurm would find out by itself, and would let the task wait two minutes.
  shell("scontrol update NodeName=" + node + " State=DOWN Reason=dead");
  const auto requeued = [&] {
    // until its end is cleared away it still counts as completing
    return shell("squeue -h -o '%K %T %r' | grep -q '^" + task + " .*BeginTime'").status == 0;
  };
  ASSERT_TRUE(until(requeued)) << node << ' ' << task << '\n'
                               << shell("squeue -o '%i %K %T %N %r'; sinfo").out << logs();
  shell("scontrol update JobId=$(head -1 " + input.path("out/slurm/jobs") + ")_" + task + " StartTime=now");

  ASSERT_TRUE(until([&] { return fs::exists(input.path("out/written.id")); })) << logs() << shell("squeue; sinfo").out;
  for (const char* file : {"sweep.h5", "sweep.csv", "force-by-distance.svg", "force-by-speed.svg"})
    EXPECT_TRUE(input.read(std::string("alone/") + file) == input.read(std::string("out/") + file)) << file << logs();
  EXPECT_TRUE(until([&] { return shell("squeue -h").out.empty(); }));
  EXPECT_THAT(sweep("out", {"--status"}).out, HasSubstr("4 runs: 4 finished"));
  ASSERT_EQ(sweep("out", {"--slurm"}).status, 0);
  EXPECT_THAT(shell(submit).out, HasSubstr("all of which are finished"));
}

TEST_F(SlurmCluster, AFleetOfScansIsImportedAndMeasured) {
  for (const char* number : {"1", "2"})
    ASSERT_EQ(
        run_program({"scan", TREADMARK_SOURCE_DIR "/examples/wheel-flat.toml", "--body", "wheel", "--points", "40000",
                     "--noise-mm", "0.01", "--seed", number, "-o", input.path(std::string("wheel ") + number + ".ply")})
            .status,
        0);
  input.write("broken.ply", "ply\nformat ascii 1.0\nend_header\n");
  // As others write lists: ends of lines of Windows, an empty line, no end of the last line.
  input.write("scans.txt",
              input.path("wheel 1.ply") + "\r\n\r\n" + input.path("broken.ply") + "\n" + input.path("wheel 2.ply"));
  const auto submit = [&](const std::string& body) {
    return shell("cd / && TASKS=2 PATH=" + fs::path(TREADMARK_PROGRAM).parent_path().string() +
                 ":$PATH " TREADMARK_SOURCE_DIR "/examples/slurm/import-scans.sh " + body + ' ' +
                 input.path("scans.txt") + ' ' + input.path("fleet") + " --resolution 2 --nominal-radius 490");
  };
  EXPECT_THAT(submit("axle").err, HasSubstr("not of 'axle'"));
  const ProgramResult submitted = submit("wheel");
  ASSERT_EQ(submitted.status, 0) << submitted.err;
  EXPECT_THAT(submitted.out, HasSubstr("3 scans in 2 tasks"));
  EXPECT_THAT(submit("wheel").err, HasSubstr("still wait or run"));
  const auto finished = [&] { return shell("squeue -h").out.empty() && fs::exists(input.path("fleet/gather.out")); };
  ASSERT_TRUE(until(finished)) << shell("squeue; sinfo").out;
  EXPECT_THAT(input.read("fleet/gather.out"), HasSubstr("not imported: " + input.path("broken.ply")));
  EXPECT_THAT(input.read("fleet/gather.out"), HasSubstr("2 of 3 scans imported"));
  EXPECT_THAT(input.read("fleet/broken.log"), HasSubstr("broken.ply"));
  EXPECT_THAT(input.read("fleet/measures.csv"), HasSubstr("wheel 2.slcw"));
  ASSERT_EQ(run_program({"import", input.path("wheel 2.ply"), "--body", "wheel", "--resolution", "2",
                         "--nominal-radius", "490", "-o", input.path("wheel 2.slcw")})
                .status,
            0);
  EXPECT_TRUE(input.read("wheel 2.slcw") == input.read("fleet/wheel 2.slcw"));
  EXPECT_THAT(submit("wheel").out, HasSubstr("1 scans in 1 tasks")) << "what failed is taken up again";
  ASSERT_TRUE(until(finished));
}

}  // namespace
}  // namespace treadmark::testing
