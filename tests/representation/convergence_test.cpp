// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/create.hpp"

namespace treadmark::testing {
namespace {

/// Greatest differences of heights and slopes on the smooth inside of tread and flat, seen from a tilted plane.
struct Difference {
  double height = 0.0, slope = 0.0;
};

Difference difference(const Surface& a, const Surface& b) {
  const Pose X{{0.0, 0.002, 0.46}, rotation({0.03, 0.02, 0.0})};
  const Grid2 g{-0.0203, -0.0102, 0.00071, 0.00037, 58, 56};
  std::vector<double> z[2], dx[2], dy[2];
  const Surface* surfaces[2] = {&a, &b};
  for (int k = 0; k < 2; ++k) {
    z[k].resize(g.size());
    dx[k] = dy[k] = z[k];
    surfaces[k]->heights({X, g}, {z[k], dx[k], dy[k]});
  }
  Difference worst;
  for (std::size_t i = 0; i < g.size(); ++i) {
    worst.height = std::max(worst.height, std::fabs(z[0][i] - z[1][i]));
    worst.slope = std::max({worst.slope, std::fabs(dx[0][i] - dx[1][i]), std::fabs(dy[0][i] - dy[1][i])});
    EXPECT_FALSE(std::isnan(z[0][i]) || std::isnan(z[1][i]));
  }
  return worst;
}

constexpr double kRadius = 0.46;

/// Observed orders between the coarsest and the finest of three spacings, each half of the one before.
void expect_orders(const Difference (&d)[3]) {
  constexpr double kHeight = 3.0, kSlope = 2.0;  // a cubic spline has 4 and 3
  EXPECT_GT(0.5 * std::log2(d[0].height / d[2].height), kHeight)
      << d[0].height << ' ' << d[1].height << ' ' << d[2].height;
  EXPECT_GT(0.5 * std::log2(d[0].slope / d[2].slope), kSlope) << d[0].slope << ' ' << d[1].slope << ' ' << d[2].slope;
  EXPECT_GT(d[0].height, 1e-11) << "too smooth to see an order";
  EXPECT_LT(d[2].height, 1e-9);
}

TEST(Convergence, SplineOfARoundWheel) {
  const auto exact = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius);
  Difference d[3];
  double step = 4e-3;
  for (auto& one : d) {
    const SurfaceSpec spec{Body::wheel, kRadius, analytic::sample_profile(StandardProfile{"S1002"}, step), {}};
    one = difference(*create_surface(spec, "spline"), *exact);
    step *= 0.5;
  }
  expect_orders(d);
}

TEST(Convergence, SplineOfAWheelWithARoundedFlat) {
  WheelFlat flat;
  flat.length = 0.12;
  flat.depth = 1.4e-3;
  flat.y_center = 0.004;
  flat.width = 0.1;
  const auto exact = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius, {flat});
  Difference d[3];
  double step = 4e-3;
  for (auto& one : d) {
    const Profile profile = analytic::sample_profile(StandardProfile{"S1002"}, step);
    const SurfaceSpec spec{Body::wheel, kRadius, analytic::sample_wheel(profile, kRadius, {flat}, step), {}};
    one = difference(*create_surface(spec, "spline"), *exact);
    step *= 0.5;
  }
  expect_orders(d);
}

}  // namespace
}  // namespace treadmark::testing
