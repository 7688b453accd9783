// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/offset/wheel_with_flat.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::testing {
namespace {

using offset::Interpolation;
using offset::OffsetSettings;

constexpr double kOffsetR = 0.46;

double error_of(double step, Interpolation interpolation, double theta) {
  const WheelFlat flat = rounded_flat(0.06, 0.8e-3, theta, 0.05, 0.004);
  const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR);
  const auto target = analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR, {flat});
  OffsetSettings settings{step, step, 0.0, region(theta, 0.04, kOffsetR)};
  const auto sample = offset::sample_offsets(*target, *base, Body::wheel, kOffsetR, settings);
  const auto surface = offset::make_offset_surface(base, sample.offsets, interpolation, "offset");
  // the inner part, away from the ends where the cosine of the flat has a kink of its curvature
  const Grid2 g{-0.0147, -0.0097, 0.00041, 0.00037, 71, 53};
  const Pose X = level(theta, 0.004, kOffsetR);
  return greatest_difference(heights(*target, X, g), heights(*surface, X, g));
}

double order(Interpolation interpolation, double coarse, double theta) {
  return std::log2(error_of(coarse, interpolation, theta) / error_of(0.5 * coarse, interpolation, theta));
}

TEST(OffsetSurface, ConvergesWithTheOrderOfItsInterpolation) {
  constexpr double kCoarse = 2e-3;  // [m] finer ones end at the single precision of the offsets, 3e-11 m
  EXPECT_NEAR(order(Interpolation::bilinear, kCoarse, 0.3), 2.0, 0.2);
  EXPECT_NEAR(order(Interpolation::quadratic, kCoarse, 0.3), 3.0, 0.3);
  EXPECT_NEAR(order(Interpolation::bicubic, kCoarse, 0.3), 4.0, 0.4);
}

TEST(OffsetSurface, ErrorsAtOneMillimetreAreOfTheSizeOfTheTheory) {
  // d/2 (2 pi/L)^2 h^2/8 for bilinear
  const double k = 2.0 * kPi / 0.06;
  EXPECT_LT(error_of(1e-3, Interpolation::bilinear, 0.3), 2.5 * 0.4e-3 * k * k * 1e-6 / 8.0);
  EXPECT_LT(error_of(1e-3, Interpolation::quadratic, 0.3), 5e-8);
  EXPECT_LT(error_of(1e-3, Interpolation::bicubic, 0.3), 2e-9);
}

TEST(OffsetSurface, TheSeamIsNoPlaceLikeAnyOther) {
  // a flat across theta = pi, and one across theta = 0 where the voxels begin
  for (const Interpolation interpolation :
       {Interpolation::bilinear, Interpolation::quadratic, Interpolation::bicubic}) {
    const double elsewhere = error_of(1e-3, interpolation, 1.0);
    for (const double theta : {kPi, -kPi + 0.003, 0.0, 0.01}) {
      const double here = error_of(1e-3, interpolation, theta);
      EXPECT_LT(here, 1.5 * elsewhere + 1e-10) << theta;
      EXPECT_GT(here, 0.5 * elsewhere) << theta;
    }
  }
}

TEST(OffsetSurface, AFlatTakesLessThanATenthOfTheDenseWheel) {
  constexpr double kStep = 1e-4, kRadius = 0.49, kWidth = 0.135;
  const auto base = analytic::make_revolved_surface(analytic::straight_chain(0.5 * kWidth), kRadius);
  const auto target = analytic::make_revolved_surface(analytic::straight_chain(0.5 * kWidth), kRadius,
                                                      {rounded_flat(0.16, 1e-3, 0.2, 0.06, 0.01)});
  OffsetSettings settings{kStep, kStep, 1e-9, region(0.2, 0.09, kRadius)};
  const auto sample = offset::sample_offsets(*target, *base, Body::wheel, kRadius, settings);
  const double dense = 2.0 * kPi * kRadius / kStep * kWidth / kStep * sizeof(float);
  const std::size_t bytes = offset::memory_bytes(*sample.offsets);
  RecordProperty("bytes", static_cast<int>(bytes));
  EXPECT_LT(static_cast<double>(bytes), 0.1 * dense);
  EXPECT_NEAR(static_cast<double>(sample.active), 1600.0 * 600.0, 0.03 * 960000.0);
  EXPECT_EQ(offset::active_count(*sample.offsets), sample.active);
  EXPECT_NEAR(sample.max_offset, 1e-3, 1e-8);
  // leaves half filled and the upper nodes of the tree add less than another time the values
  EXPECT_LT(static_cast<double>(bytes), 2.0 * sizeof(float) * 960000.0);
  const auto cubic = offset::make_offset_surface(base, sample.offsets, Interpolation::bicubic, "offset");
  RecordProperty("bytes_bicubic", static_cast<int>(cubic->memory_bytes()));
  EXPECT_LT(static_cast<double>(cubic->memory_bytes()), 0.1 * dense);
}

