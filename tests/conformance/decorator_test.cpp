// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Surfaces made of other surfaces: what the one below tells of its parameters and data, they tell too.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/assembly/outermost_surface.hpp"
#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/spline/make.hpp"

namespace treadmark::testing {
namespace {

using SurfacePtr = std::shared_ptr<const Surface>;

constexpr double kRadius = 0.46;

/// A crown of 0.3 m, points 0.5 mm apart, of which none lies at y = 0.
Profile crown(Body body) {
  Profile p;
  p.body = body;
  for (int i = -60; i <= 60; ++i) {
    const double side = body == Body::rail ? 1.0 : -1.0, y = 0.5e-3 * i + 0.2e-3;
    p.y.push_back(side * y);
    p.z.push_back(side * (0.3 - std::sqrt(0.09 - y * y)));
  }
  return p;
}

SurfaceSpec of_points(Body body) { return {body, body == Body::wheel ? kRadius : 0.0, crown(body), {}}; }

SurfaceSpec of_slices(Body body) {
  SliceSet slices;
  slices.body = body;
  for (int k = -4; k <= 4; ++k) slices.u.push_back(0.05 * k), slices.profiles.push_back(crown(body));
  return {body, body == Body::wheel ? kRadius : 0.0, slices, {}};
}

/// x (of a rail) at which the bases are looked at and damaged.
constexpr double kPlace = 0.01;

Defects dip() {
  Squat squat;
  squat.length = squat.width = 20e-3, squat.depth = 0.2e-3, squat.x_center = kPlace;
  return {.squats = {squat}};
}

Defects flattened() {
  FlattenedHead head;
  head.x_start = kPlace - 0.1, head.x_end = kPlace + 0.1, head.ramp = 20e-3, head.depth = 0.3e-3;
  return {.flattened_heads = {head}};
}

Defects flat() {
  WheelFlat one;
  one.length = one.width = 20e-3, one.depth = 0.2e-3;
  return {.flats = {one}};
}

/// A decorator, and where it puts what it decorates.
struct Decorator {
  const char* name;
  Body body;
  std::function<SurfacePtr(const SurfacePtr&)> wrap;
  Pose X_SB{};
  bool turned_over = false;
};

const Pose kAside{{0.3, 0.01, -0.002}, Mat3::Identity()}, kAbout{{0.1, 0.0, 0.0}, rotation_z(std::acos(-1.0))};

std::vector<Decorator> decorators() {
  std::vector<Decorator> all;
  for (const Body body : {Body::rail, Body::wheel}) {
    all.push_back({"moved", body, [](auto& base) { return assembly::place_surface(base, kAside); }, kAside});
    all.push_back({"turned_about", body, [](auto& base) { return assembly::place_surface(base, kAbout); }, kAbout});
    all.push_back({"turned_over", body, [](auto& base) { return assembly::turn_over(base, kRadius); },
                   Pose{{0.0, 0.0, kRadius}, Vec3(1.0, -1.0, -1.0).asDiagonal()}, true});
  }
  all.push_back({"dipped", Body::rail, [](auto& base) { return analytic::add_defects(base, dip(), Body::rail, 0.0); }});
  all.push_back(
      {"cut", Body::rail, [](auto& base) { return analytic::add_defects(base, flattened(), Body::rail, 0.0); }});
  all.push_back({"limited", Body::rail, [](auto& base) { return assembly::limit_along(base, -0.1, 0.1); }});
  all.push_back(
      {"flat", Body::wheel, [](auto& base) { return analytic::add_defects(base, flat(), Body::wheel, kRadius); }});
  return all;
}

/// What is met along the normals of points in a line across; upright, so that damage leaves every point its place.
struct Line {
  Pose X_BP;
  std::vector<Vec2> points;

