// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/backends/mesh/mesh_shapes.hpp"

namespace treadmark::mesh {
namespace {

using namespace testing;

constexpr double kRounding = 1e-12;  // [m]
const MeshOptions kHeightFacets{.refinement = Refinement::facets};

/// Head with upright, undercut sides: folds in every view.
TriangleMesh head(double step) {
  const int n = static_cast<int>(0.09 / step) | 1;
  return rail_net(0.0, 0.06, static_cast<int>(0.06 / step) + 1, n, arc_section(0.025, 1.8));
}
/// A wheel with a flange-like bump whose root is hidden in rolled views.
double flanged(double y) { return 0.46 - y / 20.0 + 0.028 / (1.0 + std::exp((y + 0.045) / 0.004)); }
TriangleMesh wheel(double step, double half) {
  return wheel_net(-0.068, 0.05, static_cast<int>(0.118 / step) + 1, half, static_cast<int>(2 * half * 0.46 / step),
                   flanged);
}

struct Scene {
  TriangleMesh mesh;
  Body body;
  std::vector<Pose> planes;
};

std::vector<Scene> scenes() {
  const auto on_wheel = [](double theta, double y, double roll, double yaw, double pitch) {
    return pose({0.46 * std::sin(theta), y, 0.46 * std::cos(theta)}, roll, yaw, pitch);
  };
  return {{head(2e-3),
           Body::rail,
           {pose({0.03, 0.0, 0.0}), pose({0.03, 0.01, 0.001}, 0.4, 0.2, 0.1),
            pose({0.02, -0.01, 0.002}, -1.3, 1.1, 0.0), pose({0.03, 0.0, 0.01}, 1.57, 0.3, 0.0)}},
          {wheel(4e-3, kPi),
           Body::wheel,
           {on_wheel(0.0, 0.001, 0.0, 0.0, 0.0), on_wheel(0.3, -0.02, -0.3, 0.2, 0.3),
            on_wheel(0.0, -0.045, 0.9, 1.4, 0.0), on_wheel(0.0, -0.03, -1.0, 0.1, 0.2)}},
          {wheel(4e-3, 0.3),
           Body::wheel,
           {on_wheel(0.0, 0.001, 0.0, 0.0, 0.0), on_wheel(0.28, 0.0, 0.2, 0.0, 0.3),
            pose({0.0, 0.0, 0.0}, kPi, 0.0, 0.0)}}};
}

Grid2 grid_over(double x, double y, int n) { return {-x, -y, 2.0 * x / n, 2.0001 * y / n, n + 1, n + 1}; }

TEST(MeshHeights, FacetsMatchBruteForce) {
  for (const Scene& scene : scenes())
    for (const Pose& X : scene.planes) {
      const auto surface = make_mesh_surface(scene.mesh, scene.body, kHeightFacets),
                 oracle = make_mesh_oracle(scene.mesh, scene.body, kHeightFacets);
      // the brute force takes triangles as they stand; those of nets face away from the axle
      TriangleMesh mesh = scene.mesh;
      if (scene.body == Body::rail)
        for (auto& c : mesh.triangles) std::swap(c[0], c[1]);
      MeshRepair repair;
      make_mesh_oracle(mesh, scene.body, kHeightFacets, &repair);
      if (repair.turned_inside_out)
        for (auto& c : mesh.triangles) std::swap(c[0], c[1]);
      const Grid2 g = grid_over(0.0313, 0.0717, 15);
      const Fields f = evaluate(*surface, X, g), o = evaluate(*oracle, X, g);
      int hit = 0;
      for (std::size_t i = 0; i < g.size(); ++i) {
        const int ix = static_cast<int>(i) % g.nx, iy = static_cast<int>(i) / g.nx;
        const double expected = brute_height(mesh, X, g.x(ix), g.y(iy), surface->facing());
        ASSERT_EQ(std::isnan(expected), std::isnan(o.z[i])) << ix << ' ' << iy;
        ASSERT_EQ(std::isnan(expected), std::isnan(f.z[i])) << ix << ' ' << iy;
        if (std::isnan(expected)) continue;
        ++hit;
        const double steep = 1.0 + std::hypot(o.dzdx[i], o.dzdy[i]);
        ASSERT_NEAR(o.z[i], expected, kRounding * steep);
        ASSERT_NEAR(f.z[i], expected, kRounding * steep);
      }
      if (&X != &scene.planes.back()) {
        EXPECT_GT(hit, 30);
      }
    }
}

/// Embree and the hierarchy in double precision agree, near the origin and at world coordinates.
TEST(MeshHeights, SinglePrecisionFindsWhatDoubleDoes) {
  constexpr double kAgree = 1e-9;
  for (const double offset : {0.0, 1.0, 100.0}) {
    TriangleMesh rail = head(1e-3);
    shift(rail, {offset, 0.0, 0.0});
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const MeshOptions options{.refinement = refinement};
      const auto surface = make_mesh_surface(rail, Body::rail, options),
                 oracle = make_mesh_oracle(rail, Body::rail, options);
      for (Pose X : {pose({0.03, 0.0, 0.0}), pose({0.03, 0.001, 0.001}, 0.3, 0.4, 0.1)}) {
        X.origin.x() += offset;
        const Grid2 g = grid_over(0.035, 0.03, 200);
        const Fields a = evaluate(*surface, X, g), b = evaluate(*oracle, X, g);
        int folds = 0;
        for (std::size_t i = 0; i < g.size(); ++i) {
          ASSERT_EQ(std::isnan(a.z[i]), std::isnan(b.z[i]));
          if (std::isnan(a.z[i])) continue;
          // the sides seen edge-on end at folds, which single precision may place 1e-8 m away
          if (std::fabs(a.z[i] - b.z[i]) > kAgree) ++folds;
        }
        EXPECT_EQ(folds, 0) << offset;
      }
    }
  }
}

/// Single precision is off by 4e-6 m at 40 m from the centre: the walk over neighbours makes up for it.
TEST(MeshHeights, LongRailsNeedNoMorePrecision) {
  constexpr double kAgree = 1e-9;
  const TriangleMesh rail = rail_net(20.0, 100.0, 401, 91, arc_section(0.025, 1.2));
  const auto surface = make_mesh_surface(rail, Body::rail), oracle = make_mesh_oracle(rail, Body::rail);
  for (const double x : {20.05, 57.3, 99.95})
    for (const Pose& X : {pose({x, 0.0, 0.0}), pose({x, 0.001, 0.001}, 0.3, 0.4, 0.1)}) {
      const Grid2 g = grid_over(0.06, 0.03, 60);
      const Fields a = evaluate(*surface, X, g), b = evaluate(*oracle, X, g);
      for (std::size_t i = 0; i < g.size(); ++i) {
        ASSERT_EQ(std::isnan(a.z[i]), std::isnan(b.z[i])) << x;
        if (!std::isnan(a.z[i])) {
          ASSERT_NEAR(a.z[i], b.z[i], kAgree) << x;
        }
      }
    }
}

/// Lines exactly through vertices, along edges and through rims.
void expect_no_miss(const TriangleMesh& mesh, Body body, const Pose& X, int rays, unsigned seed, double least_slant) {
  const auto surface = make_mesh_surface(mesh, body, kHeightFacets);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::uniform_int_distribution<std::size_t> pick(0, mesh.triangles.size() - 1);
  std::vector<Vec2> points;
  const double side = body == Body::wheel ? 1.0 : -1.0;
  while (static_cast<int>(points.size()) < rays) {
    const auto& c = mesh.triangles[pick(random)];
    const Vec3 a = mesh.vertices[c[0]], b = mesh.vertices[c[1]],
               n = (b - a).cross(mesh.vertices[c[2]] - a).normalized();
    if (std::fabs(n.dot(X.rotation.col(2))) < least_slant) continue;
    if (body == Body::wheel && side * X.rotation.col(2).dot(Vec3(a.x(), 0.0, a.z())) < 0.0) continue;
    const std::size_t kind = points.size() % 3;
    const double s = kind == 0 ? 0.0 : unit(random);
    const Vec3 p = X.apply_inverse(a + s * (b - a));
    points.push_back({p.x(), p.y()});
  }
  std::vector<double> z(points.size());
  surface->heights_at(X, points, {z, {}, {}});
  int missed = 0;
  for (const double h : z) missed += std::isnan(h);
  EXPECT_EQ(missed, 0);
}

constexpr int kRays = 250'000;  // for each scene; 1e7 in all were run without a miss

TEST(MeshHeights, NoLineThroughAVertexOrAnEdgeIsMissed) {
  const TriangleMesh rail = rail_net(0.0, 0.1, 101, 41, arc_section(0.1, 0.5));
  expect_no_miss(rail, Body::rail, pose({0.05, 0.0, 0.0}), kRays, 1, 0.3);
  expect_no_miss(rail, Body::rail, pose({0.05, 0.0, 0.0}, 0.21, 0.33, 0.11), kRays, 2, 0.5);
  TriangleMesh far = rail;
  shift(far, {100.0, 0.0, 0.0});
  expect_no_miss(far, Body::rail, pose({100.05, 0.0, 0.0}, 0.21, 0.33, 0.11), kRays, 3, 0.5);
  expect_no_miss(wheel_net(-0.05, 0.05, 41, kPi, 300, barrel(0.46, 0.5)), Body::wheel,
                 pose({0.0, 0.0, 0.46}, 0.05, 0.3, 0.2), kRays, 4, 0.1);
}

TEST(MeshHeights, NeighboursAgreeOnTheirEdge) {
  // heights just on both sides of an edge and on it
  const TriangleMesh rail = rail_net(0.0, 0.1, 21, 11, arc_section(0.1, 0.5));
  for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
    const auto surface = make_mesh_surface(rail, Body::rail, {.refinement = refinement});
    const Pose X = pose({0.05, 0.0, 0.0}, 0.1, 0.2, 0.05);
    for (std::size_t t = 0; t < rail.triangles.size(); ++t) {
      const auto& c = rail.triangles[t];
      for (const double s : {0.0, 0.3, 0.71}) {
        const Vec3 on = X.apply_inverse(rail.vertices[c[0]] + s * (rail.vertices[c[2]] - rail.vertices[c[0]]));
        const double z = height_at(*surface, X, {on.x(), on.y()});
        ASSERT_FALSE(std::isnan(z));
        if (refinement == Refinement::facets || s == 0.0) {
          ASSERT_NEAR(z, on.z(), kRounding);
        }
        for (const double side : {-1e-9, 1e-9}) {
          const double near = height_at(*surface, X, {on.x(), on.y() + side});
          if (std::isnan(near)) continue;
          ASSERT_NEAR(near, z, 2e-9);  // a slope of at most 1
        }
      }
    }
  }
}

