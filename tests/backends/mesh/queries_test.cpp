// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/tests/backends/mesh/mesh_shapes.hpp"

namespace treadmark::mesh {
namespace {

using namespace testing;

TEST(MeshBounds, HoldEveryHeight) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kPoints = 12;
  constexpr double kRounding = 1e-10;
  const auto flange = [](double y) { return 0.46 - y / 20.0 + 0.028 / (1.0 + std::exp((y + 0.045) / 0.004)); };
  const TriangleMesh meshes[] = {
      wheel_net(-0.06, 0.05, 40, kPi, 500, flange), rail_net(-0.05, 0.05, 30, 41, arc_section(0.03, 1.7)),
      scattered_sheet(
          0.05, 31, [](double x, double y) { return 2e-3 * std::sin(200 * x + 90 * y); }, 0.6, 3)};
  for (const TriangleMesh& mesh : meshes)
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const bool wheel = &mesh == meshes;
      const auto surface = make_mesh_surface(mesh, wheel ? Body::wheel : Body::rail, {.refinement = refinement});
      int small = 0, loose = 0, hit = 0;
      for (int trial = 0; trial < 400; ++trial) {
        Pose X = pose({0.0, 0.0, wheel ? 0.46 : 0.0}, 1.2 * (unit(random) - 0.5), 0.4 * (unit(random) - 0.5),
                      0.2 * (unit(random) - 0.5));
        const double width = std::pow(10.0, -4.0 + 2.5 * unit(random)),
                     height = std::pow(10.0, -4.0 + 2.5 * unit(random));
        const double x = 0.08 * (unit(random) - 0.5), y = 0.11 * (unit(random) - 0.5);
        const HeightBounds bounds = surface->height_bounds(X, {x, x + width, y, y + height});
        const Fields f = evaluate(*surface, X, {x, y, width / (kPoints - 1), height / (kPoints - 1), kPoints, kPoints});
        double z_min = std::numeric_limits<double>::infinity(), z_max = -z_min;
        bool everywhere = true;
        for (const double z : f.z) {
          everywhere = everywhere && !std::isnan(z);
          if (std::isnan(z)) continue;
          ASSERT_FALSE(bounds.empty);
          ASSERT_GE(z, bounds.z_min - kRounding);
          ASSERT_LE(z, bounds.z_max + kRounding);
          z_min = std::min(z_min, z), z_max = std::max(z_max, z);
        }
        if (!everywhere) continue;
        ++hit;
        if (width + height > 2e-3 || z_max - z_min > 2.0 * (width + height)) continue;
        ++small;
        const double excess = wheel ? bounds.z_max - z_max : z_min - bounds.z_min;
        constexpr double kBulge = 1e-4;  // [m] of smooth triangles of 3 mm over a radius of 30 mm, and its margin
        if (excess > (width + height) + kBulge) ++loose;
      }
      EXPECT_GT(hit, 50);
      EXPECT_GT(small, 20);
      EXPECT_LE(loose, small / 20);
    }
}

TEST(MeshBounds, BoxHoldsTheSurface) {
  const auto surface = make_mesh_surface(wheel_net(-0.05, 0.05, 41, kPi, 300, barrel(0.46, 0.5)), Body::wheel);
  const Box3 box = surface->bounds();
  constexpr double kMargin = 5e-4;  // [m] ten times the bulge of triangles of 10 mm
  EXPECT_NEAR(box.max.x(), 0.46, kMargin);
  EXPECT_NEAR(box.min.y(), -0.05, kMargin);
  const double top = height_at(*surface, pose({0.0, 0.0, 0.0}), {0.0, 0.0});
  EXPECT_LE(top, box.max.z());
  EXPECT_NEAR(top, 0.46, 1e-6);
}

TEST(MeshLocate, MatchesTheFormulaOfABarrel) {
  const double R = 0.46, m = 0.08;
  const auto surface = make_mesh_surface(wheel_net(-0.05, 0.05, 101, 0.2, 185, barrel(R, m)), Body::wheel);
  const auto exact = analytic::make_revolved_surface(analytic::barrel_chain(m, 0.8), R);
  for (const Pose& X : {pose({0.0, 0.003, R}), pose({0.03, -0.01, 0.455}, 0.3, 0.2, 0.05)}) {
    std::vector<Vec2> points;
    for (int i = -8; i <= 8; ++i)
      for (int j = -8; j <= 8; ++j) points.push_back({0.00173 * i, 0.00171 * j});
    std::vector<SurfacePoint> a(points.size()), b(points.size());
    std::vector<double> z(points.size());
    surface->locate(X, points, a);
    exact->locate(X, points, b);
    surface->heights_at(X, points, {z, {}, {}});
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_EQ(a[i].status, LocateStatus::converged);
      ASSERT_LE((a[i].position_S - X.apply({points[i].x(), points[i].y(), z[i]})).norm(), 1e-14);
      ASSERT_LE((a[i].position_S - b[i].position_S).norm(), 5e-9);
      ASSERT_LE((a[i].normal_S - b[i].normal_S).norm(), 2e-5);
      ASSERT_NEAR(a[i].normal_S.norm(), 1.0, 1e-14);
      ASSERT_NEAR(a[i].u, b[i].u, 1e-7);
      ASSERT_NEAR(a[i].v, b[i].v, 5e-9);
      ASSERT_NEAR(a[i].curvature_1, b[i].curvature_1, 0.1);
      ASSERT_NEAR(a[i].curvature_2, b[i].curvature_2, 0.1);
    }
  }
}