  explicit Line(Body body) : X_BP{body == Body::rail ? Vec3(kPlace, 0, 0) : Vec3(0, 0, kRadius), Mat3::Identity()} {
    for (int i = -40; i <= 40; ++i) points.emplace_back(0.0, 0.5e-3 * i);
  }
  std::vector<SurfacePoint> on(const Surface& surface) const { return on(surface, {"base", Body::rail, {}}); }
  std::vector<SurfacePoint> on(const Surface& surface, const Decorator& d) const {
    Pose X_SP = d.X_SB * X_BP;
    std::vector<Vec2> seen = points;
    if (d.turned_over) {
      X_SP.rotation *= Vec3(1.0, -1.0, -1.0).asDiagonal();
      for (Vec2& p : seen) p.y() *= -1.0;
    }
    std::vector<SurfacePoint> found(seen.size());
    surface.locate(X_SP, seen, found);
    return found;
  }
};

bool near(double a, double b) { return (std::isnan(a) && std::isnan(b)) || std::fabs(a - b) < 1e-9; }

class Decorators : public ::testing::TestWithParam<Decorator> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, Decorators, ::testing::ValuesIn(decorators()), [](const auto& which) {
  return std::string(which.param.name) + (which.param.body == Body::rail ? "_rail" : "_wheel");
});

TEST_P(Decorators, PassOnParametersArcLengthAndData) {
  const Decorator& d = GetParam();
  const Line line(d.body);
  const double sense = d.X_SB.rotation(1, 1) < 0.0 ? -1.0 : 1.0;
  for (const SurfaceSpec& spec : {of_points(d.body), of_slices(d.body)}) {
    const SurfacePtr base = create_natural(spec).surface, decorated = d.wrap(base);
    EXPECT_EQ(decorated->data_v(), base->data_v());
    const auto expected = line.on(*base), found = line.on(*decorated, d);
    for (std::size_t i = 0; i < found.size(); ++i) {
      ASSERT_NE(found[i].status, LocateStatus::outside);
      ASSERT_TRUE(near(found[i].v, expected[i].v)) << found[i].v << ' ' << expected[i].v;
      ASSERT_TRUE(near(found[i].arc_length, sense * expected[i].arc_length))
          << found[i].arc_length << ' ' << expected[i].arc_length;
    }
  }
}

TEST(SurfaceData, AreToldByRailsAndWheelsOfPointsAndSlices) {
  const Line line(Body::rail);
  const SurfacePtr points = create_natural(of_points(Body::rail)).surface;
  const auto at = line.on(*points);
  for (std::size_t i = 0; i < at.size(); ++i)
    ASSERT_NEAR(at[i].arc_length, 0.3 * std::asin(line.points[i].y() / 0.3), 1e-6);
  EXPECT_FALSE(create_natural(of_slices(Body::rail)).surface->data_v().empty());
  EXPECT_FALSE(create_natural(of_slices(Body::wheel)).surface->data_v().empty());
  EXPECT_FALSE(create_natural(of_points(Body::wheel)).surface->data_v().empty());
}

TEST(SurfaceData, AreNotToldBySeveralParts) {
  const SurfacePtr part = create_natural(of_points(Body::rail)).surface,
                   slices = create_natural(of_slices(Body::rail)).surface,
                   both = assembly::outermost_of({part, assembly::place_surface(slices, kAside)});
  EXPECT_TRUE(both->data_v().empty());
  for (const SurfacePoint& p : Line(Body::rail).on(*both)) EXPECT_TRUE(std::isnan(p.arc_length));
}

TEST(SurfaceData, OfARepresentationAreThoseOfItsBase) {
  const Line line(Body::rail);
  SurfaceSpec spec = of_points(Body::rail);
  spec.defects = dip();
  const NaturalSurface natural = create_natural(spec);
  const auto expected = line.on(*natural.surface);
  const Region region{-0.05, 0.07};
  const auto offset = line.on(*represent(natural, {"offset", 1e-3, region}).surface),
             mesh = line.on(*represent(natural, {"mesh", 1e-3, region}).surface);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_TRUE(near(offset[i].arc_length, expected[i].arc_length)) << offset[i].arc_length;
    ASSERT_TRUE(std::isnan(mesh[i].arc_length)) << "triangles have no profile";
  }
}

}  // namespace
}  // namespace treadmark::testing