/// The ray caster may be built otherwise next time: on edges and at vertices, too, the result must not depend on it.
TEST(MeshHeights, LinesThroughVerticesAndEdgesAreRepeatable) {
  const TriangleMesh ridge =
      net(101, 101, [](int i, int j) { return Vec3(1e-3 * (i - 50), 1e-3 * (j - 50), 1e-4 * ((i + j) % 2)); });
  Fields first;
  for (const int threads : {1, 2, 4}) {
    ThreadLimit limit(threads);
    const auto surface = make_mesh_surface(ridge, Body::rail, kHeightFacets);
    const Fields f = evaluate(*surface, pose({0.0, 0.0, 0.0}), {-0.05, -0.05, 0.5e-3, 0.5e-3, 201, 201});
    for (const double z : f.z) ASSERT_FALSE(std::isnan(z));
    if (threads == 1) first = f;
    EXPECT_EQ(first.z, f.z);
    EXPECT_EQ(first.dzdx, f.dzdx);
  }
}

TEST(MeshHeights, HolesStayHoles) {
  TriangleMesh rail = rail_net(0.0, 0.1, 51, 31, arc_section(0.1, 0.5));
  const TriangleMesh whole = rail;
  const auto middle = [&](const std::array<std::uint32_t, 3>& c) {
    return Vec3((rail.vertices[c[0]] + rail.vertices[c[1]] + rail.vertices[c[2]]) / 3.0);
  };
  std::erase_if(rail.triangles, [&](const auto& c) { return (middle(c) - Vec3(0.05, 0.0, 0.0)).norm() < 0.01; });
  MeshRepair repair;
  const auto surface = make_mesh_surface(rail, Body::rail, kHeightFacets, &repair),
             full = make_mesh_surface(whole, Body::rail, kHeightFacets);
  EXPECT_EQ(repair.boundary_loops, 2u);
  EXPECT_TRUE(std::isnan(height_at(*surface, pose({0.05, 0.0, 0.0}), {0.0, 0.0})));
  EXPECT_TRUE(surface->height_bounds(pose({0.05, 0.0, 0.0}), {-0.003, 0.003, -0.003, 0.003}).empty);
  const Pose X = pose({0.05, 0.02, 0.0});
  EXPECT_EQ(height_at(*surface, X, {0.001, 0.001}), height_at(*full, X, {0.001, 0.001}));
}

