// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Resume : public ::testing::Test {
 protected:
  void SetUp() override { input.edit("simulation.toml", "distance_m = 0.06", "distance_m = 0.15"); }

  std::vector<std::string> command(const std::string& folder, std::vector<std::string> options = {}) const {
    options.insert(options.begin(),
                   {"treadmark", "simulate", input.path("simulation.toml"), "--quiet", "-o", input.path(folder)});
    return options;
  }
  /// Lets the program run until it has written a checkpoint that was not there before, and a little longer. False: it
  /// ended before.
  bool wait_for_checkpoint(RunningProgram& program, const std::string& folder) const {
    const fs::path file = input.path(folder + "/unfinished.h5");
    std::error_code none;
    const auto before = fs::last_write_time(file, none);
    const bool was_there = !none;
    while (program.running()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      const auto now = fs::last_write_time(file, none);
      if (!none && (!was_there || now != before)) return true;
    }
    return false;
  }
  void expect_same(const std::string& one, const std::string& other) const {
    for (const char* file : {"simulation.h5", "history.csv", "events.csv", "history.svg"}) {
      const std::string bytes = input.read(one + '/' + file);
      EXPECT_FALSE(bytes.empty()) << file;
      EXPECT_TRUE(bytes == input.read(other + '/' + file)) << file << " differs";
    }
  }
  /// A run that is killed and resumed several times gives the bytes of an undisturbed one.
  void expect_kills_to_change_nothing() const {
    ASSERT_EQ(RunningProgram(command("undisturbed")).wait().status, 0);
    int resumed = 0;
    for (const int delay_ms : {0, 20, 60, 150}) {
      RunningProgram program(command("killed"));
      if (!wait_for_checkpoint(program, "killed")) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
      program.send(SIGKILL);
      program.wait();
      ++resumed;
    }
    EXPECT_GE(resumed, 1) << "never killed between the first checkpoint and the end";
    input.write("killed/.history.csv.part1-0", "what a kill in the middle of writing leaves");
    const ProgramResult last = RunningProgram(command("killed")).wait();
    ASSERT_EQ(last.status, 0) << last.err;
    expect_same("undisturbed", "killed");
    for (const auto& entry : fs::directory_iterator(input.path("killed")))
      EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << "left behind: " << entry.path();
  }
  SampleSimulation input;
};

TEST_F(Resume, AfterKillsTheResultIsThatOfAnUndisturbedRun) { expect_kills_to_change_nothing(); }

TEST_F(Resume, RailsThatBendGoOnInTheMiddle) {
  input.edit("simulation.toml", "\"track.toml\"",
             "\"" + std::string(TREADMARK_SOURCE_DIR) + "/examples/tracks/zhai-sideways.toml\"\nfrom_midspan_mm = 250");
  input.edit("simulation.toml", "[case]", "[simulation.speed_profile]\ntime_s = [1]\nspeed_m_s = [19]\n\n[case]");
  expect_kills_to_change_nothing();
}

TEST_F(Resume, WheelsThatShareRailsGoOnInTheMiddle) {
  input.share_rails();
  expect_kills_to_change_nothing();
}

TEST_F(Resume, WhatSticksAndSlidesGoesOnInTheMiddle) {
  input.edit("vehicle.toml", "[[bump_stops]]",
             "[[frictions]]\nname = \"leaf\"\nbetween = [\"axle\", \"mass\"]\nat_m = [[0, -1, -0.46], [0, 1, -0.46]]\n"
             "directions = [\"y\", \"z\"]\nstiffness_N_per_m = 5e7\ncoefficient = 0.02\nstatic_ratio = 1.2\n"
             "load_of = [\"primary\"]\n\n[[damper_curves]]\nname = \"blows_off\"\nbetween = [\"axle\", \"mass\"]\n"
             "at_m = [[0, 0, -0.6]]\ndirection = \"z\"\nvelocity_m_s = [0, 0.01, 0.1]\nforce_N = [0, 500, 800]\n"
             "series_stiffness_N_per_m = 2e6\n\n[[bump_stops]]");
  input.edit("simulation.toml", "[case]",
             "[[simulation.forces]]\nbody = \"mass\"\ndirection = \"z\"\ntime_s = [0, 0.004]\nforce_N = [0, 9e3]\n"
             "[[simulation.rail_shifts]]\nside = \"left\"\ndirection = \"z\"\ntime_s = [0, 0.005]\n"
             "displacement_mm = [0, 0.2]\n\n[case]");
  expect_kills_to_change_nothing();
}

TEST_F(Resume, PeaksBetweenTheLinesOutliveKills) {
  input.edit("simulation.toml", "distance_m = 0.15", "distance_m = 0.15\noutput_every_mm = 60");
  expect_kills_to_change_nothing();
}

TEST_F(Resume, WithContactsThatChangeOver) {
  input.edit("simulation.toml", "defects = false\n", "defects = false\nfull_to_m = 0.12\n");
  expect_kills_to_change_nothing();
}

TEST_F(Resume, WithContactsThatAreChosen) {
  input.edit("simulation.toml", "contact = \"full\"\ndefects = false\n", "contact = \"auto\"\ndefects = false\n");
  input.edit("simulation.toml", "distance_m = 0.15", "distance_m = 0.15\nauto_force_error = 1e-9");
  expect_kills_to_change_nothing();
  EXPECT_NE(input.read("killed/events.csv").find("full contact from here"), std::string::npos);
}

