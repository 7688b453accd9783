// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "small_vehicles.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/solvers/vehicle/contacts/full_contact.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"

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

/// A round wheel with roughness across its tread: a cone of 1:40 with heights that scatter by some micrometres. With
/// FASTSIM its creep forces jump as elements come into contact and go.
wheelrail::Geometry rough_wheel(int seed) {
  Profile profile;
  profile.body = Body::wheel;
  profile.name = "rough";
  std::uint32_t state = static_cast<std::uint32_t>(seed);
  for (double y = 40e-3; y > -30e-3; y -= 1e-3) {
    state = 1664525u * state + 1013904223u;
    const double noise = 2.0 * (state / 4294967296.0) - 1.0;
    profile.y.push_back(y);
    profile.z.push_back(-y / 40.0 + 10e-6 * noise);
  }
  SurfaceSpec wheel{Body::wheel, 0.46, profile, {}}, rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  return {create_surface(rail), create_surface(wheel), true, true};
}

/// Newton's method alone stopped at 1.9e-4, 1.0e-3 and 3.3e-4 of the load.
TEST(Equilibrium, OfRoughWheelsIsFoundAlthoughTheirForcesJump) {
  VehicleModel model = wheel_on_mass(1813.0, 9000.0, 2e6, 1e4);
  model.bodies[1].free = {true, true, true, true, true, true};
  model.bodies[1].inertia = {1120.0, 112.0, 1120.0};
  model.springs[0].stiffness = {30e6, 4e6, 2e6, 1e6, 0, 1e6};
  for (const int seed : {4, 10, 19}) {
    VehicleOnTrack v;
    v.speed = 60.0;
    v.system = assemble(model, {}, v.speed, kGravity);
    for (const auto side : {wheelrail::Side::left, wheelrail::Side::right}) {
      wheelrail::Problem p;
      p.side = side;
      p.track.cant = 1.0 / 40.0;
      p.wheelset.nominal_radius = 0.46;
      p.regime = kalker::Regime::steady;
      p.tangential_model = kalker::TangentialModel::fastsim;
      p.discretisation.dx = p.discretisation.ds = 1e-3;
      const wheelrail::Geometry bodies = rough_wheel(seed + (side == wheelrail::Side::left ? 100 : 0));
      v.wheels.push_back({0, side, "wheel", std::make_shared<FullContact>(bodies, p), rail_marker_at_rest(bodies, p)});
    }
    v.connect();
    const Equilibrium e = find_equilibrium(v);
    EXPECT_EQ(e.report.status, Status::ok) << e.report.message;
    EXPECT_EQ(e.report.message.empty(), e.residual <= EquilibriumSettings{}.acceptable) << e.report.message;
    const double load = (1813.0 + 9000.0) * kGravity;
    double carried = 0.0;
    for (const ContactReaction& r : e.reactions) carried += r.on_rail.force.z();
    EXPECT_NEAR(carried, load, 1e-3 * load);
    EXPECT_NEAR(v.motion(0, e.state).wheelset_velocity.pitch, -60.0 / 0.46, 0.01 * 60.0 / 0.46);
  }
}

TEST(Equilibrium, ForcesThatStayOutOfBalanceAreNamedOrRefused) {
  // A force that jumps where all others are in balance, so that no state is.
  class Restless : public HertzSpring {
   public:
    Restless(double side_y, double jump) : HertzSpring(9e10, side_y, 0.46, 1e5), jump_(jump) {}
    ContactReaction evaluate(const PairMotion& m) override {
      ContactReaction r = HertzSpring::evaluate(m);
      const double back = m.wheelset.x > 0.0 ? jump_ : -jump_;
      r.on_rail.force.x() += back;
      r.on_wheelset.force.x() -= back;
      return r;
    }

   private:
    double jump_;
  };
  VehicleModel model = wheel_on_mass(1813.0, 9000.0, 2e6, 1e4);
  model.bodies[1].free = {true, false, true, false, false, false};
  model.bodies[1].inertia = {1120.0, 112.0, 1120.0};
  model.springs[0].stiffness = {1e6, 0, 2e6, 0, 0, 0};
  const double load = (1813.0 + 9000.0) * kGravity;
  for (const double share : {4e-4, 4e-3}) {
    VehicleOnTrack v = on_hertz_springs(model, {}, 20.0, kHertzStiffness);
    v.wheels[0].element = std::make_shared<Restless>(-0.75, share * load);
    const Equilibrium e = find_equilibrium(v);
    EXPECT_EQ(e.report.status == Status::ok, share < 1e-3) << e.residual;
    EXPECT_NE(e.report.message.find("remain"), std::string::npos) << e.report.message;
    EXPECT_NE(e.report.message.find("most along wheelset.x"), std::string::npos) << e.report.message;
    EXPECT_EQ(e.report.message.find("elements"), std::string::npos) << "these contacts have none";
  }
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
