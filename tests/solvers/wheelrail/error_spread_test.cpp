// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/error_spread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "treadmark/model/contact/hertz_ellipse.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kForce = 80e3, kCurvatureX = 1.1, kCurvatureY = 1.9;  // [N], [1/m]
const Material kSteel;
const double kModulus = kSteel.shear_modulus_1 / (1.0 - kSteel.poisson_1);

/// A gap A x^2 + B y^2 under a load, on n x n elements.
struct Ellipse {
  HertzEllipse hertz = hertz_by_force(kCurvatureX, kCurvatureY, kForce, kModulus);
  Grid2 grid;
  std::vector<double> gap;

  explicit Ellipse(int n = 47) {
    constexpr double kReach = 1.3;  // beyond the ellipse
    grid.nx = grid.ny = n;
    grid.dx = 2.0 * kReach * hertz.semi_axis_x / n, grid.dy = 2.0 * kReach * hertz.semi_axis_y / n;
    grid.x0 = -0.5 * (n - 1) * grid.dx, grid.y0 = -0.5 * (n - 1) * grid.dy;
    for (int iy = 0; iy < n; ++iy)
      for (int ix = 0; ix < n; ++ix)
        gap.push_back(kCurvatureX * grid.x(ix) * grid.x(ix) + kCurvatureY * grid.y(iy) * grid.y(iy));
  }

  /// With errors by y, either way round.
  UncertainPatch with(const std::function<double(double)>& error) const {
    UncertainPatch out{grid, gap, hertz.approach, kForce, kForce, 1.0, {}};
    for (const double sign : {1.0, -1.0}) {
      std::vector<double>& draw = out.errors.emplace_back();
      for (int iy = 0; iy < grid.ny; ++iy) draw.push_back(sign * error(grid.y(iy)));
    }
    return out;
  }
};

double rms(const std::array<double, 2>& values) { return std::hypot(values[0], values[1]) / std::numbers::sqrt2; }

/// What elements leave open of changes: pressures and forces, areas.
constexpr double kFields = 0.04, kAreas = 0.12;

TEST(ErrorSpread, AHeightAtAGivenPlaceIsAnApproach) {
  const Ellipse e;
  const double off = 0.1 * e.hertz.approach;
  const auto spread = error_spread(std::vector{e.with([&](double) { return off; })}, kSteel, false);
  ASSERT_TRUE(spread.at(0));
  const auto grown = [](double power) { return rms({std::pow(1.1, power) - 1.0, std::pow(0.9, power) - 1.0}); };
  EXPECT_NEAR(spread[0]->force, grown(1.5), kFields * grown(1.5));
  EXPECT_NEAR(spread[0]->pressure, grown(0.5), kFields * grown(0.5));
  EXPECT_NEAR(spread[0]->area, grown(1.0), kAreas * grown(1.0));
  EXPECT_NEAR(spread[0]->approach, off, 1e-9 * off);
  EXPECT_NEAR(spread[0]->place, 0.0, 1e-4 * e.hertz.semi_axis_y);
}

TEST(ErrorSpread, AHeightUnderAForceIsNothing) {
  const Ellipse e;
  const auto spread = error_spread(std::vector{e.with([&](double) { return 0.1 * e.hertz.approach; })}, kSteel, true);
  ASSERT_TRUE(spread.at(0));
  EXPECT_EQ(spread[0]->force, 0.0);
  EXPECT_NEAR(spread[0]->pressure, 0.0, 1e-4);
  EXPECT_NEAR(spread[0]->area, 0.0, 1e-2);
  EXPECT_NEAR(spread[0]->approach, 0.0, 1e-3 * e.hertz.approach);
}

