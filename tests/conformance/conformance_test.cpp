// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/tests/conformance/subjects.hpp"

namespace treadmark::testing {
namespace {

struct Fields {
  std::vector<double> z, dzdx, dzdy;
};

Fields evaluate(const Surface& surface, const Pose& X, const Grid2& grid) {
  Fields f;
  f.z.assign(grid.size(), 0.0);
  f.dzdx = f.dzdy = f.z;
  surface.heights({X, grid}, {f.z, f.dzdx, f.dzdy});
  return f;
}

/// Odd steps, so that no point falls on a joint by chance.
Grid2 coarse_grid() { return {-0.0197, -0.0293, 0.00131, 0.00193, 31, 31}; }
Grid2 fine_grid() { return {-0.0197, -0.0293, 0.00062, 0.00094, 65, 63}; }

bool same(double a, double b, double tolerance) {
  return (std::isnan(a) && std::isnan(b)) || std::fabs(a - b) <= tolerance;
}

class Conformance : public ::testing::TestWithParam<Subject> {
 protected:
  const Subject& subject() const { return GetParam(); }
  const Shape& shape() const { return GetParam().shape; }
  std::shared_ptr<const Surface> surface_ = GetParam().make();
};

INSTANTIATE_TEST_SUITE_P(Backends, Conformance, ::testing::ValuesIn(subjects()), [](const auto& which) {
  std::string name = which.param.shape.name + "__" + which.param.contestant.backend;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(Conformance, NamesItsBackendAndFacesTheOtherBody) {
  EXPECT_EQ(surface_->backend(), subject().contestant.backend);
  EXPECT_EQ(surface_->facing(), shape().spec.body == Body::wheel ? Facing::down : Facing::up);
  EXPECT_GT(surface_->memory_bytes(), 0u);
}

TEST_P(Conformance, HeightsMatchABruteForceLineSearch) {
  const double tolerance = subject().tolerance().height;
  // where the line only grazes the surface, or close to the ends of the profile, tiny errors decide between hit and
  // miss
  constexpr double kGrazing = 0.1, kEnd = 1e-4;
  const bool wheel = shape().spec.body == Body::wheel;
  const Grid2 g = coarse_grid();
  int compared = 0;
  for (const Pose& X : shape().planes) {
    const Fields f = evaluate(*surface_, X, g);
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const double x = g.x(ix), y = g.y(iy), z = f.z[g.index(ix, iy)];
        const BruteHit hit = brute_force(shape(), X, x, y);
        const bool hit_at_end = !std::isnan(hit.z) && (hit.y < shape().y_min + kEnd || hit.y > shape().y_max - kEnd);
        if (!std::isnan(hit.z) && hit.slant > kGrazing && !hit_at_end) {
          ASSERT_FALSE(std::isnan(z)) << "missed at " << x << ' ' << y << ", brute force " << hit.z << " slant "
                                      << hit.slant;
          // never inside of the outermost hit
          const double deeper = (wheel ? hit.z - z : z - hit.z) * hit.slant;
          ASSERT_LE(deeper, tolerance) << "at " << x << ' ' << y << " slant " << hit.slant;
          ++compared;
        }
        if (std::isnan(z) || z < shape().r_low || z > shape().r_high) continue;
        const Vec3 p = X.apply({x, y, z});
        if (p.y() < shape().y_min + kEnd || p.y() > shape().y_max - kEnd) continue;
        // and always on the surface
        const double distance = std::fabs(shape().outside(p)) / gradient(shape(), p).norm();
        ASSERT_LE(distance, tolerance) << "at " << x << ' ' << y << ", profile y " << p.y();
      }
  }
  EXPECT_GT(compared, 1000);
}

TEST_P(Conformance, NormalsFromSlopesMatchTheFormula) {
  const Grid2 g = coarse_grid();
  const double kinks = shape().name == "fresh_flat" && subject().contestant.backend != "analytic" ? 0.05 : 0.0;
  int compared = 0, wrong = 0;
  for (const Pose& X : shape().planes) {
    const Fields f = evaluate(*surface_, X, g);
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const std::size_t i = g.index(ix, iy);
        ASSERT_EQ(std::isnan(f.z[i]), std::isnan(f.dzdx[i]));
        ASSERT_EQ(std::isnan(f.z[i]), std::isnan(f.dzdy[i]));
        if (std::isnan(f.z[i]) || f.z[i] < shape().r_low || f.z[i] > shape().r_high) continue;
        const Vec3 p = X.apply({g.x(ix), g.y(iy), f.z[i]});
        if (p.y() < shape().y_min + 1e-4 || p.y() > shape().y_max - 1e-4) continue;
        const Vec3 expected = gradient(shape(), p).normalized();
        const Vec3 normal = (X.rotation * Vec3(-f.dzdx[i], -f.dzdy[i], 1.0)).normalized();
        ++compared;
        if (normal.cross(expected).norm() > subject().tolerance().slope) ++wrong;
      }
  }
  // the ends of a fresh flat are kinks, which a smooth backend rounds off
  EXPECT_LE(wrong, kinks * compared) << "of " << compared;
}

TEST_P(Conformance, SlopesMatchDifferencesOfHeights) {
  // central differences over 2e-6 m; curvature jumps between arcs spoil a few of them
  constexpr double kStep = 1e-6, kTolerance = 2e-4;
  const Grid2 g = coarse_grid();
  int compared = 0, wrong = 0;
  for (const Pose& X : shape().planes) {
    const Fields f = evaluate(*surface_, X, g);
    Fields moved[4];
    const double offset[4][2] = {{kStep, 0}, {-kStep, 0}, {0, kStep}, {0, -kStep}};
    for (int k = 0; k < 4; ++k) {
      Grid2 h = g;
      h.x0 += offset[k][0];
      h.y0 += offset[k][1];
      moved[k] = evaluate(*surface_, X, h);
    }
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double dzdx = (moved[0].z[i] - moved[1].z[i]) / (2 * kStep),
                   dzdy = (moved[2].z[i] - moved[3].z[i]) / (2 * kStep);
      if (std::isnan(f.z[i]) || std::isnan(dzdx) || std::isnan(dzdy)) continue;
      if (std::fabs(f.dzdx[i]) > 3.0 || std::fabs(f.dzdy[i]) > 3.0) continue;  // differences lose digits there
      ++compared;
      if (std::fabs(dzdx - f.dzdx[i]) > kTolerance || std::fabs(dzdy - f.dzdy[i]) > kTolerance) ++wrong;
    }
  }
  EXPECT_GT(compared, 1000);
  EXPECT_LE(wrong,
            compared / (subject().contestant.creases() ? 40 : 200));  // 2 um differences across edges 0.5 mm apart
}

TEST_P(Conformance, TilesGiveTheWholeGrid) {
  constexpr double kTolerance = 1e-12;  // points are reached from other neighbours
  const Grid2 g = fine_grid();
  for (const Pose& X : shape().planes) {
    const Fields whole = evaluate(*surface_, X, g);
    const int half_x = g.nx / 2, half_y = g.ny / 3;
    for (int part = 0; part < 4; ++part) {
      const int bx = part % 2 ? half_x : 0, by = part / 2 ? half_y : 0;
      const Grid2 tile{
          g.x(bx), g.y(by), g.dx, g.dy, part % 2 ? g.nx - half_x : half_x, part / 2 ? g.ny - half_y : half_y};
      const Fields f = evaluate(*surface_, X, tile);
      for (int iy = 0; iy < tile.ny; ++iy)
        for (int ix = 0; ix < tile.nx; ++ix) {
          const double expected = whole.z[g.index(bx + ix, by + iy)], found = f.z[tile.index(ix, iy)];
          // a steep surface turns the rounding of x and y into more
          const double steep = 1.0 + std::hypot(f.dzdx[tile.index(ix, iy)], f.dzdy[tile.index(ix, iy)]);
          ASSERT_TRUE(same(expected, found, kTolerance * steep)) << expected << " whole, " << found << " tile";
        }
    }
  }
}

TEST_P(Conformance, ThreadsChangeNothing) {
  const Grid2 g = fine_grid();
  for (const Pose& X : shape().planes) {
    Fields one, many;
    {
      ThreadLimit limit(1);
      one = evaluate(*surface_, X, g);
    }
    {
      ThreadLimit limit(4);
      many = evaluate(*surface_, X, g);
    }
    for (std::size_t i = 0; i < g.size(); ++i) {
      ASSERT_TRUE(same(one.z[i], many.z[i], 0.0));
      ASSERT_TRUE(same(one.dzdx[i], many.dzdx[i], 0.0));
      ASSERT_TRUE(same(one.dzdy[i], many.dzdy[i], 0.0));
    }
  }
}

TEST_P(Conformance, BesideTheProfileThereIsNothing) {
  Pose X = shape().planes.front();
  const Grid2 g{0.0, 0.0, 1e-3, 1e-3, 5, 5};
  for (const double y : {shape().y_max + 0.001, shape().y_min - 0.006}) {
    X.origin.y() = y;
    const Fields f = evaluate(*surface_, X, g);
    for (std::size_t i = 0; i < g.size(); ++i)
      EXPECT_TRUE(std::isnan(f.z[i]) && std::isnan(f.dzdx[i]) && std::isnan(f.dzdy[i]));
    EXPECT_TRUE(std::isnan(height_at(*surface_, X, {0.001, 0.001})));
    const std::vector<Vec2> points{{0.0, 0.0}, {0.001, 0.002}};
    std::vector<SurfacePoint> located(points.size());
    surface_->locate(X, points, located);
    for (const auto& p : located) EXPECT_EQ(p.status, LocateStatus::outside);
    EXPECT_TRUE(surface_->height_bounds(X, {0.0, 0.004, 0.0, 0.004}).empty);
  }
}

TEST_P(Conformance, PartsOfOneProfileAreTheSame) {
  constexpr int kParts = 24, kSections = 7;
  const double step = (shape().u_max - shape().u_min) / kParts;
  const bool rail = surface_->facing() == Facing::up;
  const Grid2 section{
      0.0, shape().y_min + 0.5e-3, 1.0, 1.3e-3, 1, static_cast<int>((shape().y_max - shape().y_min) / 1.3e-3) - 1};
  std::vector<double> profile;
  int parts = 0;
  for (int part = 0; part < kParts; ++part) {
    const double first = shape().u_min + part * step;
    if (!surface_->constant_between(first, first + step)) continue;
    ++parts;
    for (int i = 0; i < kSections; ++i) {
      const double u = first + (i + 0.5) * step / kSections;
      const Pose X = rail ? Pose{Vec3(u, 0.0, 0.0), Mat3::Identity()} : Pose{Vec3::Zero(), rotation_y(u)};
      const Fields f = evaluate(*surface_, X, section);
      if (profile.empty()) profile = f.z;
      for (std::size_t k = 0; k < profile.size(); ++k) ASSERT_TRUE(same(f.z[k], profile[k], 1e-12)) << u << ' ' << k;
    }
  }
  if (!shape().spec.defects.empty()) {
    EXPECT_FALSE(surface_->constant_between(shape().u_min, shape().u_max));
  }
  if (surface_->constant_profile()) {
    EXPECT_EQ(parts, kParts);
  }
}

TEST_P(Conformance, MovingEverythingChangesNothing) {
  constexpr double kTolerance = 1e-11;  // a metre of offset costs rounding of 1e-16 m, times the slope
  const Grid2 g = coarse_grid();
  const Pose X_WS{{3.1, -0.7, 0.4}, rotation({0.3, -0.8, 1.9})};
  for (const Pose& X_SP : shape().planes) {
    const Fields before = evaluate(*surface_, X_SP, g);
    const Pose X_WP = X_WS * X_SP;
    const Fields after = evaluate(*surface_, X_WS.inverse() * X_WP, g);
    // the plane moved along its normal, and turned half round in itself
    const Pose X_PQ{{0.0, 0.0, 0.0021}, rotation_z(std::acos(-1.0))};
    const Grid2 turned{-g.x(g.nx - 1), -g.y(g.ny - 1), g.dx, g.dy, g.nx, g.ny};
    const Fields other = evaluate(*surface_, X_SP * X_PQ, turned);
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double steep = 1.0 + std::pow(std::hypot(before.dzdx[i], before.dzdy[i]), 2);
      ASSERT_TRUE(same(before.z[i], after.z[i], kTolerance * steep)) << before.z[i] << ' ' << after.z[i];
      ASSERT_TRUE(same(before.z[i], other.z[g.size() - 1 - i] + 0.0021, kTolerance * steep));
    }
  }
}