TEST(MeshHeights, AnOpenSectorDoesNotShowItsInside) {
  const auto surface = make_mesh_surface(wheel(4e-3, 0.3), Body::wheel);
  // looking from the axle outwards: the tread is met from inside
  const Grid2 g{-0.05, -0.03, 0.01, 0.01, 11, 7};
  const Fields f = evaluate(*surface, pose({0.0, 0.0, 0.0}, kPi), g);
  for (const double z : f.z) EXPECT_TRUE(std::isnan(z));
  EXPECT_TRUE(surface->height_bounds(pose({0.0, 0.0, 0.0}, kPi), {-0.01, 0.01, -0.01, 0.01}).empty);
}

TEST(MeshHeights, SliversGiveNoWrongNumbers) {
  // a net with vertices moved so close to their neighbours that needles of 1e-8 m arise
  const auto section = arc_section(0.1, 0.4);
  TriangleMesh rail = net(41, 31, [&](int i, int j) {
    const double s = (j % 3 == 1 ? j - 1 + 1e-5 : j) / 30.0, x = 0.002 * (i % 4 == 2 ? i - 1 + 1e-5 : i);
    const Vec2 yz = section(s);
    return Vec3(x, yz.x(), yz.y());
  });
  const Grid2 g{0.003, -0.0301, 0.00031, 0.00037, 230, 160};
  for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
    const auto surface = make_mesh_surface(rail, Body::rail, {.refinement = refinement});
    const Fields f = evaluate(*surface, pose({0.0, 0.0, 0.0}), g);
    const double tolerance =
        refinement == Refinement::facets ? 4e-5 : 1e-6;  // chords of up to 8 mm over the arc of 100 mm
    for (std::size_t i = 0; i < g.size(); ++i) {
      const double y = g.y(static_cast<int>(i) / g.nx), z = 0.1 - std::sqrt(0.01 - y * y), slope = y / (0.1 - z);
      ASSERT_NEAR(f.z[i], z, tolerance);
      if (refinement == Refinement::smooth) {
        ASSERT_NEAR(f.dzdy[i], slope, 2e-3);
        ASSERT_NEAR(f.dzdx[i], 0.0, 2e-3);
      }
    }
  }
}

