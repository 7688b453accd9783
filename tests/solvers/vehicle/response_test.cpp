// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/stability/response.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "small_vehicles.hpp"

namespace treadmark::vehicle {
namespace {

using Complex = std::complex<double>;

constexpr double kSprung = 9000.0, kSet = 1813.0, kLeft = 200.0, kSuspension = 2e6, kDamper = 1e4, kBed = 6e7,
                 kBedDamping = 5e4, kTouch = 9e10;  // masses [kg], [N/m], [N s/m], [N/m^1.5]

/// Wheelset and mass, which only move up and down, on two rails: forces on the left rail and motion of the mass under
/// equal irregularities of both rails, and under a force on the wheelset.
struct Amplitudes {
  Complex vertical, mass;
};
Amplitudes by_hand(double frequency, double irregularity, double force) {
  const double omega = 2.0 * std::numbers::pi * frequency, load = 0.5 * (kSprung + kSet) * kGravity;
  const double contact = 1.5 * std::pow(kTouch, 2.0 / 3.0) * std::cbrt(load);
  const Complex suspension(kSuspension, omega * kDamper), bed(kBed, omega * kBedDamping);
  Eigen::Matrix3cd dynamic;                                           // mass, wheelset, one of the rails
  dynamic << suspension - omega * omega * kSprung, -suspension, 0.0,  //
      -suspension, suspension + 2.0 * contact - omega * omega * kSet, -2.0 * contact,  //
      0.0, -contact, contact + bed - omega * omega * kLeft;
  const Eigen::Vector3cd right(0.0, force + 2.0 * contact * irregularity, -contact * irregularity);
  const Eigen::Vector3cd moved = dynamic.partialPivLu().solve(right);
  return {contact * (moved[1] - moved[2] - irregularity), moved[0]};
}

TEST(LinearVehicle, RespondsAsByHand) {
  const VehicleOnTrack v = on_hertz_springs(wheel_on_mass(kSet, kSprung, kSuspension, kDamper),
                                            rails_on_springs(kLeft, kBed, kBedDamping), 20.0, kTouch);
  const Equilibrium e = find_equilibrium(v, {1e-12, 1e-6, 1e-3, 60});
  ASSERT_EQ(e.report.status, Status::ok);
  const LinearVehicle linear(v, e.state, 1.5);
  using Kind = ResponseInput::Kind;
  const std::vector<ResponseInput> inputs{{Kind::irregularity, Irregularity::longitudinal_level, 0},
                                          {Kind::vertical_force, {}, 0},
                                          {Kind::irregularity, Irregularity::cross_level, 0},
                                          {Kind::wheel_roughness, {}, 0},
                                          {Kind::rail_roughness, {}, 1}};
  for (const double frequency : {0.3, 2.0, 5.0, 30.0, 60.0, 200.0, 900.0}) {
    const std::vector<FrequencyResponse> r = linear.at(frequency, inputs);
    const Amplitudes level = by_hand(frequency, 1.0, 0.0), pushed = by_hand(frequency, 0.0, 1.0);
    const auto near = [&](Complex found, Complex truth) {
      EXPECT_LT(std::abs(found - truth), 1e-4 * std::abs(truth)) << frequency << " Hz";
    };
    near(r[0].vertical[0], level.vertical);
    near(r[0].vertical[1], level.vertical);
    near(r[0].coordinate[0], level.mass);
    near(r[1].vertical[0], pushed.vertical);
    near(r[1].coordinate[0], pushed.mass);
    // Rails that go up and down against each other press with opposite forces on what cannot roll.
    EXPECT_LT(std::abs(r[2].vertical[0] + r[2].vertical[1]), 1e-6 * std::abs(r[2].vertical[0]));
    EXPECT_GT(std::abs(r[2].vertical[0]), 1e6);
    // Of both rails together it is a level.
    EXPECT_LT(std::abs(r[3].vertical[0] + r[4].vertical[0] - r[0].vertical[0]), 1e-6 * std::abs(r[0].vertical[0]));
    EXPECT_LT(std::abs(r[3].vertical[0] - r[4].vertical[1]), 1e-6 * std::abs(r[3].vertical[0]));
  }
}

}  // namespace
}  // namespace treadmark::vehicle