TEST_P(Conformance, HeightBoundsHoldEveryHeight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kPoints = 12;
  const bool wheel = shape().spec.body == Body::wheel;
  int hit = 0, small = 0, loose = 0;
  for (int trial = 0; trial < 400; ++trial) {
    Pose X = shape().planes[static_cast<std::size_t>(trial) % shape().planes.size()];
    X.rotation =
        X.rotation * rotation({0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5)});
    const double width = std::pow(10.0, -4.0 + 2.5 * unit(random)), height = std::pow(10.0, -4.0 + 2.5 * unit(random));
    const double x = 0.1 * (unit(random) - 0.5), y = 0.15 * (unit(random) - 0.5);
    const Rectangle r{x, x + width, y, y + height};
    const HeightBounds bounds = surface_->height_bounds(X, r);
    const Grid2 g{x, y, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints};
    const Fields f = evaluate(*surface_, X, g);
    constexpr double kRounding = 1e-10;
    double z_min = std::numeric_limits<double>::infinity(), z_max = -z_min;
    bool everywhere = true;
    for (double z : f.z) {
      if (std::isnan(z)) {
        everywhere = false;
        continue;
      }
      ASSERT_FALSE(bounds.empty) << "trial " << trial;
      ASSERT_GE(z, bounds.z_min - kRounding) << "trial " << trial;
      ASSERT_LE(z, bounds.z_max + kRounding) << "trial " << trial;
      z_min = std::min(z_min, z);
      z_max = std::max(z_max, z);
    }
    if (!everywhere) continue;
    ++hit;
    // and they are of use: towards the other body, those of a small rectangle are of its size
    if (width + height < 2e-3 && z_max - z_min < 2.0 * (width + height)) {
      ++small;
      const double excess = wheel ? bounds.z_max - z_max : z_min - bounds.z_min;
      if (excess > 3.0 * (width + height) + 1e-4) ++loose;
    }
  }
  EXPECT_GT(small, 20);
  EXPECT_LE(loose, small / 10);
  EXPECT_GT(hit, 50);
}

