// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Grids are filled by triangles, lists by rays, the oracle line by line: all must agree, and so must the kernels.
#include <gtest/gtest.h>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/fit.hpp"
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/backends/mesh/smooth_patches.hpp"
#include "treadmark/tests/backends/mesh/mesh_shapes.hpp"
#include "treadmark/tests/support/kernels.hpp"

namespace treadmark::mesh {
namespace {

using namespace testing;

constexpr double kSame = 1e-12;  // [m]

void add(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const auto& c : other.triangles) mesh.triangles.push_back({c[0] + n, c[1] + n, c[2] + n});
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
}

/// A section of straight pieces with sharp edges, a step that is upright and one that is undercut.
Vec2 steps(double s) {
  static const Vec2 corners[] = {{-0.03, 0.012},  {-0.02, 0.004}, {-0.02, 0.0}, {0.0, 0.001},
                                 {-0.004, 0.006}, {0.015, 0.007}, {0.03, 0.02}};
  const double at = s * 6.0;
  const int k = std::min(5, static_cast<int>(at));
  return corners[k] + (at - k) * (corners[k + 1] - corners[k]);
}

struct Shape {
  const char* name;
  TriangleMesh mesh;
  Body body;
  std::vector<Pose> planes;
};

std::vector<Shape> shapes() {
  const std::vector<Pose> over{pose({0.03, 0.0, 0.0}), pose({0.03, 0.001, 0.001}, 0.05, 0.02, 0.03),
                               pose({0.03, 0.0, 0.0}, 0.6, 0.3, -0.2), pose({0.03, 0.0, 0.0}, 1.57, 0.2, 0.0),
                               pose({0.0313, 0.0, 0.0}, -1.2, 0.9, 0.1)};
  std::vector<Shape> all;
  all.push_back({"head", rail_net(0.0, 0.06, 31, 47, arc_section(0.025, 1.9)), Body::rail, over});
  all.push_back({"sharp edges and steep walls", rail_net(0.0, 0.06, 41, 61, steps), Body::rail, over});
  Shape holes{"holes", rail_net(0.0, 0.06, 61, 31, arc_section(0.06, 0.6)), Body::rail, over};
  std::mt19937 random(5);
  std::erase_if(holes.mesh.triangles, [&](const auto&) { return random() % 4 == 0; });
  all.push_back(std::move(holes));
  Shape sheets{"sheets one over the other", rail_net(0.0, 0.06, 31, 21, arc_section(0.08, 0.4)), Body::rail, over};
  for (const double depth : {0.002, 0.0035}) {
    TriangleMesh below = scattered_sheet(
        0.03, 22, [](double x, double y) { return 1e-3 * std::sin(150 * x + 80 * y); }, 0.6, 3);
    shift(below, {0.03, 0.0, depth});
    add(sheets.mesh, below);
  }
  all.push_back(std::move(sheets));
  all.push_back({"fine", rail_net(0.02, 0.04, 401, 301, arc_section(0.025, 0.5)), Body::rail, over});
  const auto on_wheel = [](double theta, double roll, double yaw, double pitch) {
    return pose({0.46 * std::sin(theta), 0.0, 0.46 * std::cos(theta)}, roll, yaw, pitch);
  };
  all.push_back({"wheel",
                 wheel_net(-0.068, 0.05, 40, kPi, 700,
                           [](double y) { return 0.46 - y / 20.0 + 0.028 / (1.0 + std::exp((y + 0.045) / 0.004)); }),
                 Body::wheel,
                 {on_wheel(0.0, 0.0, 0.0, 0.0), on_wheel(0.3, -0.3, 0.2, 0.3), on_wheel(0.0, 0.9, 1.4, 0.0)}});
  return all;
}

/// Compares where both have no fold within rounding of the point: returns how many points hit.
int expect_same(const Fields& a, const Fields& b, const char* name) {
  int hit = 0, wrong = 0;
  for (std::size_t i = 0; i < a.z.size(); ++i) {
    if (std::isnan(a.z[i]) && std::isnan(b.z[i])) continue;
    ++hit;
    const double steep = 1.0 + std::pow(std::hypot(b.dzdx[i], b.dzdy[i]), 2);
    if (!(std::fabs(a.z[i] - b.z[i]) <= kSame * steep)) {
      if (++wrong < 4)
        ADD_FAILURE() << name << ": point " << i << ", " << a.z[i] << " and " << b.z[i] << " slopes " << b.dzdx[i]
                      << ' ' << b.dzdy[i];
    }
    // slopes of facets jump where a point is on an edge: both sides are right only for the same triangle, which is
    // promised
    EXPECT_NEAR(a.dzdx[i], b.dzdx[i], 1e-8 * steep) << name << ' ' << i;
    EXPECT_NEAR(a.dzdy[i], b.dzdy[i], 1e-8 * steep) << name << ' ' << i;
  }
  EXPECT_EQ(wrong, 0) << name;
  return hit;
}

TEST(MeshKernels, GridsEqualLinesOneByOne) {
  for (const Shape& shape : shapes())
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const auto surface = make_mesh_surface(shape.mesh, shape.body, {.refinement = refinement});
      const auto oracle = make_mesh_oracle(shape.mesh, shape.body, {.refinement = refinement});
      for (const Pose& X : shape.planes)
        for (const Grid2& g :
             {Grid2{-0.0297, -0.0293, 0.00047, 0.00061, 127, 96}, Grid2{-0.011, -0.007, 0.2e-3, 0.2e-3, 71, 67},
              Grid2{-0.03, -0.03, 0.5e-3, 1e-3, 121, 61}, Grid2{-0.03, 0.0, 0.37e-3, 1.0, 160, 1},
              Grid2{0.0, -0.03, 1.0, 0.31e-3, 1, 190}}) {
          const int hit = expect_same(evaluate(*surface, X, g), evaluate(*oracle, X, g), shape.name);
          if (&X == shape.planes.data() && g.nx == 127) {
            EXPECT_GT(hit, 1000) << shape.name;
          }
        }
    }
}

