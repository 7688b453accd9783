// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/app/simulation/history_record.hpp"
#include "treadmark/tests/solvers/vehicle/small_vehicles.hpp"

namespace treadmark::app {
namespace {

constexpr double kWanted = 20.0, kPullOfFree = 3e4, kEndOfPull = 4.0;  // [m/s], [N], [s]

/// A mass of 9 t on a wheelset of 1.8 t, which a force pulls on and then back: after 2 s it is as fast as ever.
vehicle::Simulation pulled_on_and_back(bool free) {
  VehicleModel model = vehicle::wheel_on_mass(1800.0, 9000.0, 2e6, 1e4);
  model.bodies[0].free[0] = true;
  if (!free) model.springs.push_back(vehicle::spring(kGround, "mass", {0, 0, -1.0}, {1e9, 0, 0, 0, 0, 0}));
  vehicle::VehicleOnTrack v = vehicle::on_hertz_springs(model, {}, kWanted, 9e10);
  vehicle::LineSetup setup;
  setup.gravity = vehicle::kGravity;
  setup.speed = constant_speed(kWanted);
  setup.forces.push_back(
      {"mass", {}, {}, {}, Freedom::x, {0.0, 1.0, 3.0, 4.0}, {0.0, kPullOfFree, -kPullOfFree, 0.0}, {}});
  v.line = std::make_shared<const vehicle::LineEffects>(v.system, std::move(setup));
  const vehicle::Equilibrium e = vehicle::find_equilibrium(v);
  EXPECT_EQ(e.report.status, Status::ok) << e.report.message;
  return vehicle::Simulation(v, e.state, vehicle::equal_steps(kEndOfPull, 2e-3));
}

io::SimulationFile one_wheelset() {
  io::SimulationFile file;
  file.wheels.resize(2);
  return file;
}

/// The speed counts at its worst, wherever that is.
TEST(OtherSpeed, IsThatOfAllMassesWhereItIsWorst) {
  const io::SimulationFile file = one_wheelset();
  vehicle::Simulation run = pulled_on_and_back(true);
  HistorySummary summary(file, run);
  summary.note();
  EXPECT_EQ(summary.other_speed().wanted, 0.0) << "nothing yet";
  while (!run.finished()) {
    run.advance();
    summary.note();
  }
  // The impulse until the force turns at 2 s, on all masses: the wheelset keeps the frame's speed.
  const OtherSpeed& most = summary.other_speed();
  EXPECT_EQ(most.wanted, kWanted);
  EXPECT_NEAR(most.mean, kWanted + 0.5 * kPullOfFree * 2.0 / 10800.0, 1e-2);
  EXPECT_NEAR(most.place, 2.0 * kWanted, 0.1);
  EXPECT_NEAR(run.vehicle().mean_speed(run.state()), kWanted, 1e-2);
  ByteWriter out;
  summary.save(out);
  HistorySummary again(file, run);
  ByteReader in(out.bytes());
  again.restore(in);
  EXPECT_EQ(again.other_speed().mean, most.mean);
  EXPECT_EQ(again.other_speed().place, most.place);
}

TEST(OtherSpeed, IsNoneOfAVehicleThatIsHeld) {
  const io::SimulationFile file = one_wheelset();
  vehicle::Simulation run = pulled_on_and_back(false);
  HistorySummary summary(file, run);
  while (!run.finished()) {
    run.advance();
    summary.note();
  }
  EXPECT_EQ(summary.other_speed().wanted, 0.0);
}

TEST(OtherSpeed, BeginsAtAHundredthAndACentimetreASecond) {
  EXPECT_FALSE(is_another_speed(15.0, 15.0));
  EXPECT_FALSE(is_another_speed(15.14, 15.0));
  EXPECT_TRUE(is_another_speed(15.16, 15.0));
  EXPECT_TRUE(is_another_speed(14.84, 15.0));
  EXPECT_FALSE(is_another_speed(0.109, 0.1));
  EXPECT_TRUE(is_another_speed(0.111, 0.1));
}

}  // namespace
}  // namespace treadmark::app
