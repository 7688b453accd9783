// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "small_vehicles.hpp"
#include "treadmark/solvers/vehicle/eigenmodes.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kHertzStiffness = 9e10;

TEST(Equilibrium, HertzSpringsAndTrackBearTheWeight) {
  const VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1813.0, 9000.0, 2e6, 1e4), rails_on_springs(200.0, 6e7, 5e4),
                                            20.0, kHertzStiffness);
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const double load = 0.5 * (1813.0 + 9000.0) * kGravity, approach = std::pow(load / kHertzStiffness, 2.0 / 3.0),
               sunk = load / 6e7;
  for (const ContactReaction& r : e.reactions) EXPECT_NEAR(r.normal_force, load, 1e-5 * load);
  EXPECT_NEAR(v.motion(0, e.state).rail.z, sunk, 1e-9);
  EXPECT_NEAR(v.motion(0, e.state).wheelset.z, sunk + approach, 1e-9);
}

TEST(Equilibrium, WheelsRollFreely) {
  VehicleModel model = wheel_on_mass(1813.0, 9000.0, 2e6, 1e4);
  model.bodies[1].free = {true, true, true, true, true, true};
  model.bodies[1].inertia = {1100.0, 110.0, 1100.0};
  model.springs[0].stiffness = {1e6, 1e6, 2e6, 1e5, 0, 1e5};
  VehicleOnTrack v = on_hertz_springs(model, {}, 20.0, kHertzStiffness, 1e5);
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  EXPECT_NEAR(v.motion(0, e.state).wheelset_velocity.pitch, -20.0 / 0.46, 1e-6);
}

TEST(Equilibrium, AVehicleWithoutWeightOnItsWheelsIsRefused) {
  VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1813.0, 9000.0, 2e6, 1e4), {}, 20.0, kHertzStiffness);
  v.system.wheelset_load = {0.0};
  EXPECT_THROW(find_equilibrium(v), Error);
}

/// Frequencies of two masses: m1 on k1 on m2 on k2 on the ground.
std::pair<double, double> two_masses(double m1, double k1, double m2, double k2) {
  const double a = k1 / m1, b = (k1 + k2) / m2, c = k1 * k1 / (m1 * m2), mean = 0.5 * (a + b),
               spread = std::sqrt(0.25 * (a - b) * (a - b) + c);
  return {std::sqrt(mean - spread) / (2 * std::numbers::pi), std::sqrt(mean + spread) / (2 * std::numbers::pi)};
}

TEST(Eigenmodes, P1AndP2OfAWheelOnATrack) {
  // A soft spring holds the sprung mass away from the wheel: half a wheelset on a contact on a rail on the ground.
  const VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1813.0, 9000.0, 1e3, 0.0), rails_on_springs(245.0, 62e6, 0.0),
                                            20.0, kHertzStiffness);
  const Equilibrium e = find_equilibrium(v);
  ASSERT_EQ(e.report.status, Status::ok) << e.report.message;
  const double load = e.reactions[0].normal_force,
               contact = 1.5 * std::pow(kHertzStiffness, 2.0 / 3.0) * std::cbrt(load);
  const auto [p2, p1] = two_masses(0.5 * 1813.0, contact, 245.0, 62e6);
  std::vector<double> found;
  for (const Eigenmode& m : eigenmodes(v, e.state)) found.push_back(m.frequency);
  // The mass on its soft spring, P2, and P1 of both rails together and against each other.
  ASSERT_EQ(found.size(), 4u);
  EXPECT_NEAR(found[0], std::sqrt(1e3 / 9000.0) / (2 * std::numbers::pi), 1e-4);
  EXPECT_NEAR(found[1], p2, 1e-3 * p2);
  EXPECT_NEAR(found[3], p1, 1e-3 * p1);
  // Textbook: all moves together on the track; rail against wheel.
  EXPECT_NEAR(p2, std::sqrt(62e6 / (0.5 * 1813.0 + 245.0)) / (2 * std::numbers::pi), 0.02 * p2);
  EXPECT_NEAR(p1, std::sqrt(contact * (2.0 / 1813.0 + 1.0 / 245.0)) / (2 * std::numbers::pi), 0.03 * p1);
}

TEST(Eigenmodes, DampingRatioOfASprungMass) {
  // The wheel hardly moves.
  const double m = 9000.0, k = 2e6, c = 3e4;
  const VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1813.0, m, k, c), {}, 20.0, 1e15);
  const auto modes = eigenmodes(v, find_equilibrium(v).state);
  ASSERT_FALSE(modes.empty());
  const double omega = std::sqrt(k / m), zeta = c / (2.0 * m * omega);
  EXPECT_NEAR(modes[0].damping_ratio, zeta, 1e-3);
  EXPECT_NEAR(modes[0].frequency, omega * std::sqrt(1 - zeta * zeta) / (2 * std::numbers::pi), 1e-3);
  EXPECT_EQ(describe(modes[0], v.system).substr(0, 7), "mass.z ");
}

TEST(Eigenmodes, ADamperBehindASpringAgainstItsCubic) {
  const double m = 9000.0, k = 2e6, c = 3e4, series = 1e6;
  VehicleModel model = wheel_on_mass(1813.0, m, k, c);
  model.springs[0].damper_stiffness[2] = series;
  const VehicleOnTrack v = on_hertz_springs(model, {}, 20.0, 1e15);
  const auto modes = eigenmodes(v, find_equilibrium(v).state);
  ASSERT_FALSE(modes.empty());
  const double w = 2 * std::numbers::pi * modes[0].frequency, z = modes[0].damping_ratio;
  const std::complex<double> s(-w * z / std::sqrt(1 - z * z), w);
  // m s^2 + k + series c s / (series + c s) = 0
  const std::complex<double> remainder = m * s * s + k + series * c * s / (series + c * s);
  EXPECT_LT(std::abs(remainder), 1e-3 * k);
}

}  // namespace
}  // namespace treadmark::vehicle
