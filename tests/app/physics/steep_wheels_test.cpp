// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Wheels that touch far from their nominal circle, and steeply, at rest: they find their static equilibrium.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <string>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

constexpr double kSpeed = 20.0, kRadius = 0.46;

/// A vehicle of the examples on 60E1 at 1:40 and 1435 mm.
std::string simulation(const std::string& vehicle, const std::string& wheel, const std::string& contact) {
  std::string text = fmt::format(R"(
[wheel]
{}
[simulation]
vehicle = "{}/examples/vehicles/{}.toml"
speed_m_s = {}
distance_m = 0.1
[rail]
shape.standard = "60E1"
[track]
gauge_mm = 1435
cant_rad = 0.025
[wheelset]
flange_back_distance_mm = 1360.0
flange_back_position_mm = -70.0
[friction]
coefficient = 0.3
[discretisation]
dx_mm = 1.0
ds_mm = 1.0
)",
                                 wheel, TREADMARK_SOURCE_DIR, vehicle, kSpeed);
  if (!contact.empty())
    for (const char* side : {"left", "right"})
      text += fmt::format("[[simulation.wheels]]\nwheelset = 1\nside = \"{}\"\ncontact = \"{}\"\n", side, contact);
  return text;
}

struct Found {
  BuiltVehicle built;
  vehicle::Equilibrium equilibrium;
};
Found equilibrium_of(const testing::TemporaryFolder& folder, const std::string& text) {
  folder.write("simulation.toml", text);
  SurfaceStore store;
  Found found{build_vehicle(io::read_simulation_file(folder.path() / "simulation.toml"), store), {}};
  found.equilibrium = vehicle::find_equilibrium(found.built.vehicle);
  return found;
}

/// Every wheel bears the same, and both sides mirror each other.
void expect_symmetric(const vehicle::Equilibrium& e, const std::string& what) {
  constexpr double kLoad = 44482.0 * 9.81 / 8.0, kBalance = 1e-4;
  ASSERT_EQ(e.report.status, Status::ok) << what << ": " << e.report.message;
  EXPECT_LT(e.residual, kBalance) << what;
  for (const vehicle::ContactReaction& r : e.reactions)
    EXPECT_NEAR(r.on_rail.force.z(), kLoad, 2.0 * kBalance * kLoad) << what;
  for (std::size_t i = 0; i < e.reactions.size(); i += 2) {
    EXPECT_NEAR(e.reactions[i].on_rail.force.y() + e.reactions[i + 1].on_rail.force.y(), 0.0, kBalance * kLoad) << what;
    EXPECT_NEAR(e.reactions[i].contact_y + e.reactions[i + 1].contact_y, 0.0, 1e-6) << what;
  }
}

TEST(SteepWheels, ConesRollOnTheCircleThatTouches) {
  const testing::TemporaryFolder folder;
  for (const char* vehicle : {"single-wheelset", "manchester"})
    for (const int slope : {20, 7, 6, 5, 4, 3}) {
      const std::string what = fmt::format("1:{} {}", slope, vehicle);
      const Found found =
          equilibrium_of(folder, simulation(vehicle, fmt::format("shape.standard = \"cone 1:{}\"", slope), ""));
      expect_symmetric(found.equilibrium, what);
      // No longitudinal force, no slip: V over the radius of the circle in contact, 70 mm from the back being nominal.
      const double beside = 0.75 - std::abs(found.equilibrium.reactions[0].contact_y),
                   radius = kRadius + beside / slope;
      EXPECT_NEAR(found.built.vehicle.motion(0, found.equilibrium.state).wheelset_velocity.pitch * radius, -kSpeed,
                  1e-4 * kSpeed)
          << what;
    }
  for (const int slope : {6, 4}) {
    const Found found = equilibrium_of(
        folder, simulation("single-wheelset", fmt::format("shape.standard = \"cone 1:{}\"", slope), "full"));
    expect_symmetric(found.equilibrium, fmt::format("1:{}, full contact", slope));
  }
}

/// S1002 with a cosine cut out of its tread from -25 to 45 mm, z down.
void write_hollow(const std::filesystem::path& file, double depth_mm) {
  const analytic::GraphCurve s1002 = analytic::s1002_curve();
  std::ofstream out(file);
  out << "y,z\n";
  for (double y = 60.0; y > -70.0; y -= 0.2) {
    const double phase = 2.0 * kPi * (y - 10.0) / 70.0,
                 cut = std::abs(y - 10.0) < 35.0 ? 0.5 * depth_mm * (1.0 + std::cos(phase)) : 0.0;
    out << fmt::format("{:.4f},{:.6f}\n", y,
                       s1002.height(y * kMillimetre, s1002.find(y * kMillimetre, 0)) * kMilli - cut);
  }
}

TEST(SteepWheels, HollowWheelsAreStillSymmetric) {
  const testing::TemporaryFolder folder;
  for (const double depth : {1.0, 2.0, 2.4, 3.0, 4.0}) {
    write_hollow(folder.path() / "hollow.csv", depth);
    for (const char* vehicle : {"single-wheelset", "manchester"})
      expect_symmetric(
          equilibrium_of(folder, simulation(vehicle, "shape.file = \"hollow.csv\"\nshape.mirror_z = \"no\"", ""))
              .equilibrium,
          fmt::format("{} mm, {}", depth, vehicle));
  }
}

TEST(SteepWheels, ABalanceThatIsNotThereIsToldWithItsPlace) {
  // A wheelset that a force without a counterpart pushes over the rails.
  const testing::TemporaryFolder folder;
  folder.write("simulation.toml", simulation("single-wheelset", "shape.standard = \"cone 1:6\"", ""));
  SurfaceStore store;
  BuiltVehicle built = build_vehicle(io::read_simulation_file(folder.path() / "simulation.toml"), store);
  for (std::size_t i = 0; i < built.vehicle.system.coordinates.size(); ++i)
    if (built.vehicle.system.coordinates[i].name == "wheelset.y")
      built.vehicle.system.weight[static_cast<Eigen::Index>(i)] = 2e5;
  const vehicle::Equilibrium e = vehicle::find_equilibrium(built.vehicle);
  EXPECT_EQ(e.report.status, Status::not_converged);
  EXPECT_NE(e.report.message.find("of a wheelset's load remain, most along "), std::string::npos) << e.report.message;
  EXPECT_NE(e.report.message.find("ws1_left touches at y = -7"), std::string::npos) << e.report.message;
}

}  // namespace
}  // namespace treadmark::app
