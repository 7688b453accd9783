// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/falling_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

/// A wheelset that hangs softly on the ground below a guided load.
const char* kVehicle = R"([vehicle]
name = "softly held wheelset"

[[bodies]]
name = "load"
mass_kg = 9000.0
position_m = [0.0, 0.0, -1.0]
free = ["z"]

[[bodies]]
name = "wheelset"
mass_kg = 1813.0
inertia_kg_m2 = [1120.0, 112.0, 1120.0]
position_m = [0.0, 0.0, -0.46]
free = ["x", "y", "z", "roll", "pitch", "yaw"]

[[wheelsets]]
body = "wheelset"
nominal_radius_mm = 460.0

[[springs]]
name = "primary"
between = ["wheelset", "load"]
at_m = [[0.0, 0.0, -0.46]]
stiffness_N_per_m = [1e6, 5e5, 1e6]
rotational_stiffness_N_m_per_rad = [0.0, 0.0, 1e6]
damping_N_s_per_m = [0.0, 0.0, 3e4]
)";

const char* kSimulation = R"([simulation]
vehicle = "vehicle.toml"
speed_m_s = 20
distance_m = 1
checkpoint_s = 0.05

[case]
regime = "steady"

[wheel]
shape.standard = "S1002"

[rail]
shape.standard = "60E1"

[track]
gauge_mm = 1435.0
gauge_height_mm = 14.0
cant_rad = 0.025

[wheelset]
flange_back_distance_mm = 1360.0
flange_back_position_mm = -70.0

[friction]
coefficient = 0.3

[discretisation]
dx_mm = 1
ds_mm = 1
)";

class Falling : public ::testing::Test {
 protected:
  void SetUp() override {
    input.write("vehicle.toml", kVehicle);
    input.write("simulation.toml", kSimulation);
  }
  std::string path(const std::string& name) const { return (input.folder() / name).string(); }
  std::vector<std::string> command(double from, double to, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"treadmark", "stability", path("simulation.toml"), "--quiet", "--falling", "--from",
                               std::to_string(from), "--to", std::to_string(to), "--count", "5", "--deceleration", "1",
                               "--hold-m", "200", "--window-m", "50"});
    return more;
  }
  SampleInput input;
};

TEST_F(Falling, FindsWhereTheLimitCycleDiesAndWritesIt) {
  TREADMARK_NEEDS("hdf5");
  const std::string out = path("out");
  const ProgramResult r = RunningProgram(command(10, 60, {"-o", out})).wait();
  ASSERT_EQ(r.status, 0) << r.err;
  const auto json = nlohmann::json::parse(input.read("out/stability.json"));
  ASSERT_EQ(json.at("verdict"), "critical") << r.out;
  const auto& falling = json.at("falling_speed");
  ASSERT_EQ(falling.at("verdict"), "died") << r.out;
  EXPECT_THAT(r.out, HasSubstr(falling.at("message").get<std::string>()));
  const double low = falling.at("critical_speed_low_m_s"), high = falling.at("critical_speed_high_m_s"),
               linear = json.at("critical_speed_m_s");
  EXPECT_LE(low, high);
  // Measured profiles of growing conicity: disturbed, it sways where undisturbed it is stable.
  EXPECT_LT(low, linear);
  EXPECT_GT(low, 10.0);
  EXPECT_THAT(input.read("out/stability.svg"), AllOf(HasSubstr("while the speed falls"), HasSubstr("</svg>")));
  EXPECT_THAT(input.read("out/falling.csv"), HasSubstr("speed_m_s,amplitude_m"));
  for (const char* store : {"fall/simulation.h5", "slow-fall/simulation.h5"})
    EXPECT_TRUE(fs::exists(fs::path(out) / store)) << store;
}

TEST_F(Falling, ASpeedWithoutInstabilityGivesNoNumber) {
  const ProgramResult r = RunningProgram(command(3, 5, {"--json", "-"})).wait();
  ASSERT_EQ(r.status, 0) << r.err;
  const auto falling = nlohmann::json::parse(r.out).at("falling_speed");
  EXPECT_EQ(falling.at("verdict"), "none");
  EXPECT_FALSE(falling.contains("critical_speed_low_m_s"));
  EXPECT_THAT(falling.at("message").get<std::string>(), HasSubstr("no limit cycle at 5 m/s"));
}

TEST_F(Falling, AfterKillsTheResultIsThatOfAnUndisturbedRun) {
  TREADMARK_NEEDS("hdf5");
  ASSERT_EQ(RunningProgram(command(10, 60, {"-o", path("undisturbed")})).wait().status, 0);
  int resumed = 0;
  for (const int delay_ms : {300, 600, 1200}) {
    RunningProgram program(command(10, 60, {"-o", path("killed")}));
    while (program.running() && !fs::exists(path("killed/fall/unfinished.h5")) &&
           !fs::exists(path("killed/slow-fall/unfinished.h5")))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    if (!program.running()) break;
    program.send(SIGKILL);
    program.wait();
    ++resumed;
  }
  EXPECT_GE(resumed, 1);
  const ProgramResult last = RunningProgram(command(10, 60, {"-o", path("killed")})).wait();
  ASSERT_EQ(last.status, 0) << last.err;
  for (const char* file :
       {"fall/simulation.h5", "slow-fall/simulation.h5", "falling.csv", "stability.json", "stability.svg"})
    EXPECT_TRUE(input.read(std::string("undisturbed/") + file) == input.read(std::string("killed/") + file)) << file;
}

TEST_F(Falling, RefusesWhatMakesNoSense) {
  const auto status = [&](std::vector<std::string> more) {
    return RunningProgram(command(10, 60, std::move(more))).wait();
  };
  EXPECT_EQ(status({"--to-km-h", "200"}).status, 2) << "--to is given too";
  const ProgramResult hasty = RunningProgram({"treadmark", "stability", path("simulation.toml"), "--falling", "--from",
                                              "30", "--to", "100", "--count", "2", "--hold-m", "300"})
                                  .wait();
  EXPECT_EQ(hasty.status, 2);
  EXPECT_THAT(hasty.err, HasSubstr("too short"));
  EXPECT_EQ(RunningProgram({"treadmark", "stability", path("simulation.toml"), "--deceleration", "1"}).wait().status,
            2);
  input.edit("vehicle.toml", "free = [\"z\"]", "free = [\"x\", \"z\"]");
  const ProgramResult free = status({});
  EXPECT_EQ(free.status, 2);
  EXPECT_THAT(free.err, HasSubstr("nothing holds them along the track"));
}

}  // namespace
}  // namespace treadmark::testing
