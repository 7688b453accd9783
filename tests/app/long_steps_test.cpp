// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

#include "treadmark/backends/sampling/convert_points.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/tests/support/counting_token.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using treadmark::testing::CountingToken;

constexpr std::size_t kSections = 300, kAcross = 150;

sampling::PointGrid crown_points() {
  sampling::PointGrid grid;
  for (std::size_t i = 0; i < kSections; ++i) grid.u.push_back(1e-3 * static_cast<double>(i));
  for (std::size_t k = 0; k < kAcross; ++k) grid.y.push_back(0.25e-3 * static_cast<double>(k) - 18e-3);
  for (std::size_t i = 0; i < kSections; ++i)
    for (const double y : grid.y)
      grid.h.push_back(0.3 - std::sqrt(0.09 - y * y) + 1e-5 * std::sin(0.1 * static_cast<double>(i)));
  return grid;
}

/// Steps between the loops that run in parallel, which ask anyway: each asks as often as its work is long.
TEST(LongSteps, AskWhetherTheyAreToEnd) {
  const ThreadLimit one_thread(1);
  const treadmark::testing::TemporaryFolder folder;
  const auto path = [&](const char* name) { return folder.path() / name; };
  const sampling::PointGrid points = crown_points();
  const TriangleMesh mesh = sampling::to_mesh(points, "crown");
  SliceSet slices = sampling::to_slices(points, 0.0, "crown");
  for (const char* name : {"in.ply", "in.obj"}) io::write_mesh(path(name), mesh);
  SliceSet few = slices;
  few.u.resize(20), few.profiles.resize(20);
  io::write_slices(path("in.slcs"), few);

  constexpr long kMeshAsks = static_cast<long>(2 * (kSections - 1) * (kAcross - 1) / 4096);
  struct Step {
    const char* name;
    long asks;  ///< at least
    std::function<void()> work;
  };
  const Step steps[] = {
      {"points to triangles", kSections - 1, [&] { sampling::to_mesh(points, "x"); }},
      {"points to slices", kSections, [&] { sampling::to_slices(points, 0.0, "x"); }},
      {"slices to a spline", 2 * kSections, [&] { spline::fit_slices(slices); }},
      {"points to a NURBS", 3 * kSections + 6 * kAcross, [&] { spline::fit_point_grid(points); }},
      {"write .ply", kMeshAsks, [&] { io::write_mesh(path("out.ply"), mesh); }},
      {"write .stl", kMeshAsks, [&] { io::write_mesh(path("out.stl"), mesh); }},
      {"write .obj", kMeshAsks, [&] { io::write_mesh(path("out.obj"), mesh); }},
      {"read .ply", 2, [&] { io::read_mesh(path("in.ply"), 1.0); }},
      {"read .obj", 2, [&] { io::read_mesh(path("in.obj"), 1.0); }},
      {"check sum", 2, [&] { io::sha256_file(path("in.obj")); }},
      {"write slices", 20, [&] { io::write_slices(path("out.slcs"), few); }},
      {"read slices", 20, [&] { io::read_slices(path("in.slcs"), Body::rail, {}); }},
  };
  for (const Step& step : steps) {
    SCOPED_TRACE(step.name);
    const CountingToken never;
    {
      const CancellationScope scope(&never);
      step.work();
    }
    EXPECT_GE(never.passed(), step.asks);
    for (const char* name : {"out.ply", "out.stl", "out.obj", "out.slcs"}) std::filesystem::remove(path(name));
    for (const long last : {1L, never.passed() / 2}) {
      const CountingToken token(last);
      const CancellationScope scope(&token);
      EXPECT_THROW(step.work(), Cancelled) << last;
      for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
    }
  }
}

}  // namespace
}  // namespace treadmark::app