TEST(MeshKernels, TilesEqualTheWhole) {
  for (const Shape& shape : shapes())
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const auto surface = make_mesh_surface(shape.mesh, shape.body, {.refinement = refinement});
      for (const Pose& X : shape.planes) {
        // steps without rounding: the tiles have the same points, some of them exactly on folds
        constexpr double kStep = 1.0 / 2048.0;
        const Grid2 g{-61.0 * kStep, -61.0 * kStep, kStep, kStep, 121, 121};
        const Fields whole = evaluate(*surface, X, g);
        for (const auto& [nx, ny] : {std::pair{8, 8}, {33, 5}, {1, 40}, {31, 60}, {5, 3}, {1, 1}})
          for (const auto& [x, y] : {std::pair{31, 32}, {7, 50}, {63, 29}, {40, 61}}) {
            const Fields part = evaluate(*surface, X, {g.x(x), g.y(y), g.dx, g.dy, nx, ny});
            for (int iy = 0; iy < ny; ++iy)
              for (int ix = 0; ix < nx; ++ix) {
                const std::size_t i = g.index(x + ix, y + iy), k = static_cast<std::size_t>(ix + nx * iy);
                const double steep = 1.0 + std::pow(std::hypot(whole.dzdx[i], whole.dzdy[i]), 2);
                ASSERT_EQ(std::isnan(whole.z[i]), std::isnan(part.z[k])) << shape.name;
                if (!std::isnan(part.z[k])) {
                  ASSERT_NEAR(whole.z[i], part.z[k], kSame * steep) << shape.name;
                }
              }
          }
      }
    }
}