TEST_F(Resume, OnALineWithChangingSpeed) {
  input.edit("simulation.toml", "[case]",
             "[simulation.speed_profile]\ntime_s = [1]\nspeed_m_s = [19]\n[layout]\n[[layout.elements]]\n"
             "kind = \"straight\"\nlength_m = 0.03\n[[layout.elements]]\nkind = \"transition\"\nlength_m = 0.05\n"
             "[[layout.elements]]\nkind = \"curve\"\nlength_m = 5\nradius_m = 3000\n[irregularities]\nbegin_m = 0\n"
             "wind_up_m = 0.1\nshortest_wavelength_m = 0.1\nlongest_wavelength_m = 1\n"
             "[[irregularities.spectra]]\nfunction = \"longitudinal_level\"\nform = \"two_poles\"\n"
             "amplitude_m_rad = 2e-7\nomega_c_rad_m = 0.8246\n\n[case]");
  expect_kills_to_change_nothing();
}

TEST_F(Resume, KilledBeforeTheFirstCheckpoint) {
  ASSERT_EQ(RunningProgram(command("undisturbed")).wait().status, 0);
  for (const int delay_ms : {0, 30, 120}) {
    RunningProgram program(command("killed", {"--resume"}));
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    program.send(SIGKILL);
    program.wait();
  }
  ASSERT_EQ(RunningProgram(command("killed", {"--resume"})).wait().status, 0);
  expect_same("undisturbed", "killed");
}

TEST_F(Resume, AfterAnInterruptTheMessageSaysHowToGoOn) {
  ASSERT_EQ(RunningProgram(command("undisturbed")).wait().status, 0);
  RunningProgram program(command("stopped"));
  ASSERT_TRUE(wait_for_checkpoint(program, "stopped"));
  program.send(SIGINT);
  const ProgramResult stopped = program.wait();
  EXPECT_EQ(stopped.status, 1);
  EXPECT_THAT(stopped.err, HasSubstr("the same command goes on"));
  EXPECT_THAT(stopped.out, HasSubstr("interrupted"));
  EXPECT_TRUE(fs::exists(input.path("stopped/history.csv"))) << "what there is";
  std::vector<std::string> again = command("stopped");
  std::erase(again, "--quiet");
  const ProgramResult resumed = RunningProgram(again).wait();
  ASSERT_EQ(resumed.status, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("goes on with the interrupted simulation"));
  expect_same("undisturbed", "stopped");
}

TEST_F(Resume, OtherInputIsRefused) {
  RunningProgram program(command("stopped"));
  ASSERT_TRUE(wait_for_checkpoint(program, "stopped"));
  program.send(SIGKILL);
  program.wait();
  const std::string kept = input.read("stopped/unfinished.h5");
  const auto expect_refused = [&](const std::vector<std::string>& options) {
    const ProgramResult r = RunningProgram(command("stopped", options)).wait();
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_THAT(r.err, AllOf(HasSubstr("another simulation"), HasSubstr("--anew")));
    EXPECT_TRUE(kept == input.read("stopped/unfinished.h5")) << "the checkpoint must stay";
  };
  expect_refused({"--resume", "--set", "simulation.speed_m_s=21"});
  expect_refused({"--set", "simulation.speed_m_s=21"});
  input.edit("vehicle.toml", "mass_kg = 9000", "mass_kg = 9100");
  expect_refused({"--resume"});
  input.edit("vehicle.toml", "mass_kg = 9100", "mass_kg = 9000");
  input.edit("simulation.toml", "distance_m = 0.15", "distance_m = 0.16");
  expect_refused({"--resume"});
  input.edit("simulation.toml", "distance_m = 0.16", "distance_m = 0.15");
  EXPECT_EQ(RunningProgram(command("stopped", {"--resume"})).wait().status, 0);
  input.write("stopped/unfinished.h5", kept);
  EXPECT_EQ(RunningProgram(command("stopped", {"--anew", "--set", "simulation.distance_m=0.01"})).wait().status, 0);
  EXPECT_FALSE(fs::exists(input.path("stopped/unfinished.h5")));
}

TEST_F(Resume, AFinishedResultStaysAsItIs) {
  input.edit("simulation.toml", "distance_m = 0.15", "distance_m = 0.02");
  ASSERT_EQ(RunningProgram(command("done")).wait().status, 0);
  const std::string before = input.read("done/simulation.h5");
  const ProgramResult again = RunningProgram(command("done", {"--resume"})).wait();
  EXPECT_EQ(again.status, 0);
  EXPECT_THAT(again.err, HasSubstr("complete already"));
  const ProgramResult other = RunningProgram(command("done", {"--resume", "--set", "simulation.speed_m_s=21"})).wait();
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("another simulation"));
  EXPECT_TRUE(before == input.read("done/simulation.h5"));
}

TEST_F(Resume, TwoSimulationsDoNotShareAFolder) {
  RunningProgram first(command("shared"));
  ASSERT_TRUE(wait_for_checkpoint(first, "shared"));
  const ProgramResult second = RunningProgram(command("shared", {"--resume"})).wait();
  EXPECT_EQ(second.status, 2);
  EXPECT_THAT(second.err, HasSubstr("another simulation is writing"));
  EXPECT_EQ(first.wait().status, 0);
}

}  // namespace
}  // namespace treadmark::testing
