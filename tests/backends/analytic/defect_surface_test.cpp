// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/analytic/brute_force.hpp"
#include "treadmark/tests/backends/analytic/defect_formulas.hpp"

namespace treadmark::testing {
namespace {

constexpr double kCrown = 0.08, kBarrel = 0.09, kHalf = 0.7;

std::shared_ptr<const Surface> base_of(Body body) {
  return body == Body::rail ? analytic::make_prismatic_surface(analytic::cylinder_chain(kCrown, kHalf))
                            : analytic::make_revolved_surface(analytic::barrel_chain(kBarrel, kHalf), kTestRadius);
}

/// The damaged surface as a formula.
Outside outside_of(const NamedDefects& d) {
  if (d.body == Body::rail)
    return [offset = d.offset](const Vec3& p) {
      if (std::fabs(p.y()) > kCrown * std::sin(kHalf)) return std::numeric_limits<double>::quiet_NaN();
      return kCrown - std::sqrt(kCrown * kCrown - p.y() * p.y()) + offset(p.x(), p.y()) - p.z();
    };
  return [offset = d.offset](const Vec3& p) {
    if (std::fabs(p.y()) > kBarrel * std::sin(kHalf)) return std::numeric_limits<double>::quiet_NaN();
    const double z = std::sqrt(kBarrel * kBarrel - p.y() * p.y()) - kBarrel;
    return std::hypot(p.x(), p.z()) - kTestRadius - z - offset(std::atan2(p.x(), p.z()), p.y());
  };
}

class DamagedSurface : public ::testing::TestWithParam<NamedDefects> {};
INSTANTIATE_TEST_SUITE_P(Shapes, DamagedSurface, ::testing::ValuesIn(offset_defects()),
                         [](const auto& which) { return which.param.name; });

TEST_P(DamagedSurface, HeightsAndSlopesMatchABruteForceSearch) {
  const NamedDefects& d = GetParam();
  const bool wheel = d.body == Body::wheel;
  const auto base = base_of(d.body), surface = analytic::add_defects(base, d.defects, d.body, kTestRadius);
  EXPECT_EQ(surface->backend(), "analytic");
  const Outside outside = outside_of(d);
  // lines are searched to rounding on both sides; differences of the formula are good to 1e-9 but where it has kinks
  constexpr double kTolerance = 2e-12, kGrazing = 0.1, kSlope = 1e-6, kEnd = 2e-4;
  const double end = (wheel ? kBarrel : kCrown) * std::sin(kHalf) - kEnd, middle = 0.5 * (d.u_min + d.u_max);
  int compared = 0, changed = 0, odd = 0;
  for (const RollYawPitch& turn : {RollYawPitch{}, RollYawPitch{0.3, 0.1, -0.05}, RollYawPitch{-0.5, -0.8, 0.15}}) {
    Pose X{{0.0, 0.002, wheel ? kTestRadius : 0.001}, rotation(turn)};
    if (wheel)
      X = Pose{Vec3::Zero(), rotation_y(middle)} * X;
    else
      X.origin.x() = middle;
    const Grid2 g{-0.0351, -0.0213, 0.0041, 0.0029, 17, 15};
    std::vector<double> z(g.size()), dzdx(g.size()), dzdy(g.size());
    surface->heights({X, g}, {z, dzdx, dzdy});
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const std::size_t i = g.index(ix, iy);
        const Crossing hit = first_crossing(outside, X, g.x(ix), g.y(iy), wheel, 0.06, 1e-4);
        if (std::isnan(hit.z) || hit.slant < kGrazing) continue;
        const Vec3 p = X.apply({g.x(ix), g.y(iy), hit.z});
        if (std::fabs(p.y()) > end) continue;
        ++compared;
        ASSERT_NEAR(z[i], hit.z, kTolerance / hit.slant) << g.x(ix) << ' ' << g.y(iy);
        if (d.offset(wheel ? std::atan2(p.x(), p.z()) : p.x(), p.y()) != 0.0) ++changed;
        const Vec3 normal = (X.rotation * Vec3(-dzdx[i], -dzdy[i], 1.0)).normalized();
        if (normal.cross(hit.gradient.normalized()).norm() > kSlope) ++odd;
      }
  }
  EXPECT_GT(compared, 300);
  EXPECT_GT(changed, 50);
  EXPECT_LE(odd, compared / 100);
}

/// Flats have two ways: built into the wheel, or as an offset of it.
TEST(DamagedSurface, FlatsBuiltInOrAddedAreTheSame) {
  const WheelFlat flat{WheelFlat::Shape::rounded, 0.1, 1e-3, 0.0, 0.005, 0.05};
  const auto built_in = analytic::make_standard_surface({"S1002"}, Body::wheel, kTestRadius, {flat});
  const auto added = analytic::add_defects(analytic::make_standard_surface({"S1002"}, Body::wheel, kTestRadius),
                                           {.flats = {flat}}, Body::wheel, kTestRadius);
  const Pose X{{0.0, 0.0, kTestRadius}, rotation({0.05, 0.02, 0.03})};
  for (double x = -0.06; x < 0.06; x += 0.0047)
    for (double y = -0.02; y < 0.03; y += 0.0037)
      EXPECT_NEAR(height_at(*added, X, {x, y}), height_at(*built_in, X, {x, y}), 2e-12) << x << ' ' << y;
}

std::string refusal(const Defects& d, Body body) {
  try {
    analytic::add_defects(base_of(body), d, body, kTestRadius);
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::configuration);
    return e.what();
  }
  return "none";
}