/// Four surroundings of 12 to 30 points of a cubic, in frames of their own; those of the last lane lie on two lines.
FitBlock points_of_cubics(const std::array<std::array<double, 9>, 4>& cubics) {
  FitBlock block{};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-2e-3, 2e-3);
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const Vec3 normal = Vec3(0.1 * static_cast<double>(lane), -0.2, 1.0).normalized();
    const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
    const int count = 12 + 6 * static_cast<int>(lane);
    block.rows = std::max(block.rows, count);
    block.count[lane] = count;
    for (int i = 0; i < count; ++i) {
      const double x = at(random), y = lane == 3 ? 1e-3 * (i % 2) : at(random);
      VertexFit fit;
      fit.c = cubics[lane];
      const Vec3 p = x * u + y * v + fit.height(x, y) * normal;
      for (std::size_t k = 0; k < 3; ++k) block.from[i][k][lane] = p[static_cast<int>(k)];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      block.normal[k][lane] = normal[static_cast<int>(k)];
      block.axis_u[k][lane] = u[static_cast<int>(k)];
    }
  }
  return block;
}

TEST(MeshKernels, FitsReturnTheCubicThatPointsLieOn) {
  std::array<std::array<double, 9>, 4> cubics{};
  for (std::size_t lane = 0; lane < 4; ++lane)
    cubics[lane] = {0.01, -0.02, 3.0, 1.0 + static_cast<double>(lane), -2.0, 200.0, -90.0, 50.0, 120.0};
  for (const FitKernel* which : all_kernels<FitKernel>()) {
    FitBlock block = points_of_cubics(cubics);
    const FitBlock given = block;
    which->cubics(block);
    for (std::size_t lane = 0; lane < 3; ++lane) {
      EXPECT_GT(block.least_singular_value[lane], 1e-3) << lane;
      EXPECT_LT(block.least_singular_value[lane], 1.0) << lane;
      VertexFit fit, wanted;
      wanted.c = cubics[lane];
      Vec3 u, v, u0, n;
      for (std::size_t k = 0; k < 3; ++k) {
        const int row = static_cast<int>(k);
        u[row] = block.axis_u[k][lane], v[row] = block.axis_v[k][lane];
        u0[row] = given.axis_u[k][lane], n[row] = given.normal[k][lane];
      }
      const Vec3 v0 = n.cross(u0);
      EXPECT_NEAR((n.cross(u) - v).norm(), 0.0, 1e-14);
      for (std::size_t k = 0; k < 9; ++k) fit.c[k] = block.cubic[k][lane];
      for (const Vec2& p : {Vec2(1e-3, 0.5e-3), Vec2(-0.7e-3, 1.1e-3), Vec2(0.2e-3, -1.3e-3)}) {
        const Vec3 d = p.x() * u0 + p.y() * v0;
        EXPECT_NEAR(fit.height(d.dot(u), d.dot(v)), wanted.height(p.x(), p.y()), 1e-15) << lane;
      }
    }
    EXPECT_FALSE(block.least_singular_value[3] > 1e-6) << "two lines leave terms open";
  }
}