TEST(OffsetSurface, OffsetsUpToTheRimDoNotRing) {
  // a flat over the whole width: the base ends where the offsets are greatest
  const auto chain = analytic::straight_chain(0.03);
  const auto base = analytic::make_revolved_surface(chain, kOffsetR);
  const auto target = analytic::make_revolved_surface(chain, kOffsetR, {rounded_flat(0.06, 0.8e-3, 0.0)});
  const auto sample =
      offset::sample_offsets(*target, *base, Body::wheel, kOffsetR, {1e-3, 0.7e-3, 1e-9, region(0.0, 0.05, kOffsetR)});
  EXPECT_EQ(sample.continued, 0u);
  const auto surface = offset::make_offset_surface(base, sample.offsets, Interpolation::bicubic, "offset");
  const Grid2 g{-0.02, -0.03, 0.0007, 0.0005, 60, 121};
  EXPECT_LT(greatest_difference(heights(*target, level(0.0, 0.0, kOffsetR), g),
                                heights(*surface, level(0.0, 0.0, kOffsetR), g)),
            5e-9);
}

TEST(OffsetSurface, ContinuesOffsetsWhereTheTargetIsMissing) {
  const auto base = analytic::make_revolved_surface(analytic::straight_chain(0.03), kOffsetR);
  const auto target = analytic::make_revolved_surface(analytic::straight_chain(0.02), kOffsetR + 1e-4);
  const auto sample =
      offset::sample_offsets(*target, *base, Body::wheel, kOffsetR, {5e-3, 1e-3, 1e-9, region(0.0, 0.1, kOffsetR)});
  EXPECT_GT(sample.continued, 300u);
  EXPECT_LT(sample.continued, sample.nodes / 2);
  const auto surface = offset::make_offset_surface(base, sample.offsets, Interpolation::bilinear, "offset");
  EXPECT_NEAR(height_at(*surface, level(0.0, 0.0, kOffsetR), {0.0, 0.027}), 1e-4, 1e-10);
}

TEST(OffsetSurface, ARailWithADent) {
  // dents of two cylinders: a rail of one radius seen from one of another
  const auto base = analytic::make_prismatic_surface(analytic::cylinder_chain(0.3, 0.1));
  const auto target = analytic::make_prismatic_surface(analytic::cylinder_chain(0.25, 0.119));
  const auto sample =
      offset::sample_offsets(*target, *base, Body::rail, 0.0, {2e-3, 1e-3, 1e-9, {-0.05, 0.05, -1.0, 1.0}});
  const auto surface = offset::make_offset_surface(base, sample.offsets, Interpolation::bicubic, "offset");
  EXPECT_EQ(surface->facing(), Facing::up);
  const Grid2 g{-0.0201, -0.0201, 0.0011, 0.0011, 37, 37};
  for (const RollYawPitch tilt : {RollYawPitch{}, RollYawPitch{0.05, 0.2, 0.0}, RollYawPitch{-0.03, 0.0, 0.02}}) {
    const Pose X{Vec3(0.001, 0.0, 0.0), rotation(tilt)};
    EXPECT_LT(greatest_difference(heights(*target, X, g), heights(*surface, X, g)), 2e-9);
  }
}

TEST(OffsetSurface, BoundsOfTheFieldHoldAndSlopesFit) {
  const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR);
  const auto target =
      analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR, {rounded_flat(0.06, 0.8e-3, kPi, 0.05, 0.004)});
  const auto sample =
      offset::sample_offsets(*target, *base, Body::wheel, kOffsetR, {1e-3, 1e-3, 1e-9, region(kPi, 0.05, kOffsetR)});
  for (const Interpolation interpolation :
       {Interpolation::bilinear, Interpolation::quadratic, Interpolation::bicubic}) {
    const auto surface = offset::make_offset_surface(base, sample.offsets, interpolation, "offset");
    const Pose X = level(kPi, 0.0, kOffsetR);
    for (const double size : {1e-5, 1e-3, 0.01, 0.1})
      for (int k = 0; k < 50; ++k) {
        const double x = -0.04 + 0.0013 * k, y = -0.02 + 0.00077 * k;
        const HeightBounds b = surface->height_bounds(X, {x, x + size, y, y + 0.7 * size});
        const Grid2 g{x, y, size / 7, 0.7 * size / 7, 8, 8};
        for (const double z : heights(*surface, X, g)) {
          if (std::isnan(z)) continue;
          EXPECT_LE(z, b.z_max + 1e-12);
          EXPECT_GE(z, b.z_min - 1e-12);
        }
        // slopes of the profile up to 0.1; those of the flat, up to 0.042 and 0.05, count over the four voxels of the
        // spline
        if (size < 2e-3) {
          EXPECT_LT(b.z_max - b.z_min, 0.5 * size + 4e-3 * (0.042 + 0.05));
        }
      }
  }
}