TEST_P(Conformance, BoundsOfManyRectanglesHoldEveryHeight) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kPoints = 8;
  const bool wheel = shape().spec.body == Body::wheel;
  int hit = 0, small = 0, loose = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Pose X = shape().planes[static_cast<std::size_t>(trial) % shape().planes.size()];
    if (trial % 3 != 0)
      X.rotation =
          X.rotation * rotation({0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5), 0.2 * (unit(random) - 0.5)});
    const double width = std::pow(10.0, -3.5 + 1.5 * unit(random)), height = std::pow(10.0, -3.5 + 1.5 * unit(random));
    const double x = 0.1 * (unit(random) - 0.5), y = 0.15 * (unit(random) - 0.5);
    // some overlap, some leave gaps
    const RectangleGrid r{
        {x, x + width, y, y + height}, width * (0.6 + unit(random)), height * (0.6 + unit(random)), 4, 3};
    std::vector<HeightBounds> bounds(r.size());
    surface_->height_bounds(X, r, bounds);
    for (int iy = 0; iy < r.ny; ++iy)
      for (int ix = 0; ix < r.nx; ++ix) {
        const Rectangle one = r.at(ix, iy);
        const HeightBounds& b = bounds[r.index(ix, iy)];
        const Fields f = evaluate(
            *surface_, X, {one.x_min, one.y_min, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints});
        constexpr double kRounding = 1e-10;
        double z_min = std::numeric_limits<double>::infinity(), z_max = -z_min;
        bool everywhere = true;
        for (double z : f.z) {
          if (std::isnan(z)) {
            everywhere = false;
            continue;
          }
          ASSERT_FALSE(b.empty) << "trial " << trial;
          ASSERT_GE(z, b.z_min - kRounding) << "trial " << trial;
          ASSERT_LE(z, b.z_max + kRounding) << "trial " << trial;
          z_min = std::min(z_min, z);
          z_max = std::max(z_max, z);
          ++hit;
        }
        if (everywhere && width + height < 4e-3 && z_max - z_min < 2.0 * (width + height)) {
          ++small;
          const double excess = wheel ? b.z_max - z_max : z_min - b.z_min;
          if (excess > 3.0 * (width + height) + 1e-4) ++loose;
        }
      }
  }
  EXPECT_GT(hit, 2000);
  EXPECT_GT(small, 20);
  EXPECT_LE(loose, small / 10);
}