TEST(MeshKernels, OfBothProcessorsFillTilesAlike) {
  if (!avx2_kernel<TileKernel>()) GTEST_SKIP() << "no AVX2";
  const auto a = std::make_unique<Tile>(), b = std::make_unique<Tile>();
  for (const Shape& shape : shapes()) {
    MeshRepair repair;
    PreparedMesh mesh = prepare(shape.mesh, shape.body, repair);
    const Bvh bvh(mesh);
    for (const Pose& X : shape.planes) {
      const PlaneView view(mesh, X, shape.body == Body::wheel ? Facing::down : Facing::up);
      for (int part = 0; part < 30; ++part) {
        for (Tile* tile : {a.get(), b.get()}) {
          tile->nx = 32 - part % 5;
          tile->ny = 32 - part % 7;
          const double step = part % 2 == 0 ? 0.2e-3 : 0.5e-3;
          tile->inverse_dx = tile->inverse_dy = 1.0 / step;
          for (int i = 0; i < Tile::kStride; ++i) tile->x[i] = -0.03 + 0.002 * part + i * step;
          for (int i = 0; i < Tile::kHigh + Tile::kPad; ++i) tile->y[i] = 0.02 - 0.0013 * part + i * step;
        }
        ASSERT_TRUE(TileKernel::generic.fill(bvh.arrays(), view.lines(), *a));
        ASSERT_TRUE(TileKernel::avx2->fill(bvh.arrays(), view.lines(), *b));
        for (int iy = 0; iy < a->ny; ++iy)
          for (int ix = 0; ix < a->nx; ++ix) {
            const int at = iy * Tile::kStride + ix;
            ASSERT_EQ(a->asked[at], b->asked[at]) << shape.name;
            if (a->asked[at]) continue;
            ASSERT_EQ(a->depth[at], b->depth[at]) << shape.name;
            ASSERT_EQ(a->owner[at] < 0, b->owner[at] < 0) << shape.name;
            if (a->owner[at] >= 0) {
              ASSERT_EQ(a->triangles[a->owner[at]].index, b->triangles[b->owner[at]].index) << shape.name;
            }
          }
      }
    }
  }
}

TEST(MeshKernels, OfBothProcessorsEvaluatePatchesAlike) {
  if (!avx2_kernel<PatchKernel>()) GTEST_SKIP() << "no AVX2";
  constexpr double kClose = 1e-13;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Shape& shape : shapes()) {
    MeshRepair repair;
    const PreparedMesh mesh = prepare(shape.mesh, shape.body, repair);
    const SmoothPatches smooth(mesh, 0.5);
    int compared = 0;
    for (const Pose& X : shape.planes) {
      const PlaneView view(mesh, X, shape.body == Body::wheel ? Facing::down : Facing::up);
      const PlaneLines lines = view.lines();
      for (int trial = 0; trial < 2000; ++trial) {
        const auto t = static_cast<std::uint32_t>(random() % mesh.triangles.size());
        ProjectedTriangle triangle;
        triangle.load(mesh, view, t);
        if (std::fabs(triangle.slopes().norm()) > 5.0) continue;
        std::array<double, 7> x, y;
        for (std::size_t k = 0; k < x.size(); ++k) {
          const double a = unit(random), b = (1.0 - a) * unit(random);
          const Vec3 p = a * triangle.q[0] + b * triangle.q[1] + (1.0 - a - b) * triangle.q[2];
          x[k] = p.x(), y[k] = p.y();
        }
        std::array<std::array<double, 7>, 3> results[3];
        bool fine = true;
        for (int which = 0; which < 2; ++which) {
          const PatchKernel& kernel = which == 0 ? PatchKernel::generic : *PatchKernel::avx2;
          std::array<double, 4 * kPatchEntries> patches;
          fine = fine && smooth.prepare(kernel, lines, t, triangle.q[0].data(), patches.data());
          if (!fine) break;
          auto& r = results[which];
          kernel.points(patches.data(), lines.side, x.data(), y.data(), 7, r[0].data(), r[1].data(), r[2].data());
          // lanes of different triangles give the same to the last bit
          for (std::size_t k = 1; k < 4; ++k)
            std::copy_n(patches.data(), kPatchEntries, patches.data() + k * kPatchEntries);
          auto& m = results[2];
          kernel.mixed(patches.data(), lines.side, x.data(), y.data(), m[0].data(), m[1].data(), m[2].data());
          for (std::size_t k = 0; k < 4; ++k)
            for (int i = 0; i < 3; ++i)
              ASSERT_TRUE(m[i][k] == r[i][k] || (std::isnan(m[i][k]) && std::isnan(r[i][k]))) << shape.name;
        }
        if (!fine) continue;
        for (std::size_t k = 0; k < x.size(); ++k) {
          if (std::isnan(results[0][0][k]) || std::isnan(results[1][0][k])) continue;
          ++compared;
          ASSERT_NEAR(results[0][0][k], results[1][0][k], kClose) << shape.name;
          // and what is evaluated one at a time
          const LineHit hit = triangle.hit(triangle.edges(x[k], y[k], view.side), Cover::front);
          Evaluated e;
          ASSERT_TRUE(smooth.evaluate(view, triangle, hit, x[k], y[k], 1, e)) << shape.name;
          ASSERT_NEAR(e.z, results[1][0][k], kClose) << shape.name;
          for (int which = 0; which < 2; ++which) {
            ASSERT_NEAR(e.dzdx, results[which][1][k], 1e-9 * (1.0 + std::fabs(e.dzdx))) << shape.name;
            ASSERT_NEAR(e.dzdy, results[which][2][k], 1e-9 * (1.0 + std::fabs(e.dzdy))) << shape.name;
          }
        }
      }
    }
    EXPECT_GT(compared, 10000) << shape.name;
  }
}

