// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/assembly/outermost_surface.hpp"
#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::assembly {
namespace {

using SurfacePtr = std::shared_ptr<const Surface>;

struct Fields {
  std::vector<double> z, dzdx, dzdy;
  /// Also where both are missing.
  friend bool operator==(const Fields& a, const Fields& b) {
    const auto same = [](double p, double q) { return p == q || (std::isnan(p) && std::isnan(q)); };
    return ranges::equal(a.z, b.z, same) && ranges::equal(a.dzdx, b.dzdx, same) && ranges::equal(a.dzdy, b.dzdy, same);
  }
};

Fields evaluate(const Surface& surface, const Pose& X, const Grid2& g) {
  Fields f{std::vector<double>(g.size()), std::vector<double>(g.size()), std::vector<double>(g.size())};
  surface.heights({X, g}, {f.z, f.dzdx, f.dzdy});
  return f;
}

const Grid2 kGrid{-0.04, -0.05, 1.3e-3, 1.1e-3, 60, 90};
const std::vector<Pose> kPlanes{
    {}, {{0.0, 0.01, 0.002}, rotation({-0.5, 0.1, 0.05})}, {{0.01, -0.02, 0.0}, rotation({0.8, -0.2, 0.0})}};

/// A cylinder along x of radius 40 mm.
SurfacePtr cylinder() { return analytic::make_prismatic_surface(analytic::cylinder_chain(0.04, 0.7)); }
SurfacePtr cylinder_at(double y, double z) { return place_surface(cylinder(), {{0.0, y, z}, Mat3::Identity()}); }

TEST(Outermost, OfASurfaceAndItselfIsThatSurface) {
  const SurfacePtr rail = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}}, "spline");
  const SurfacePtr wheel = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {}});
  for (const SurfacePtr& one : {rail, wheel}) {
    const SurfacePtr twice = outermost_of({one, one});
    EXPECT_EQ(twice->backend(), one->backend());
    EXPECT_EQ(twice->facing(), one->facing());
    for (Pose X : kPlanes) {
      if (one == wheel) X.origin.z() += 0.46;
      EXPECT_EQ(evaluate(*twice, X, kGrid), evaluate(*one, X, kGrid));
      const Rectangle r{-0.003, 0.004, -0.002, 0.003};
      EXPECT_EQ(twice->height_bounds(X, r).z_min, one->height_bounds(X, r).z_min);
      EXPECT_EQ(twice->height_bounds(X, r).z_max, one->height_bounds(X, r).z_max);
    }
  }
}

TEST(Outermost, OfTwoCylindersIsTheLesserHeight) {
  const SurfacePtr both = outermost_of({cylinder_at(-0.02, 0.0), cylinder_at(0.015, 1e-3)});
  const auto circle = [](double y) {
    return std::fabs(y) <= 0.04 * std::sin(0.7) ? 0.04 - std::sqrt(0.04 * 0.04 - y * y) : INFINITY;
  };
  int left = 0, right = 0, none = 0;
  for (double y = -0.06; y < 0.06; y += 0.7e-3) {
    const double a = circle(y + 0.02), b = 1e-3 + circle(y - 0.015), z = height_at(*both, {}, {0.3, y});
    if (!std::isfinite(std::min(a, b))) {
      EXPECT_TRUE(std::isnan(z)) << y;
      ++none;
      continue;
    }
    EXPECT_NEAR(z, std::min(a, b), 1e-14) << y;
    ++(a < b ? left : right);
    std::vector<SurfacePoint> p(1);
    both->locate({}, std::vector<Vec2>{{0.3, y}}, p);
    const double middle_y = a < b ? -0.02 : 0.015, middle_z = a < b ? 0.04 : 0.041;
    EXPECT_LE((p[0].normal_S - Vec3(0.0, y - middle_y, z - middle_z) / 0.04).norm(), 1e-12)
        << "the normal is that of the part that wins";
    EXPECT_NEAR(p[0].curvature_1, 25.0, 1e-9);
  }
  EXPECT_GT(std::min({left, right, none}), 20);
  EXPECT_FALSE(both->constant_profile());
}