TEST_P(Conformance, LocatedPointsLieOnTheSurface) {
  const Grid2 g = coarse_grid();
  std::vector<Vec2> points;
  for (int iy = 0; iy < g.ny; iy += 2)
    for (int ix = 0; ix < g.nx; ix += 2) points.push_back({g.x(ix), g.y(iy)});
  for (const Pose& X : shape().planes) {
    const Fields f = evaluate(*surface_, X, g);
    std::vector<SurfacePoint> located(points.size());
    surface_->locate(X, points, located);
    std::size_t k = 0;
    for (int iy = 0; iy < g.ny; iy += 2)
      for (int ix = 0; ix < g.nx; ix += 2, ++k) {
        const std::size_t i = g.index(ix, iy);
        const SurfacePoint& p = located[k];
        ASSERT_EQ(p.status == LocateStatus::outside, std::isnan(f.z[i])) << points[k].transpose();
        if (std::isnan(f.z[i])) continue;
        const double steep = 1.0 + std::pow(std::hypot(f.dzdx[i], f.dzdy[i]), 2);
        const Vec3 expected = X.apply({points[k].x(), points[k].y(), f.z[i]});
        ASSERT_LE((p.position_S - expected).norm(), 1e-11 * steep);
        ASSERT_NEAR(p.normal_S.norm(), 1.0, 1e-12);
        // perpendicular to both tangents
        const Vec3 along_x = X.rotation * Vec3(1.0, 0.0, f.dzdx[i]), along_y = X.rotation * Vec3(0.0, 1.0, f.dzdy[i]);
        ASSERT_LE(std::fabs(p.normal_S.dot(along_x.normalized())), 1e-6) << points[k].transpose();
        ASSERT_LE(std::fabs(p.normal_S.dot(along_y.normalized())), 1e-6) << points[k].transpose();
        if (p.position_S.y() > shape().y_min + 1e-4 && p.position_S.y() < shape().y_max - 1e-4) {
          ASSERT_GT(p.normal_S.dot(gradient(shape(), p.position_S)), 0.0) << "not out of the material";
        }
        ASSERT_GE(p.curvature_1, p.curvature_2);
      }
  }
}