TEST(MeshLocate, CurvaturesMatchSecondDifferences) {
  const auto surface = make_mesh_surface(rail_net(0.0, 0.1, 51, 51,
                                                  [](double s) {
                                                    const double y = 0.06 * s - 0.03;
                                                    return Vec2(y, 4.0 * y * y + 60.0 * y * y * y);
                                                  }),
                                         Body::rail);
  constexpr double kStep = 2e-6;  // heights of 1e-17 m noise make 1e-5 of it
  const Pose X = pose({0.05, 0.0, 0.0});
  int compared = 0, wrong = 0;
  for (double y = -0.025; y < 0.025; y += 0.00073) {
    const Vec2 at(0.00031, y);
    SurfacePoint p;
    surface->locate(X, {&at, 1}, {&p, 1});
    Pose T;
    T.origin = p.position_S;
    T.rotation.col(2) = -p.normal_S;
    T.rotation.col(0) = Vec3::UnitX();
    T.rotation.col(0) = (T.rotation.col(0) - T.rotation.col(0).dot(p.normal_S) * p.normal_S).normalized();
    T.rotation.col(1) = T.rotation.col(2).cross(T.rotation.col(0));
    const Fields h = evaluate(*surface, T, {-kStep, -kStep, kStep, kStep, 3, 3});
    const double hxx = (h.z[3] - 2 * h.z[4] + h.z[5]) / (kStep * kStep),
                 hyy = (h.z[1] - 2 * h.z[4] + h.z[7]) / (kStep * kStep);
    const double hxy = (h.z[8] - h.z[6] - h.z[2] + h.z[0]) / (4 * kStep * kStep);
    const double mean = 0.5 * (hxx + hyy), spread = std::hypot(0.5 * (hxx - hyy), hxy);
    ++compared;
    if (std::fabs(mean + spread - p.curvature_1) > 3e-3 * (1.0 + std::fabs(p.curvature_1))) ++wrong;
  }
  EXPECT_GT(compared, 50);
  EXPECT_LE(wrong, compared / 20);  // where a difference reaches over an edge
}

TEST(MeshLocate, TellsOutsideAndAmbiguous) {
  const auto head = make_mesh_surface(rail_net(0.0, 0.06, 31, 91, arc_section(0.025, 2.4)), Body::rail);
  const std::vector<Vec2> points{{0.0, 0.001}, {0.0, 0.0255}, {0.0, -0.031}};
  std::vector<SurfacePoint> out(points.size());
  head->locate(pose({0.03, 0.0, 0.0}), points, out);
  EXPECT_EQ(out[0].status, LocateStatus::converged);
  EXPECT_EQ(out[1].status, LocateStatus::outside);
  EXPECT_EQ(out[2].status, LocateStatus::outside);
  EXPECT_NEAR(out[0].curvature_1, 40.0, 0.5);
  EXPECT_NEAR(out[0].u, 0.03, 1e-15);
  // a second sheet below a part of the first
  TriangleMesh two = rail_net(0.0, 0.06, 7, 7, arc_section(0.3, 0.05));
  TriangleMesh below = rail_net(0.0, 0.03, 7, 7, arc_section(0.3, 0.05));
  shift(below, {0.0, 0.0, 0.01});
  const auto n = static_cast<std::uint32_t>(two.vertices.size());
  for (auto c : below.triangles) two.triangles.push_back({c[0] + n, c[1] + n, c[2] + n});
  two.vertices.insert(two.vertices.end(), below.vertices.begin(), below.vertices.end());
  const auto sheets = make_mesh_surface(two, Body::rail);
  const std::vector<Vec2> pair{{0.011, 0.001}, {0.041, 0.001}};
  out.resize(2);
  sheets->locate(pose({0.0, 0.0, 0.0}), pair, out);
  EXPECT_EQ(out[0].status, LocateStatus::ambiguous);
  EXPECT_LT(out[0].position_S.z(), 0.001);
  EXPECT_EQ(out[1].status, LocateStatus::converged);
}

TEST(MeshSurface, SaysWhatItIsAndHolds) {
  const TriangleMesh mesh = wheel_net(-0.05, 0.05, 101, kPi, 900, barrel(0.46, 0.5));
  const auto facets = make_mesh_surface(mesh, Body::wheel, {.refinement = Refinement::facets});
  const auto smooth = make_mesh_surface(mesh, Body::wheel, {.refinement = Refinement::smooth, .backend = "scan"});
  const auto oracle = make_mesh_oracle(mesh, Body::wheel, {.refinement = Refinement::facets});
  EXPECT_EQ(facets->backend(), "mesh");
  EXPECT_EQ(smooth->backend(), "scan");
  EXPECT_EQ(facets->facing(), Facing::down);
  const double triangles = static_cast<double>(mesh.triangles.size());
  EXPECT_GT(static_cast<double>(oracle->memory_bytes()) / triangles, 36.0);
  EXPECT_GE(facets->memory_bytes(), oracle->memory_bytes() + (has_part("embree") ? 25 : 0) * mesh.triangles.size());
  EXPECT_GT(smooth->memory_bytes(), facets->memory_bytes() + 40 * mesh.triangles.size());
  EXPECT_LT(static_cast<double>(smooth->memory_bytes()) / triangles, 250.0);
}

}  // namespace
}  // namespace treadmark::mesh
