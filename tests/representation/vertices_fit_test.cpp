// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Triangles of a scan become hierarchical splines: not through the vertices, but as closely as their noise allows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/representation/kinds.hpp"

namespace treadmark::testing {
namespace {

constexpr double kNoise = 2e-5;
constexpr Region kRegion{-0.12, 0.12, -20e-3, 25e-3};

/// A wheel with a flat as triangles of half a millimetre whose vertices are
/// noisy along the radius.
SurfaceSpec scanned(bool with_gap) {
  const NaturalSurface formula = create_natural(s1002(one_flat()));
  constexpr int kRows = 301, kColumns = 101;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  TriangleMesh mesh;
  mesh.name = "scan";
  std::vector<double> y(kColumns), r(kColumns);
  for (int j = 0; j < kColumns; ++j) y[static_cast<std::size_t>(j)] = -22e-3 + 0.49e-3 * j;
  for (int i = 0; i < kRows; ++i) {
    const double u = 0.13 * (2.0 * i / (kRows - 1) - 1.0);
    section_heights(*formula.surface, Body::wheel, u, y, {r, {}, {}});
    for (int j = 0; j < kColumns; ++j) {
      const double at = r[static_cast<std::size_t>(j)] + kNoise * normal(random);
      mesh.vertices.emplace_back(at * std::sin(u), y[static_cast<std::size_t>(j)], at * std::cos(u));
      if (i == 0 || j == 0 || (with_gap && std::abs(i - 150) < 60)) continue;
      const auto d = static_cast<std::uint32_t>(i * kColumns + j), c = d - 1, b = d - kColumns, a = b - 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  }
  SurfaceSpec spec;
  spec.body = Body::wheel;
  spec.nominal_radius = kWheelRadius;
  spec.shape = std::move(mesh);
  return spec;
}

TEST(VerticesOfAScan, AreFittedAsCloselyAsTheirNoiseAllows) {
  const NaturalSurface mesh = create_natural(scanned(false));
  const auto truth = create_natural(s1002(one_flat())).surface;
  const double of_triangles = distance(*truth, *mesh.surface, Body::wheel, kRegion, 4000).rms;
  for (const char* backend : {"thb", "thb-quadratic"}) {
    const RepresentedSurface fitted = represent(mesh, {backend, 0.0, kRegion});
    EXPECT_EQ(fitted.surface->backend(), backend);
    EXPECT_EQ(fitted.resolution, 0.0);
    EXPECT_THAT(fitted.note, ::testing::HasSubstr("whose noise is"));
    const Distance left = distance(*truth, *fitted.surface, Body::wheel, kRegion, 4000);
    EXPECT_EQ(left.missing, 0);
    EXPECT_LT(left.rms, 0.25 * of_triangles) << backend;
    // samples of the triangles keep their noise
    const auto sampled = represent(mesh, {backend, 0.5e-3, kRegion}).surface;
    EXPECT_GT(distance(*truth, *sampled, Body::wheel, kRegion, 4000).rms, 0.5 * of_triangles) << backend;
  }
}

TEST(VerticesOfAScan, AreRefusedWhereThereAreNone) {
  const NaturalSurface mesh = create_natural(scanned(true));
  try {
    represent(mesh, {"thb", 0.0, kRegion});
    FAIL();
  } catch (const Error& e) {
    EXPECT_THAT(e.what(), ::testing::HasSubstr("there are no points from u"));
    EXPECT_THAT(e.what(), ::testing::HasSubstr("give a resolution"));
  }
}

}  // namespace
}  // namespace treadmark::testing