TEST_P(Conformance, ParametersOfLocatedPointsLeadBackToThem) {
  const bool exact = has_exact_derivatives(*surface_);
  const Grid2 g = coarse_grid();
  std::vector<Vec2> points;
  for (int iy = 1; iy < g.ny; iy += 4)
    for (int ix = 1; ix < g.nx; ix += 6) points.push_back({g.x(ix), g.y(iy)});
  int compared = 0, bent = 0, turned = 0;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    std::vector<SurfacePoint> located(points.size());
    surface_->locate(shape().planes[plane], points, located);
    std::vector<Vec2> uv;
    std::vector<SurfacePoint> of;
    for (const SurfacePoint& p : located) {
      if (p.status != LocateStatus::converged) continue;
      if (p.position_S.y() < shape().y_min + 4e-4 || p.position_S.y() > shape().y_max - 4e-4) continue;
      uv.emplace_back(p.u, p.v);
      of.push_back(p);
    }
    std::vector<SurfaceJet> jets(uv.size());
    treadmark::evaluate(*surface_, uv, jets);
    for (std::size_t i = 0; i < uv.size(); ++i) {
      ASSERT_TRUE(jets[i].found()) << uv[i].transpose();
      // smooth meshes depend a little on where they are seen from
      ASSERT_LE(std::fabs((jets[i].p - of[i].position_S).dot(of[i].normal_S)), exact ? 1e-11 : 5e-8)
          << uv[i].transpose();
      const SurfaceShape s = shape_of(jets[i]);
      if (!s.normal.allFinite()) continue;  // differences reach beyond the end
      ++compared;
      ASSERT_NEAR(s.direction_1.dot(s.direction_2), 0.0, 1e-9);
      ASSERT_NEAR(s.direction_1.norm(), 1.0, 1e-9);
      // differences over 0.1 mm: across edges they see another normal, across joints another curvature
      if ((s.normal - of[i].normal_S).norm() > (exact ? 1e-6 : 1e-4)) ++turned;
      const double scale = 1.0 + std::fabs(of[i].curvature_1) + std::fabs(of[i].curvature_2);
      const double off = std::fabs(s.curvature_1 - of[i].curvature_1) + std::fabs(s.curvature_2 - of[i].curvature_2);
      if (off > (exact ? 2e-3 : 2e-2) * scale) ++bent;
    }
  }
  EXPECT_GT(compared, 30);
  if (!exact && subject().contestant.creases()) return;
  EXPECT_LE(turned, exact ? 0 : compared / 4);
  EXPECT_LE(bent, compared / 6);
}