TEST(Outermost, NeitherOrderNorThreadsMatter) {
  const SurfacePtr a = cylinder_at(-0.02, 0.0),
                   b = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}}, "spline"),
                   c = cylinder_at(0.05, -0.002);
  const SurfacePtr forward = outermost_of({a, b, c}), backward = outermost_of({c, b, a});
  EXPECT_EQ(forward->backend(), "analytic+spline");
  EXPECT_EQ(backward->backend(), "analytic+spline");
  for (const Pose& X : kPlanes) {
    Fields one, many;
    {
      ThreadLimit limit(1);
      one = evaluate(*forward, X, kGrid);
    }
    {
      ThreadLimit limit(4);
      many = evaluate(*backward, X, kGrid);
    }
    EXPECT_EQ(one, many);
    for (std::size_t k = 0; k < one.z.size(); ++k) {
      const Vec2 p(kGrid.x(static_cast<int>(k) % kGrid.nx), kGrid.y(static_cast<int>(k) / kGrid.nx));
      double least = NAN;
      for (const SurfacePtr& part : {a, b, c}) least = std::fmin(least, height_at(*part, X, p));
      ASSERT_EQ(std::isnan(least), std::isnan(one.z[k]));
      if (!std::isnan(least)) {
        ASSERT_NEAR(one.z[k], least, 1e-12);
      }
    }
  }
}

TEST(Outermost, PartsOfABodyHaveTheirOwnBackends) {
  const auto given =
      std::make_shared<const NaturalSurface>(create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}}));
  const NaturalSurface whole =
      join_surfaces({{given, {0.0, -0.04, 0.0}, "mesh", 1e-3}, {given, {0.0, 0.04, 0.001}, "", 0.0}});
  EXPECT_EQ(whole.surface->backend(), "analytic");
  const Region region{-0.02, 0.02, -0.1, 0.1};
  EXPECT_EQ(represent(whole, {"", 0.0, region}).surface->backend(), "analytic+mesh");
  const RepresentedSurface r = represent(whole, {"spline", 0.0, region});
  EXPECT_EQ(r.surface->backend(), "mesh+spline");
  EXPECT_TRUE(r.resampled);
  const SurfaceDifference d = fit_error(whole, r);
  EXPECT_GT(d.points, 1000u);
  EXPECT_LE(d.height_rms, 1e-6);
  // the skin as one mesh
  const TriangleMesh skin = to_triangles(whole, {"", 2e-3, region});
  for (const Vec3& v : skin.vertices) ASSERT_NEAR(height_at(*whole.surface, {}, {v.x(), v.y()}), v.z(), 1e-12);
}

TEST(Outermost, RefusesWhatMakesNoBody) {
  const SurfacePtr rail = cylinder(), wheel = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {}});
  EXPECT_THROW(outermost_of({}), Error);
  EXPECT_THROW(outermost_of({rail, nullptr}), Error);
  EXPECT_THROW(outermost_of({rail, wheel}), Error);
  EXPECT_THROW(join_surfaces({}), Error);
  const auto given =
      std::make_shared<const NaturalSurface>(create_natural({Body::wheel, 0.46, StandardProfile{"S1002"}, {}}));
  EXPECT_THROW(join_surfaces({{given, {0.0, 0.0, 0.1}, "", 0.0}}), Error);
  EXPECT_THROW(place_surface(nullptr, {}), Error);
}

TEST(Placed, SurfacesMoveAsTheirFramesDo) {
  const SurfacePtr rail = create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  const Pose X_SB{{0.1, -0.02, 0.003}, rotation({0.1, 0.02, 0.03})};
  const SurfacePtr moved = place_surface(rail, X_SB);
  for (const Pose& X_BP : kPlanes) {
    const Fields before = evaluate(*rail, X_BP, kGrid), after = evaluate(*moved, X_SB * X_BP, kGrid);
    for (std::size_t i = 0; i < kGrid.size(); ++i) {
      ASSERT_EQ(std::isnan(before.z[i]), std::isnan(after.z[i]));
      if (!std::isnan(before.z[i])) {
        ASSERT_NEAR(before.z[i], after.z[i], 1e-11);
      }
    }
  }
  EXPECT_FALSE(moved->constant_profile());
  EXPECT_TRUE(place_surface(rail, {{0.0, 0.03, 0.001}, Mat3::Identity()})->constant_profile());
}

}  // namespace
}  // namespace treadmark::assembly
