// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
namespace fs = std::filesystem;

/// Of a table whose rows may be folded.
long rows_of(const std::string& table) {
  std::istringstream words(table);
  return std::count(std::istream_iterator<std::string>(words), {}, "complete");
}

class Sweep : public ::testing::Test {
 protected:
  std::vector<std::string> command(const std::string& folder, std::vector<std::string> options = {}) const {
    options.insert(options.begin(), {"treadmark", "sweep", input.path("study.toml"), "-o", input.path(folder)});
    return options;
  }
  ProgramResult run(const std::string& folder, const std::vector<std::string>& options = {}) const {
    return RunningProgram(command(folder, options)).wait();
  }
  /// Waits until something of the study has been solved, or at least begun. False: the program ended before.
  bool wait_for(RunningProgram& program, const std::string& file) const {
    while (program.running()) {
      if (fs::exists(input.path(file))) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  void expect_same(const std::string& one, const std::string& other) const {
    for (const char* file : {"sweep.h5", "sweep.csv", "force-by-distance.svg", "force-by-distance.csv",
                             "force-by-speed.svg", "force-by-speed.csv"}) {
      const std::string bytes = input.read(one + '/' + file);
      EXPECT_FALSE(bytes.empty()) << file;
      EXPECT_TRUE(bytes == input.read(other + '/' + file)) << file << " differs";
    }
  }
  /// Four processes of mpirun do what one does.
  void expect_same_under_mpirun(int runs, const std::vector<std::string>& options = {}) const {
    try {
      if (RunningProgram({"mpirun", "--version"}).wait().status != 0) throw std::runtime_error("mpirun does not run");
    } catch (const std::exception& e) {
      const char* in_ci = getenv("CI");
      if (in_ci != nullptr && std::string(in_ci) == "true") FAIL() << e.what();
      GTEST_SKIP() << e.what() << ": install openmpi-bin";
    }
    ASSERT_EQ(run("alone", options).status, 0);
    std::vector<std::string> together{"mpirun", "--oversubscribe", "--allow-run-as-root", "-n", "4"};
    const std::vector<std::string> each = command("together", options);
    together.insert(together.end(), each.begin(), each.end());
    const ProgramResult r = RunningProgram(together).wait();
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_EQ(rows_of(r.out), runs) << "one process prints the table: " << r.out;
    expect_same("alone", "together");
  }
  SampleSimulation input;
};

TEST_F(Sweep, WritesTableStoreAndFigures) {
  const ProgramResult r = run("out");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(rows_of(r.out), 4) << r.out;
  EXPECT_THAT(r.out, HasSubstr("40, 0.9"));
  const std::string table = input.read("out/sweep.csv");
  EXPECT_THAT(table, StartsWith("simulation.speed_m_s,wheel.flats.0.depth_mm,"));
  EXPECT_EQ(ranges::count(table, '\n'), 5);
  EXPECT_THAT(input.read("out/force-by-speed.svg"), HasSubstr("<svg"));
  const ProgramResult again = run("out", {"--resume"});
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("4 of 4 runs were finished already"));
  EXPECT_EQ(again.out, r.out);
}

TEST_F(Sweep, ARunEqualsItsSimulationAlone) {
  ASSERT_EQ(run("out").status, 0);
  ASSERT_EQ(run_program({"simulate", input.path("simulation.toml"), "-o", input.path("alone"), "--set",
                         "simulation.speed_m_s=40", "--set", "wheel.flats.0.depth_mm=0.5"})
                .status,
            0);
  // The history as drawn by the study has run, distance and force of each instant.
  const std::string history = input.read("alone/history.csv"),
                    last = history.substr(history.rfind('\n', history.size() - 2) + 1);
  const std::string force = last.substr(0, last.find(',', last.find(',', last.find(',') + 1) + 1));
  const std::string distance_and_force = force.substr(force.find(',') + 1);
  EXPECT_THAT(input.read("out/force-by-distance.csv"), HasSubstr(distance_and_force));
}

TEST_F(Sweep, AnyNumberOfThreadsGivesTheSameBytes) {
  ASSERT_EQ(run("one", {"--threads", "1"}).status, 0);
  ASSERT_EQ(run("two", {"--threads", "2"}).status, 0);
  expect_same("one", "two");
}

TEST_F(Sweep, GoesOnWhereItWasKilled) {
  ASSERT_EQ(run("undisturbed").status, 0);
  int kills = 0;
  for (const char* file :
       {"runs/run_0001/unfinished.h5", "runs/run_0002/simulation.h5", "runs/run_0003/unfinished.h5"}) {
    RunningProgram program(command("killed", {"--threads", "1"}));
    if (!wait_for(program, std::string("killed/") + file)) continue;
    program.send(SIGKILL);
    program.wait();
    ++kills;
  }
  EXPECT_GE(kills, 1);
  const ProgramResult last = run("killed");
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_THAT(last.err, HasSubstr("finished already"));
  expect_same("undisturbed", "killed");
}

TEST_F(Sweep, AnInterruptSaysHowToGoOn) {
  RunningProgram program(command("stopped", {"--threads", "1"}));
  ASSERT_TRUE(wait_for(program, "stopped/runs/run_0001/lock"));
  program.send(SIGINT);
  const ProgramResult stopped = program.wait();
  EXPECT_EQ(stopped.status, 1);
  EXPECT_THAT(stopped.err, HasSubstr("of 4 runs finished; the same command goes on"));
  EXPECT_FALSE(fs::exists(input.path("stopped/sweep.h5")));
  EXPECT_EQ(run("stopped", {"--resume"}).status, 0);
  EXPECT_TRUE(fs::exists(input.path("stopped/sweep.h5")));
}

TEST_F(Sweep, TheOtherProcessFinishesWhatAKilledOneLeft) {
  ASSERT_EQ(run("undisturbed").status, 0);
  RunningProgram first(command("shared", {"--threads", "1"}));
  ASSERT_TRUE(wait_for(first, "shared/runs/run_0001/lock"));
  RunningProgram second(command("shared", {"--threads", "1"}));
  ASSERT_TRUE(wait_for(second, "shared/runs/run_0002/lock")) << "the second takes another run than the first";
  first.send(SIGKILL);
  first.wait();
  const ProgramResult r = second.wait();
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same("undisturbed", "shared");
}

TEST_F(Sweep, ProcessesOfMpirunGiveTheSameBytes) { expect_same_under_mpirun(4); }

/// Rails and wheelsets that bend, and a curve on irregular track.
TEST_F(Sweep, EveryKindOfTrackAndVehicleGivesTheSameBytes) {
  const std::string examples = TREADMARK_SOURCE_DIR "/examples/";
  input.write("study.toml", "study.title = \"Kinds\"\nstudy.base = \"" + examples + R"toml(curve.toml"
[[study.vary]]
label = "kind"
values = [
  { label = "curve", set = ["simulation.distance_m=5"] },
  { label = "flexible wheelsets", set = ["simulation.vehicle=vehicles/manchester-flexible.toml", "simulation.distance_m=0.2"] },
  { label = "flexible rails", set = ["simulation.track=tracks/zhai-sideways.toml", "simulation.distance_m=0.5"] },
]
[[study.figures]]
file = "force-by-distance.svg"
kind = "history"
x = "x_m"
y = ["Q_N"]
[[study.figures]]
file = "force-by-speed.svg"
kind = "history"
x = "x_m"
y = ["Y_N"]
)toml");
  expect_same_under_mpirun(3, {"--set", "simulation.output_every_mm=5"});
  ASSERT_EQ(run("one", {"--threads", "1", "--set", "simulation.output_every_mm=5"}).status, 0);
  expect_same("alone", "one");
}

TEST_F(Sweep, AnotherStudyInTheSameFolderIsRefused) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
  const ProgramResult none = run("out", {"--resume"});
  EXPECT_EQ(none.status, 2);
  EXPECT_THAT(none.err, HasSubstr("no study to go on with"));
  EXPECT_FALSE(fs::exists(input.path("out")));
  ASSERT_EQ(run("out").status, 0);
  const std::string table = input.read("out/sweep.csv");
  const auto expect_refused = [&](const std::vector<std::string>& options) {
    const ProgramResult r = run("out", options);
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_THAT(r.err, HasSubstr("another study"));
    EXPECT_EQ(input.read("out/sweep.csv"), table);
  };
  expect_refused({"--set", "friction.coefficient=0.2"});
  input.edit("vehicle.toml", "mass_kg = 9000", "mass_kg = 9100");
  expect_refused({});
  input.edit("vehicle.toml", "mass_kg = 9100", "mass_kg = 9000");
  input.edit("study.toml", "values = [20, 40]", "values = [20, 30]");
  expect_refused({});
}

