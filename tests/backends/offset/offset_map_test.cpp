// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/offset/wheel_with_flat.hpp"

namespace treadmark::testing {
namespace {

using offset::Interpolation;

constexpr double kMapR = 0.46;

/// A wheel 7 times out of round, all round.
OffsetMap polygon(int n, double amplitude, int extra = 0) {
  OffsetMap map{"polygon", {0.1, -0.05, 2.0 * kPi / n, 0.005, n + extra, 21}, {}};
  for (int j = 0; j < map.grid.ny; ++j)
    for (int i = 0; i < map.grid.nx; ++i)
      map.offset.push_back(static_cast<float>(amplitude * std::cos(7.0 * map.grid.x(i))));
  return map;
}

TEST(OffsetMap, AWholeTurnIsPeriodic) {
  const auto base = analytic::make_revolved_surface(analytic::straight_chain(0.04), kMapR);
  for (const int extra : {0, 1}) {
    const auto sample = offset::offsets_from_map(polygon(701, 2e-4, extra), Body::wheel, 0.0);
    EXPECT_NEAR(sample.max_offset, 2e-4, 1e-9);
    EXPECT_EQ(sample.nodes, 701u * 21u);
    const auto surface = offset::make_offset_surface(base, sample.offsets, Interpolation::bicubic, "offset");
    for (int k = 0; k < 100; ++k) {
      const double theta = -3.2 + 0.0647 * k;
      EXPECT_NEAR(height_at(*surface, level(theta, 0.0, kMapR), {0.0, 0.003}), 2e-4 * std::cos(7.0 * theta), 2e-10)
          << theta;
    }
    const double seam = 0.1 - 0.5 * 2.0 * kPi / 701;
    EXPECT_NEAR(height_at(*surface, level(seam, 0.0, kMapR), {0.0, 0.003}), 2e-4 * std::cos(7.0 * seam), 2e-10);
  }
}

TEST(OffsetMap, APatchLiesWhereItsAnglesSayOnAnyBranch) {
  const auto base = analytic::make_revolved_surface(analytic::straight_chain(0.04), kMapR);
  for (const double branch : {0.0, 2.0 * kPi, -2.0 * kPi}) {
    OffsetMap map{"patch", {3.0 + branch, -0.01, 0.013, 0.001, 23, 21}, std::vector<float>(23 * 21, -1e-4f)};
    map.offset[5] = std::numeric_limits<float>::quiet_NaN();
    const auto sample = offset::offsets_from_map(map, Body::wheel, 1e-9);
    EXPECT_EQ(sample.active, 23u * 21u - 1u);
    const auto surface = offset::make_offset_surface(base, sample.offsets, Interpolation::bilinear, "offset");
    for (const double theta : {3.05, 3.14, -3.1, 3.2})
      EXPECT_NEAR(height_at(*surface, level(theta, 0.0, kMapR), {0.0, 0.0}), -1e-4, 1e-10);
    for (const double theta : {2.9, -2.9, 0.0})
      EXPECT_NEAR(height_at(*surface, level(theta, 0.0, kMapR), {0.0, 0.0}), 0.0, 1e-12);
  }
}

TEST(OffsetMap, RefusesWhatMakesNoSense) {
  const auto kind = [](const OffsetMap& map, Body body, double tolerance = 0.0) {
    try {
      offset::offsets_from_map(map, body, tolerance);
    } catch (const Error& e) {
      return static_cast<int>(e.kind());
    }
    return -1;
  };
  const int data = static_cast<int>(ErrorKind::input_data), wrong = static_cast<int>(ErrorKind::configuration);
  EXPECT_EQ(kind(polygon(100, 1e-4), Body::wheel), -1);
  EXPECT_EQ(kind(polygon(100, 1e-4), Body::wheel, -1.0), wrong);
  EXPECT_EQ(kind(polygon(100, 1e-4, 5), Body::wheel), data);   // more than a turn
  EXPECT_EQ(kind(polygon(100, 1e-4, -5), Body::wheel), data);  // a gap too small
  OffsetMap uneven = polygon(100, 1e-4);
  uneven.grid.dx *= 1.002;
  EXPECT_EQ(kind(uneven, Body::wheel), data);
  OffsetMap map = polygon(100, 1e-4);
  map.offset.pop_back();
  EXPECT_EQ(kind(map, Body::wheel), data);
  map = polygon(100, 1e-4);
  map.offset[7] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(kind(map, Body::wheel), data);
  map.offset[7] = 250.0f;  // micrometres
  EXPECT_EQ(kind(map, Body::wheel), data);
  map = polygon(100, 1e-4);
  map.grid.dy = 0.0;
  EXPECT_EQ(kind(map, Body::rail), data);
}

}  // namespace
}  // namespace treadmark::testing