TEST_P(Conformance, CurvaturesMatchSecondDifferencesInTheTangentPlane) {
  if (shape().varies && subject().contestant.backend == "offset-bilinear")
    GTEST_SKIP() << "bilinear offsets have no curvature of their own";
  constexpr double kStep = 5e-5;  // [m] the noise of 1e-16 m heights in the second difference is 4e-8 1/m
  const double side = shape().spec.body == Body::wheel ? 1.0 : -1.0;
  const Grid2 g = coarse_grid();
  int compared = 0, wrong = 0;
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const Pose& X = shape().planes[plane];
    std::vector<Vec2> points;
    for (int iy = 1; iy < g.ny; iy += 5)
      for (int ix = 1; ix < g.nx; ix += 5) points.push_back({g.x(ix), g.y(iy)});
    std::vector<SurfacePoint> located(points.size());
    surface_->locate(X, points, located);
    for (const SurfacePoint& p : located) {
      if (p.status == LocateStatus::outside) continue;
      if (subject().contestant.facets()) {  // differences reach across edges wherever they are taken
        ASSERT_EQ(p.curvature_1, 0.0);
        ASSERT_EQ(p.curvature_2, 0.0);
        ++compared;
        continue;
      }
      Pose T;
      T.origin = p.position_S;
      const Vec3 n = side * p.normal_S, e = Vec3::UnitX().cross(n).norm() > 0.1 ? Vec3::UnitX() : Vec3::UnitY();
      T.rotation.col(2) = n;
      T.rotation.col(1) = n.cross(e).normalized();
      T.rotation.col(0) = T.rotation.col(1).cross(n);
      const Fields h = evaluate(*surface_, T, {-kStep, -kStep, kStep, kStep, 3, 3});
      const double hxx = (h.z[3] - 2 * h.z[4] + h.z[5]) / (kStep * kStep),
                   hyy = (h.z[1] - 2 * h.z[4] + h.z[7]) / (kStep * kStep);
      const double hxy = (h.z[8] - h.z[6] - h.z[2] + h.z[0]) / (4 * kStep * kStep);
      if (std::isnan(hxx + hyy + hxy)) continue;
      const double mean = -side * 0.5 * (hxx + hyy), spread = std::hypot(0.5 * (hxx - hyy), hxy);
      ++compared;
      const double scale = 1.0 + std::fabs(p.curvature_1) + std::fabs(p.curvature_2);
      if (std::fabs(mean + spread - p.curvature_1) > subject().tolerance().curvature * scale ||
          std::fabs(mean - spread - p.curvature_2) > subject().tolerance().curvature * scale)
        ++wrong;
    }
  }
  EXPECT_GT(compared, 50);
  // differences reach across joints, where curvature jumps, and of chords across one edge in five
  EXPECT_LE(wrong, subject().contestant.chords() ? compared / 3 : compared / 6);
}

}  // namespace
}  // namespace treadmark::testing