TEST(MeshHeights, TilesThreadsAndScatteredPointsAgree) {
  constexpr double kTiles = 1e-12;
  for (const Scene& scene : scenes())
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const auto surface = make_mesh_surface(scene.mesh, scene.body, {.refinement = refinement});
      for (const Pose& X : scene.planes) {
        const Grid2 g{-0.0197, -0.0293, 0.00031, 0.00047, 130, 125};
        Fields one;
        {
          ThreadLimit limit(1);
          one = evaluate(*surface, X, g);
        }
        const Fields many = evaluate(*surface, X, g);
        const Grid2 tile{g.x(61), g.y(33), g.dx, g.dy, 40, 51};
        const Fields part = evaluate(*surface, X, tile);
        std::vector<Vec2> points;
        for (std::size_t i = 0; i < g.size(); ++i)
          points.push_back({g.x(static_cast<int>(i) % g.nx), g.y(static_cast<int>(i) / g.nx)});
        std::vector<double> scattered(points.size());
        surface->heights_at(X, points, {scattered, {}, {}});
        for (std::size_t i = 0; i < g.size(); ++i) {
          ASSERT_TRUE(one.z[i] == many.z[i] || (std::isnan(one.z[i]) && std::isnan(many.z[i])));
          ASSERT_TRUE(one.dzdx[i] == many.dzdx[i] || (std::isnan(one.dzdx[i]) && std::isnan(many.dzdx[i])));
          ASSERT_TRUE(one.z[i] == scattered[i] || (std::isnan(one.z[i]) && std::isnan(scattered[i])));
        }
        for (int iy = 0; iy < tile.ny; ++iy)
          for (int ix = 0; ix < tile.nx; ++ix) {
            const double a = part.z[tile.index(ix, iy)], b = one.z[g.index(61 + ix, 33 + iy)];
            const double steep = 1.0 + std::hypot(part.dzdx[tile.index(ix, iy)], part.dzdy[tile.index(ix, iy)]);
            ASSERT_TRUE((std::isnan(a) && std::isnan(b)) || std::fabs(a - b) <= kTiles * steep) << a << ' ' << b;
          }
      }
    }
}

TEST(MeshHeights, MovingEverythingChangesNothing) {
  constexpr double kTolerance = 1e-11;
  for (const Scene& scene : scenes())
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const auto surface = make_mesh_surface(scene.mesh, scene.body, {.refinement = refinement});
      for (const Pose& X : scene.planes) {
        const Grid2 g{-0.0197, -0.0293, 0.00131, 0.00193, 31, 31};
        const Fields before = evaluate(*surface, X, g);
        const Pose X_PQ{{0.0, 0.0, 0.0021}, rotation_z(kPi)};
        const Grid2 turned{-g.x(g.nx - 1), -g.y(g.ny - 1), g.dx, g.dy, g.nx, g.ny};
        const Fields other = evaluate(*surface, X * X_PQ, turned);
        for (std::size_t i = 0; i < g.size(); ++i) {
          const double steep = 1.0 + std::pow(std::hypot(before.dzdx[i], before.dzdy[i]), 2);
          const double a = before.z[i], b = other.z[g.size() - 1 - i] + 0.0021;
          ASSERT_TRUE((std::isnan(a) && std::isnan(b)) || std::fabs(a - b) <= kTolerance * steep) << a << ' ' << b;
        }
      }
    }
}

}  // namespace
}  // namespace treadmark::mesh