TEST(DamagedSurface, RefusesWhatMakesNoSense) {
  using ::testing::HasSubstr;
  const Squat good{.length = 0.04, .width = 0.03, .depth = 3e-4};
  Squat deep = good, backwards = good;
  deep.depth = 0.02;
  backwards.second_distance = -0.01;
  EXPECT_EQ(refusal({.squats = {good, good}}, Body::rail), "none");
  EXPECT_THAT(refusal({.squats = {good, deep}}, Body::rail),
              HasSubstr("rail.squats[1]: a dip is too deep for its length"));
  EXPECT_THAT(refusal({.squats = {backwards}}, Body::rail), HasSubstr("must not be negative"));
  EXPECT_THAT(refusal({.squats = {good}}, Body::wheel), HasSubstr("belong to rails"));
  EXPECT_THAT(refusal({.flats = {{WheelFlat::Shape::rounded, 0.1, 1e-3, 0, 0, 0}}}, Body::rail),
              HasSubstr("belong to wheels"));
  EXPECT_THAT(refusal({.flats = {{WheelFlat::Shape::rounded, 0.9, 0.24, 0, 0, 0}}}, Body::wheel),
              HasSubstr("wheel.flats[0]: the depth"));
  EXPECT_THAT(refusal({.polygonizations = {{{{0, 1e-4, 0.0}}, 0.0, 0.0}}}, Body::wheel), HasSubstr("at least 1"));
  EXPECT_THAT(refusal({.polygonizations = {{{}, 0.0, 0.0}}}, Body::wheel), HasSubstr("at least one harmonic"));
  EXPECT_EQ(refusal({.polygonizations = {{{{7, -1e-4, 0.0}}, 0.0, 0.0}}}, Body::wheel),
            "none");  // phase turned by half a wave
  EXPECT_THAT(refusal({.corrugations = {{{{0.05, 1e-5, 0.0}}, 0.0, 0.1, 0.06, 0.0, 0.0}}}, Body::rail),
              HasSubstr("longer than half"));
  EXPECT_THAT(refusal({.corrugations = {{{{0.05, std::nan(""), 0.0}}, 0.0, 0.1, 0.02, 0.0, 0.0}}}, Body::rail),
              HasSubstr("finite"));
  EXPECT_THAT(refusal({.gauge_corner_collapses = {{0.3, 1e-3, 0.01, 0.0, 0.0, 0}}}, Body::rail),
              HasSubstr("gauge side"));
  EXPECT_EQ(refusal({.spalls = {{0.03, 0.02, 1e-3, 2e-3, 0.0, 0.0}}}, Body::rail), "none");
  EXPECT_THAT(refusal({.spalls = {{0.03, 0.02, 1e-3, 1e-3, 0.0, 0.0}}}, Body::rail),
              HasSubstr("rail.spalls[0]: the edge is too narrow for the depth"));
  EXPECT_THAT(refusal({.spalls = {{0.03, 0.02, 1e-3, 0.011, 0.0, 0.0}}}, Body::rail), HasSubstr("wider than half"));
  EXPECT_THAT(refusal({.spalls = {{0.03, 0.02, 1e-3, 2e-3, 0.0, 0.0}}}, Body::wheel),
              HasSubstr("spalls belong to rails, not to wheels"));
  MillingPath mill{{{-0.1, 0, 0, 0}, {0.1, 0, 0, 0}}, -0.02, 0.0, 0.0, {{0.04, 0.0}}};
  EXPECT_EQ(refusal({.milling_paths = {mill}}, Body::rail), "none");
  mill.stations[1].z = 0.5;
  EXPECT_THAT(refusal({.milling_paths = {mill}}, Body::rail),
              HasSubstr("rail.milling_paths[0]: the path is steeper than 45 degrees"));
  mill.stations[1] = {0.1, 0, 0, 1.4};
  EXPECT_THAT(refusal({.milling_paths = {mill}}, Body::rail), HasSubstr("too steep"));
  mill.stations[1] = {0.1, 0, 0, 0};
  mill.section = {{0.04, 100.0}};
  EXPECT_THAT(refusal({.milling_paths = {mill}}, Body::rail), HasSubstr("it must be a graph z(y)"));
  EXPECT_THROW(analytic::add_defects(nullptr, {.squats = {good}}, Body::rail, 0.0), Error);
}

}  // namespace
}  // namespace treadmark::testing
