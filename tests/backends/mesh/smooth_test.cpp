// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/backends/mesh/blend.hpp"
#include "treadmark/backends/mesh/make.hpp"
#include "treadmark/tests/backends/mesh/mesh_shapes.hpp"

namespace treadmark::mesh {
namespace {

using namespace testing;

const MeshOptions kFacets{.refinement = Refinement::facets}, kSmooth{.refinement = Refinement::smooth};

struct Errors {
  double height = 0.0, slope = 0.0, curvature = 0.0;
};

/// Greatest errors against z(x, y) with its exact derivatives, over a plane that is not turned.
template <class Shape>
Errors errors(const Surface& surface, const Pose& X, const Grid2& g, Shape exact) {
  const Fields f = evaluate(surface, X, g);
  std::vector<Vec2> points;
  Errors e;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double x = g.x(static_cast<int>(i) % g.nx), y = g.y(static_cast<int>(i) / g.nx);
    points.push_back({x, y});
    const auto [z, zx, zy, k1] = exact(X.origin.x() + x, X.origin.y() + y);
    e.height = std::max(e.height, std::fabs(f.z[i] + X.origin.z() - z));
    e.slope = std::max({e.slope, std::fabs(f.dzdx[i] - zx), std::fabs(f.dzdy[i] - zy)});
    if (std::isnan(f.z[i])) e.height = std::numeric_limits<double>::infinity();
  }
  std::vector<SurfacePoint> located(points.size());
  surface.locate(X, points, located);
  for (std::size_t i = 0; i < g.size(); ++i) {
    const auto [z, zx, zy, k1] = exact(X.origin.x() + points[i].x(), X.origin.y() + points[i].y());
    e.curvature = std::max(e.curvature, std::fabs(located[i].curvature_1 - k1));
  }
  return e;
}

struct Exact {
  double z, zx, zy, k1;
};

/// Height, slopes and greater curvature of a torus about the y axis: a barrel wheel.
Exact torus(double x, double y, double R, double m) {
  const double rho = R - m + std::sqrt(m * m - y * y), drho = -y / std::sqrt(m * m - y * y);
  const double z = std::sqrt(rho * rho - x * x);
  // meridian 1/m; round the axle the normal's length to the axis
  const double around = rho * std::sqrt(1.0 + drho * drho);
  return {z, -x / z, rho * drho / z, std::max(1.0 / m, 1.0 / around)};
}

double order(double coarse, double fine) { return std::log2(coarse / fine); }

TEST(SmoothMesh, ConvergesOnABarrelWheel) {
  const double R = 0.46, m = 0.05;
  const Grid2 g{-0.0103, -0.0107, 0.00052, 0.00053, 40, 40};
  std::vector<Errors> facets, smooth;
  for (const double h : {4e-3, 2e-3, 1e-3}) {
    const TriangleMesh mesh = wheel_net(-0.02, 0.02, static_cast<int>(std::lround(0.04 / h)) + 1, 0.06,
                                        static_cast<int>(std::lround(0.12 * R / h)) + 1, barrel(R, m));
    const auto exact = [&](double x, double y) { return torus(x, y, R, m); };
    const Pose X = pose({0.001, 0.002, R});
    facets.push_back(errors(*make_mesh_surface(mesh, Body::wheel, kFacets), X, g, exact));
    smooth.push_back(errors(*make_mesh_surface(mesh, Body::wheel, kSmooth), X, g, exact));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    RecordProperty("facets_height_nm_" + std::to_string(k), std::to_string(1e9 * facets[k].height));
    RecordProperty("smooth_height_nm_" + std::to_string(k), std::to_string(1e9 * smooth[k].height));
    RecordProperty("smooth_curvature_" + std::to_string(k), std::to_string(smooth[k].curvature));
  }
  EXPECT_NEAR(order(facets[1].height, facets[2].height), 2.0, 0.2);
  EXPECT_GT(order(smooth[0].height, smooth[1].height), 3.5);
  EXPECT_GT(order(smooth[1].height, smooth[2].height), 3.5);
  EXPECT_GT(order(smooth[1].slope, smooth[2].slope), 2.5);
  EXPECT_GT(order(smooth[1].curvature, smooth[2].curvature), 1.5);
  // at 1 mm: facets are off by h^2/(8 m) = 2.5 um and have no curvature, of 20/m
  EXPECT_GT(facets[2].height, 2e-6);
  EXPECT_LT(smooth[2].height, 1e-8);
  EXPECT_GT(facets[2].curvature, 19.0);
  EXPECT_LT(smooth[2].curvature, 0.2);
}

TEST(SmoothMesh, ConvergesOnARailOfIrregularTriangles) {
  // crown with a different curvature along the rail, scattered vertices of any valence
  const auto z = [](double x, double y) {
    return 1.7 * x * x + 9.0 * y * y + 150.0 * y * y * y + 20.0 * x * y + 2e-4 * std::sin(60.0 * x);
  };
  const auto exact = [&](double x, double y) -> Exact {
    const double zx = 3.4 * x + 20.0 * y + 0.012 * std::cos(60.0 * x), zy = 18.0 * y + 450.0 * y * y + 20.0 * x;
    const double xx = 3.4 - 0.72 * std::sin(60.0 * x), yy = 18.0 + 900.0 * y, xy = 20.0;
    const double w = 1.0 + zx * zx + zy * zy;
    const double mean = ((1 + zy * zy) * xx - 2 * zx * zy * xy + (1 + zx * zx) * yy) / (2.0 * std::pow(w, 1.5));
    const double gauss = (xx * yy - xy * xy) / (w * w);
    return {z(x, y), zx, zy, mean + std::sqrt(mean * mean - gauss)};
  };
  const Grid2 g{-0.0113, -0.0117, 0.00057, 0.00059, 40, 40};
  std::vector<Errors> facets, smooth;
  for (const int n : {17, 33, 65}) {
    const TriangleMesh mesh = scattered_sheet(0.016, n, z, 0.5, 11);
    facets.push_back(errors(*make_mesh_surface(mesh, Body::rail, kFacets), pose({0.0, 0.0, 0.0}), g, exact));
    smooth.push_back(errors(*make_mesh_surface(mesh, Body::rail, kSmooth), pose({0.0, 0.0, 0.0}), g, exact));
  }
  EXPECT_NEAR(order(facets[0].height, facets[2].height) / 2.0, 2.0, 0.35);
  EXPECT_GT(order(smooth[0].height, smooth[2].height) / 2.0, 3.0);
  EXPECT_LT(smooth[1].height, facets[1].height / 20.0);
  EXPECT_LT(smooth[2].height, facets[2].height / 50.0);
  EXPECT_LT(smooth[2].curvature, 1.0);  // of 30/m
}

TEST(SmoothMesh, CubicSurfacesAreReproduced) {
  // the fits are exact then, whatever the triangles look like, up to the rims
  const auto z = [](double x, double y) {
    return 2.0 * x * x - 3.0 * x * y + 4.0 * y * y + 30.0 * x * x * y - 50.0 * y * y * y;
  };
  // heights over the tangent frame of a vertex are not cubics of its own, unless the tangent planes are parallel: small
  // slopes
  const auto surface = make_mesh_surface(scattered_sheet(0.001, 15, z, 0.4, 5), Body::rail, kSmooth);
  const Grid2 g{-0.00099, -0.00099, 0.000045, 0.000045, 45, 45};
  const Fields f = evaluate(*surface, pose({0.0, 0.0, 0.0}), g);
  for (std::size_t i = 0; i < g.size(); ++i) {
    const double x = g.x(static_cast<int>(i) % g.nx), y = g.y(static_cast<int>(i) / g.nx);
    ASSERT_NEAR(f.z[i], z(x, y), 2e-13) << x << ' ' << y;  // facets: 2e-8
  }
}

TEST(SmoothMesh, SlopesAreContinuousAndMatchDifferences) {
  const double R = 0.3, m = 0.05;
  const auto surface = make_mesh_surface(wheel_net(-0.03, 0.03, 31, 0.1, 31, barrel(R, m)), Body::wheel, kSmooth);
  constexpr double kStep = 1e-7;
  const Pose X = pose({0.0, 0.004, R}, 0.1, 0.3, 0.02);
  const Grid2 g{-0.0151, -0.0153, 0.00031, 0.00033, 100, 90};
  const Fields f = evaluate(*surface, X, g);
  Grid2 right = g, left = g;
  right.x0 += kStep;
  left.x0 -= kStep;
  const Fields fr = evaluate(*surface, X, right), fl = evaluate(*surface, X, left);
  for (std::size_t i = 0; i < g.size(); ++i) {
    ASSERT_NEAR((fr.z[i] - fl.z[i]) / (2 * kStep), f.dzdx[i], 2e-8);
    // facets jump by h/m = 0.04 at their edges
    ASSERT_NEAR(fr.dzdx[i], fl.dzdx[i], 1e-5);
    ASSERT_NEAR(fr.dzdy[i], fl.dzdy[i], 1e-5);
  }
}

TEST(SmoothMesh, CreasesStaySharp) {
  // two planes that meet at 60 degrees, and a round part on one side
  const auto section = [](double s) {
    const double a = 2.0 * s - 1.0;
    return a < 0 ? Vec2(0.03 * a, -0.03 * a * std::tan(kPi / 3)) : Vec2(0.03 * a, 0.3 * 0.03 * a * a * 0.03);
  };
  const auto surface = make_mesh_surface(rail_net(0.0, 0.06, 31, 61, section), Body::rail, kSmooth);
  for (double y = -0.0297; y < 0.03; y += 0.00031) {
    const double expected = y < 0 ? -y * std::tan(kPi / 3) : 0.3 * y * y;
    EXPECT_NEAR(height_at(*surface, pose({0.03, 0.0, 0.0}), {0.00013, y}), expected, 1e-12) << y;
  }
  // smoothed over, the edge is rounded
  const auto rounded = make_mesh_surface(rail_net(0.0, 0.06, 31, 61, section), Body::rail,
                                         {.refinement = Refinement::smooth, .crease_angle = 3.0});
  EXPECT_GT(std::fabs(height_at(*rounded, pose({0.03, 0.0, 0.0}), {0.00013, 0.0004}) - 0.3 * 0.0004 * 0.0004), 1e-6);
}

TEST(SmoothMesh, LongThinTrianglesKeepTheirSection) {
  // two stations along the rail only: nothing is known along x, everything across
  const auto section = arc_section(0.05, 0.5);
  const auto surface = make_mesh_surface(rail_net(0.0, 0.5, 2, 81, section), Body::rail, kSmooth);
  for (double y = -0.0237; y < 0.0237; y += 0.00031)
    for (const double x : {0.01, 0.17, 0.49})
      ASSERT_NEAR(height_at(*surface, pose({x, 0.0, 0.0}), {0.0, y}), 0.05 - std::sqrt(0.0025 - y * y), 3e-9)
          << x << ' ' << y;
}

TEST(SmoothMesh, VerticesAreMet) {
  const auto z = [](double x, double y) { return 3.0 * x * x + 2e-4 * std::sin(900.0 * x) * std::cos(700.0 * y); };
  const TriangleMesh mesh = scattered_sheet(0.02, 21, z, 0.6, 4);
  const auto surface = make_mesh_surface(mesh, Body::rail, kSmooth);
  for (const Vec3& v : mesh.vertices)
    ASSERT_NEAR(height_at(*surface, pose({0.0, 0.0, 0.0}), {v.x(), v.y()}), v.z(), 1e-12);
}

TEST(SmoothMesh, HasNoGapsWhereItCannotBeSmooth) {
  // noise as large as the triangles: the facets count there, and nothing is missed
  std::mt19937 random(2);
  std::uniform_real_distribution<double> noise(-1e-3, 1e-3);
  TriangleMesh mesh = scattered_sheet(
      0.02, 41, [](double, double) { return 0.0; }, 0.5, 4);
  double low = 0.0, high = 0.0;
  for (Vec3& v : mesh.vertices) v.z() = noise(random), low = std::min(low, v.z()), high = std::max(high, v.z());
  const auto surface = make_mesh_surface(mesh, Body::rail, kSmooth);
  const Grid2 g{-0.0199, -0.0199, 0.000201, 0.000203, 190, 190};
  for (const double z : evaluate(*surface, pose({0.0, 0.0, 0.0}), g).z) {
    ASSERT_FALSE(std::isnan(z));
    ASSERT_GT(z, low - 2e-3);
    ASSERT_LT(z, high + 2e-3);
  }
}

TEST(BlendWeights, AreAPartitionThatVanishesWithItsGradient) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 1000; ++trial) {
    const std::array<Vec3, 3> corners{Vec3(unit(random), unit(random), 0), Vec3(unit(random), unit(random), 0.2),
                                      Vec3(unit(random), unit(random), 0)};
    const auto feet = edge_feet(corners);
    double a = unit(random), b = unit(random);
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    const std::array<Jet2, 3> at{Jet2(a, 1.0, 0.0), Jet2(b, 0.0, 1.0), Jet2(1.0 - a - b, -1.0, -1.0)};
    const auto w = blend_weights(at, feet);
    EXPECT_NEAR(w[0].v + w[1].v + w[2].v, 1.0, 1e-14);
    for (const Jet2& k : w) EXPECT_GE(k.v, 0.0);
    // derivatives against differences
    constexpr double kStep = 1e-6;
    if (a > 0.05 && b > 0.05 && a + b < 0.95) {
      const auto moved = blend_weights<Jet2>(
          {Jet2(a + kStep, 1.0, 0.0), Jet2(b, 0.0, 1.0), Jet2(1.0 - a - b - kStep, -1.0, -1.0)}, feet);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR((moved[k].v - w[k].v) / kStep, w[k].x, 1e-3);
        EXPECT_NEAR((moved[k].x - w[k].x) / kStep, w[k].xx, 1e-2 * (1.0 + std::fabs(w[k].xx)));
        EXPECT_NEAR((moved[k].y - w[k].y) / kStep, w[k].xy, 1e-2 * (1.0 + std::fabs(w[k].xy)));
      }
    }
    const auto edge = blend_weights<Jet2>({Jet2(0.0, 1.0, 0.0), Jet2(b, 0.0, 1.0), Jet2(1.0 - b, -1.0, -1.0)}, feet);
    EXPECT_EQ(edge[0].v, 0.0);
    EXPECT_EQ(edge[0].x, 0.0);
    EXPECT_EQ(edge[0].y, 0.0);
  }
}

}  // namespace
}  // namespace treadmark::mesh