TEST(OffsetSurface, ThreadsChangeNothing) {
  const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR);
  const auto target =
      analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR, {rounded_flat(0.06, 0.8e-3, 0.0, 0.05, 0.004)});
  std::array<std::vector<double>, 2> z;
  for (int run = 0; run < 2; ++run) {
    const ThreadLimit limit(run == 0 ? 1 : 4);
    const auto sample =
        offset::sample_offsets(*target, *base, Body::wheel, kOffsetR, {1e-3, 1e-3, 1e-9, region(0.0, 0.05, kOffsetR)});
    const auto surface = offset::make_offset_surface(base, sample.offsets, Interpolation::bicubic, "offset");
    z[static_cast<std::size_t>(run)] =
        heights(*surface, level(0.0, 0.0, kOffsetR), {-0.03, -0.02, 0.0007, 0.0007, 90, 60});
  }
  EXPECT_EQ(z[0], z[1]);
}

TEST(OffsetSurface, RefusesSettingsThatMakeNoSense) {
  const auto wheel = analytic::make_standard_surface({"S1002"}, Body::wheel, kOffsetR);
  const auto rail = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  const auto kind = [&](Body body, double R, OffsetSettings s) {
    try {
      offset::sample_offsets(body == Body::wheel ? *wheel : *rail, body == Body::wheel ? *wheel : *rail, body, R, s);
    } catch (const Error& e) {
      return static_cast<int>(e.kind());
    }
    return -1;
  };
  const int wrong = static_cast<int>(ErrorKind::configuration);
  EXPECT_EQ(kind(Body::wheel, kOffsetR, {.du = 0.0}), wrong);
  EXPECT_EQ(kind(Body::wheel, kOffsetR, {.dy = -1.0}), wrong);
  EXPECT_EQ(kind(Body::wheel, kOffsetR, {.tolerance = -1.0}), wrong);
  EXPECT_EQ(kind(Body::wheel, 0.0, {}), wrong);
  EXPECT_EQ(kind(Body::wheel, kOffsetR, {.du = 1e-6, .dy = 1e-6}), wrong);
  EXPECT_EQ(kind(Body::wheel, kOffsetR, {.region_uy = {1.0, 0.0, -1.0, 1.0}}), wrong);
  EXPECT_EQ(kind(Body::rail, 0.0, {}), wrong);
  EXPECT_EQ(kind(Body::rail, 0.0, {.region_uy = {0.0, 0.1, 5.0, 6.0}}), wrong);
  // few nodes, but their numbers are beyond 5e8: at both ends of both directions
  const auto refusal = [&](const treadmark::Rectangle& region, double du, double dy) {
    return treadmark::testing::error_of(
        [&] { offset::sample_offsets(*rail, *rail, Body::rail, 0.0, {.du = du, .dy = dy, .region_uy = region}); });
  };
  constexpr double kFine = 1e-11;
  for (const double x : {600.0, -600.0})
    EXPECT_THAT(refusal({x, x + 1e-5, 0.0, 1e-2}, 1e-6, 1e-3), ::testing::HasSubstr("too far from the origin")) << x;
  for (const double y : {0.01, -0.01})
    EXPECT_THAT(refusal({0.0, 1e-3, y, y + 10.0 * kFine}, 1e-4, kFine), ::testing::HasSubstr("too far from the origin"))
        << y;
  EXPECT_EQ(refusal({-400.0, -400.0 + 1e-5, 0.0, 1e-2}, 1e-6, 1e-3), "");
  EXPECT_THROW(offset::sample_offsets(*wheel, *rail, Body::wheel, kOffsetR, {}), Error);
  const auto sample = offset::sample_offsets(*wheel, *wheel, Body::wheel, kOffsetR, {.du = 0.01, .dy = 0.01});
  EXPECT_EQ(sample.active, 0u);
  EXPECT_THROW(offset::make_offset_surface(rail, sample.offsets, Interpolation::bicubic, "offset"), Error);
  EXPECT_THROW(offset::make_offset_surface(nullptr, sample.offsets, Interpolation::bicubic, "offset"), Error);
}

}  // namespace
}  // namespace treadmark::testing