TEST_F(Sweep, FiguresMayChangeWithoutRunningAgain) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
  ASSERT_EQ(run("out").status, 0);
  input.edit("study.toml", "y = [\"Q_N\"]", "y = [\"Ty_N\"]");
  const ProgramResult r = run("out");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.err, HasSubstr("4 of 4 runs were finished already"));
  EXPECT_THAT(input.read("out/force-by-distance.csv"), HasSubstr("Ty_N"));
}

TEST_F(Sweep, NamesInFiguresThatNoRunHasAreRefusedBeforeAnyRun) {
  const auto expect_refused = [&](const std::string& right, const std::string& wrong, const std::string& advice) {
    input.edit("study.toml", right, wrong);
    for (const char* verb : {"check", "sweep"}) {
      std::vector<std::string> call{verb, input.path("study.toml")};
      if (call.front() == "sweep") call.insert(call.end(), {"-o", input.path("out")});
      const ProgramResult r = run_program(call);
      EXPECT_EQ(r.status, 2) << r.out;
      EXPECT_THAT(r.err, AllOf(HasSubstr("study.toml:"), HasSubstr(advice)));
      EXPECT_FALSE(fs::exists(input.path("out/runs/run_0001")));
    }
    input.edit("study.toml", wrong, right);
  };
  expect_refused("y = [\"q_max_N\"]", "y = [\"max_normal_force_N\"]", "there are: q_max_N, q_max_t_s");
  expect_refused("y = [\"Q_N\"]", "y = [\"Q_n\"]", "did you mean 'Q_N'?");
  expect_refused("x = \"x_m\"", "x = \"distance_m\"", "the column 'distance_m' is not known");
}