TEST(ErrorSpread, ABentSurfaceIsHertzWithAnotherCurvature) {
  for (const int elements : {47, 141}) {  // of the latter every third
    const Ellipse e(elements);
    const double bend = 0.3 * kCurvatureY;
    const auto spread = error_spread(std::vector{e.with([&](double y) { return bend * y * y; })}, kSteel, true);
    ASSERT_TRUE(spread.at(0));
    std::array<double, 2> pressure{}, area{}, approach{};
    for (const std::size_t k : {0u, 1u}) {
      const HertzEllipse now = hertz_by_force(kCurvatureX, kCurvatureY + (k == 0 ? bend : -bend), kForce, kModulus);
      pressure[k] = now.largest_pressure() / e.hertz.largest_pressure() - 1.0;
      area[k] = now.semi_axis_x * now.semi_axis_y / (e.hertz.semi_axis_x * e.hertz.semi_axis_y) - 1.0;
      approach[k] = now.approach - e.hertz.approach;
    }
    EXPECT_NEAR(spread[0]->pressure, rms(pressure), kFields * rms(pressure)) << elements;
    EXPECT_NEAR(spread[0]->area, rms(area), kAreas * rms(area)) << elements;
    EXPECT_NEAR(spread[0]->approach, rms(approach), kFields * rms(approach)) << elements;
    EXPECT_EQ(spread[0]->force, 0.0);
  }
}

TEST(ErrorSpread, ATiltedSurfaceIsTouchedElsewhere) {
  const Ellipse e;
  const double shift = 0.1 * e.hertz.semi_axis_y, tilt = 2.0 * kCurvatureY * shift;
  const auto spread = error_spread(std::vector{e.with([&](double y) { return tilt * y; })}, kSteel, true);
  ASSERT_TRUE(spread.at(0));
  EXPECT_NEAR(spread[0]->place, shift, kFields * shift);
  EXPECT_NEAR(spread[0]->pressure, 0.0, 5e-3);
}

/// The second patch is steep: it comes nearer by less than the wheel comes down, and carries less of the load.
TEST(ErrorSpread, PatchesShareTheLoad) {
  constexpr double kLowering = 0.8;
  const Ellipse e;
  const double off = 0.1 * e.hertz.approach, d = e.hertz.approach;
  std::vector<UncertainPatch> patches{e.with([&](double) { return off; }), e.with([](double) { return 0.0; })};
  patches[1].lowering = kLowering;
  patches[1].vertical_force = kLowering * kForce;
  const auto spread = error_spread(patches, kSteel, true);
  ASSERT_TRUE(spread.at(0) && spread.at(1));
  std::array<double, 2> first{}, second{};
  for (const std::size_t k : {0u, 1u}) {
    const double error = k == 0 ? off : -off;
    const auto force = [&](double depth) { return std::pow(std::max(0.0, depth) / d, 1.5) - 1.0; };
    double low = -d, high = d;  // of what the wheel comes down
    for (int i = 0; i < 100; ++i) {
      const double dz = 0.5 * (low + high);
      (force(d - error + dz) + kLowering * force(d + kLowering * dz) > 0.0 ? high : low) = dz;
    }
    first[k] = force(d - error + low), second[k] = force(d + kLowering * low);
  }
  EXPECT_NEAR(spread[0]->force, rms(first), kFields * rms(first));
  EXPECT_NEAR(spread[1]->force, rms(second), kFields * rms(second));
  const auto stay = error_spread(patches, kSteel, false);
  ASSERT_TRUE(stay.at(1));
  EXPECT_NEAR(stay[1]->force, 0.0, 1e-4) << "at its place it does not feel the other";
}

TEST(ErrorSpread, IsNotToldOfWhatIsNoPatch) {
  const Ellipse e;
  std::vector<UncertainPatch> patches(3, e.with([](double y) { return 1e-4 * y; }));
  patches[1].normal_force = 3.0 * kForce;
  const std::vector<double> nothing(e.gap.size(), std::nan(""));
  patches[2].gap = nothing;
  const auto spread = error_spread(patches, kSteel, true);
  EXPECT_TRUE(spread.at(0));
  EXPECT_FALSE(spread.at(1));
  EXPECT_FALSE(spread.at(2));
  EXPECT_TRUE(error_spread({}, kSteel, true).empty());
}

}  // namespace
}  // namespace treadmark::wheelrail
