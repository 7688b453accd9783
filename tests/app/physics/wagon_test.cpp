// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/multibody.hpp"

namespace treadmark::app {
namespace {

constexpr double kMassOfWagon = 70e3 + 2 * 2000.0 + 4 * 1350.0, kPush = 60e3;  // [kg], [N]

io::SimulationFile wagon(const std::vector<std::string>& overrides = {}) {
  return io::read_simulation_file(std::string(TREADMARK_SOURCE_DIR) + "/examples/wagon-push.toml", overrides);
}

/// A column as a function of the row.
auto column_of(const io::SimulationResult& r, const std::string& name) {
  return [&r, at = io::column_index(r, name)](std::size_t row) { return r.values[row * r.columns.size() + at]; };
}

/// By the beginnings of their names, of which each is there.
void expect_pressed(const vehicle::Multibody& s, const std::map<std::string, double>& forces) {
  for (const auto& [name, force] : forces) {
    int found = 0;
    for (const vehicle::DryFriction& f : s.elements.frictions) {
      if (!f.name.starts_with(name)) continue;
      ++found;
      EXPECT_NEAR(f.normal_force, force, 0.005 * force) << f.name;
    }
    EXPECT_GT(found, 0) << name;
  }
}

TEST(Wagon, BearsItsLoadsAsByHand) {
  const io::SimulationFile file = wagon();
  const vehicle::Multibody s = vehicle::assemble(file.vehicle, {}, file.settings.speed, file.settings.gravity);
  for (const double load : s.wheelset_load) EXPECT_NEAR(load, kMassOfWagon * 9.81 / 4.0, 1.0);
  constexpr double kBox = (70e3 + 2 * 2000.0) * 9.81 / 8.0, kPivots = 70e3 * 9.81 / 2.0;
  // Pivot and side bearers share the car by their stiffnesses.
  expect_pressed(s,
                 {{"lenoir", 0.325 * kBox}, {"bowl", kPivots * 30.0 / 31.0}, {"bearer", 10e3 + kPivots * 0.5 / 31.0}});
}

TEST(ThreePieceWagon, BearsItsLoadsAsByHand) {
  const io::SimulationFile file = wagon({"simulation.vehicle=vehicles/three-piece-wagon.toml"});
  const vehicle::Multibody s = vehicle::assemble(file.vehicle, {}, file.settings.speed, file.settings.gravity);
  for (const double load : s.wheelset_load)
    EXPECT_NEAR(load, (80e3 + 2 * 600.0 + 4 * 450.0 + 4 * 1200.0) * 9.81 / 4.0, 1.0);
  constexpr double kNest = (80e3 / 2 + 600.0) * 9.81 / 2, kAdapter = (80e3 / 4 + 600.0 / 2 + 450.0) * 9.81 / 2;
  expect_pressed(s, {{"wedge", 0.3 * kNest}, {"adapter", kAdapter}, {"bearer", 0.0}});
}

// It sways on all the while, so that what the wheels do not take up is in the momentum of its bodies.
TEST(ThreePieceWagon, IsPushedAside) {
  SurfaceStore store;
  const io::SimulationFile file = wagon(
      {"simulation.vehicle=vehicles/three-piece-wagon.toml", "simulation.channels=[\"*.sumY_N\", \"*.y_rate_m_s\"]"});
  const io::SimulationResult r = run_simulation(file, store, {}, {});
  ASSERT_EQ(r.status, "complete") << r.message;
  const auto error = ranges::find(r.summary, std::string("energy_integration_error"), &io::NamedValue::name);
  ASSERT_NE(error, r.summary.end());
  EXPECT_LT(std::abs(error->value), 1e-4);
  const auto time = column_of(r, "t_s");
  const vehicle::Multibody s = vehicle::assemble(file.vehicle, {}, file.settings.speed, file.settings.gravity);
  const auto momentum = [&](std::size_t row) {
    double sum = 0.0;
    for (const vehicle::Multibody::Body& body : s.bodies)
      sum += body.mass * column_of(r, body.name + ".y_rate_m_s")(row);
    return sum;
  };
  const auto guiding = [&](std::size_t row) {
    double sum = 0.0;
    for (int set = 1; set <= 4; ++set) sum += column_of(r, "ws" + std::to_string(set) + ".sumY_N")(row);
    return sum;
  };
  // While the push is constant.
  double impulse = 0.0, push = 0.0, gained = 0.0, most = 0.0;
  for (std::size_t row = 1; row < r.values.size() / r.columns.size(); ++row) {
    const double h = time(row) - time(row - 1);
    if (time(row - 1) < 2.5 || time(row) > 5.0) continue;
    impulse += 0.5 * h * (guiding(row) + guiding(row - 1));
    push += kPush * h;
    gained += momentum(row) - momentum(row - 1);
    most = std::max(most, std::abs(impulse + gained - push));
  }
  EXPECT_GT(push, 2.4 * kPush);
  EXPECT_LT(most, 1e-3 * push);
}

TEST(Wagon, IsPushedAside) {
  SurfaceStore store;
  const io::SimulationFile file = wagon();
  const io::SimulationResult r = run_simulation(file, store, {}, {});
  ASSERT_EQ(r.status, "complete") << r.message;
  const auto time = column_of(r, "t_s"), slid = column_of(r, "friction.lenoir1.y_slid_m"),
             rubs = column_of(r, "friction.lenoir1.y_N"), lost = column_of(r, "energy.dampers_J");
  const std::size_t rows = r.values.size() / r.columns.size();
  double guiding = 0.0, weight = 0.0;
  int counted = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    EXPECT_LT(std::abs(rubs(row)), 0.3 * 0.325 * 2.0 * 90.74e3);
    EXPECT_GE(lost(row), lost(row == 0 ? 0 : row - 1) - 1e-3);
    if (time(row) < 4.0 || time(row) > 5.0) continue;
    ++counted;
    for (int set = 1; set <= 4; ++set) {
      const std::string name = "ws" + std::to_string(set);
      guiding += column_of(r, name + ".sumY_N")(row);
      // Columns of the first wheel have no prefix.
      for (const char* side : {"_left", "_right"})
        weight += column_of(r, set == 1 && side[1] == 'l' ? "Q_N" : name + side + ".Q_N")(row);
    }
  }
  ASSERT_GT(counted, 100);
  EXPECT_NEAR(guiding / counted / kPush, 1.0, 0.005);
  EXPECT_NEAR(weight / counted / (kMassOfWagon * 9.81), 1.0, 0.005);
  EXPECT_GT(std::abs(slid(rows - 1)), 1e-4);  // it does not come back by itself
  const auto error = ranges::find(r.summary, std::string("energy_integration_error"), &io::NamedValue::name);
  ASSERT_NE(error, r.summary.end());
  EXPECT_LT(std::abs(error->value), 1e-4);
}

}  // namespace
}  // namespace treadmark::app