TEST(MeshKernels, BoundsHoldAllHeightsFromAnyPlane) {
  constexpr double kRounding = 1e-10;
  constexpr int kPoints = 24;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Shape& shape : shapes())
    for (const Refinement refinement : {Refinement::facets, Refinement::smooth}) {
      const auto surface = make_mesh_surface(shape.mesh, shape.body, {.refinement = refinement});
      int hit = 0, empty = 0;
      for (int trial = 0; trial < 600; ++trial) {
        Pose X = shape.planes[static_cast<std::size_t>(trial) % shape.planes.size()];
        X.rotation = X.rotation * rotation({unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5});
        const double w = std::pow(10.0, -4.0 + 2.6 * unit(random)), h = std::pow(10.0, -4.0 + 2.6 * unit(random));
        const double x = 0.08 * (unit(random) - 0.5), y = 0.08 * (unit(random) - 0.5);
        const HeightBounds bounds = surface->height_bounds(X, {x, x + w, y, y + h});
        empty += bounds.empty;
        for (const double z : evaluate(*surface, X, {x, y, w / (kPoints - 1), h / (kPoints - 1), kPoints, kPoints}).z) {
          if (std::isnan(z)) continue;
          ++hit;
          ASSERT_FALSE(bounds.empty) << shape.name;
          ASSERT_GE(z, bounds.z_min - kRounding) << shape.name << ' ' << trial;
          ASSERT_LE(z, bounds.z_max + kRounding) << shape.name << ' ' << trial;
        }
      }
      EXPECT_GT(hit, 1000) << shape.name;
      EXPECT_GT(empty, 0) << shape.name;
    }
}

TEST(MeshKernels, OfBothProcessorsFindBoundsAlike) {
  if (!avx2_kernel<BoundsKernel>()) GTEST_SKIP() << "no AVX2";
  std::mt19937 random(23);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const Shape& shape : shapes()) {
    MeshRepair repair;
    PreparedMesh mesh = prepare(shape.mesh, shape.body, repair);
    const Bvh bvh(mesh);
    for (const Pose& X : shape.planes) {
      const PlaneView view(mesh, X, shape.body == Body::wheel ? Facing::down : Facing::up);
      for (int trial = 0; trial < 200; ++trial) {
        const BoundsQuery q{0.06 * (unit(random) - 0.5), 0.06 * (unit(random) - 0.5), 0.01 * unit(random),
                            0.01 * unit(random)};
        const BoundsFound a = BoundsKernel::generic.find(bvh.arrays(), view.lines(), q),
                          b = BoundsKernel::avx2->find(bvh.arrays(), view.lines(), q);
        ASSERT_EQ(a.low > a.high, b.low > b.high) << shape.name;
        if (a.low > a.high) continue;
        EXPECT_NEAR(a.low, b.low, 1e-10) << shape.name;
        EXPECT_NEAR(a.high, b.high, 1e-10) << shape.name;
      }
    }
  }
}

}  // namespace
}  // namespace treadmark::mesh