TEST_F(Sweep, AFigureMayShowWhatOnlySomeRunsHave) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
  input.edit(
      "study.toml", "[[study.vary]]\nkey = \"wheel.flats.0.depth_mm\"\nvalues = [0.5, 0.9]",
      "[[study.vary]]\nlabel = \"contact\"\nvalues = [{ label = \"table\", set = "
      "[\"simulation.wheels.0.contact=table\"] }, { label = \"full\", set = [\"simulation.wheels.0.contact=full\"] }]");
  input.edit("study.toml", "wheel.flats.0.depth_mm", "contact");
  input.edit("study.toml", "q_max_N", "pmax_Pa");
  const ProgramResult r = run_program({"check", input.path("study.toml")});
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(Sweep, AFailedRunIsAResult) {
  input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.01");
  input.edit("study.toml", "key = \"wheel.flats.0.depth_mm\"\nvalues = [0.5, 0.9]",
             "label = \"steps\"\nvalues = [{ label = \"free\", set = [\"simulation.min_step_us=0.001\"] },\n"
             "{ label = \"coarse\", set = [\"simulation.min_step_us=1\", \"simulation.max_step_us=2\", "
             "\"simulation.tolerance_um=1e-9\"] }]");
  input.edit("study.toml", "series = \"wheel.flats.0.depth_mm\"", "series = \"steps\"");
  const ProgramResult r = run("out");
  EXPECT_EQ(r.status, 1) << r.err;
  const std::string table = input.read("out/sweep.csv");
  EXPECT_THAT(table, HasSubstr(",complete,"));
  EXPECT_THAT(table, HasSubstr(",failed,"));
}

TEST_F(Sweep, CasesMayBeSweptToo) {
  input.write(
      "case.toml",
      "[wheel]\nshape.standard = \"S1002\"\n[rail]\nshape.standard = \"60E1\"\n[track]\ncant = \"1:40\"\n[wheelset]\n"
      "vertical_force_N = 60e3\nnominal_radius_mm = 460\n[discretisation]\ndx_mm = 1\nds_mm = 1\n");
  input.write(
      "study.toml",
      "[study]\nbase = \"case.toml\"\n[[study.vary]]\nkey = \"wheelset.y_mm\"\nvalues = [0, 2]\n"
      "[[study.vary]]\nkey = \"wheelset.vertical_force_N\"\nvalues = [50e3, 100e3]\n"
      "[[study.figures]]\nfile = \"pressure.svg\"\nkind = \"summary\"\nx = \"wheelset.y_mm\"\ny = [\"pmax_Pa\"]\n"
      "series = \"wheelset.vertical_force_N\"\n");
  const ProgramResult r = run("out");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fs::exists(input.path("out/pressure.svg")));
  EXPECT_TRUE(fs::exists(input.path("out/pressure.csv")));
  ASSERT_EQ(run("again", {"--threads", "1"}).status, 0);
  for (const char* file : {"sweep.h5", "sweep.csv", "pressure.svg"})
    EXPECT_TRUE(input.read(std::string("out/") + file) == input.read(std::string("again/") + file)) << file;
}

}  // namespace
}  // namespace treadmark::testing
