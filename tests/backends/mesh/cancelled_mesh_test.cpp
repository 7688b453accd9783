// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "treadmark/backends/mesh/bvh.hpp"
#include "treadmark/backends/mesh/prepare.hpp"
#include "treadmark/backends/mesh/ray_scene.hpp"
#include "treadmark/backends/mesh/sectors.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/tests/support/counting_token.hpp"

namespace treadmark::mesh {
namespace {

using treadmark::testing::CountingToken;

constexpr std::uint32_t kSide = 200;  // vertices

TriangleMesh crown_of_triangles() {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < kSide; ++i)
    for (std::uint32_t k = 0; k < kSide; ++k) {
      const double x = 1e-3 * i, y = 0.25e-3 * k - 25e-3;
      mesh.vertices.emplace_back(x, y, 0.3 - std::sqrt(0.09 - y * y));
      if (i == 0 || k == 0) continue;
      const std::uint32_t here = i * kSide + k;
      mesh.triangles.push_back({here - kSide - 1, here - 1, here});
      mesh.triangles.push_back({here - kSide - 1, here, here - kSide});
    }
  return mesh;
}

/// Steps of building a surface: how often each asks at least, with 40 000 vertices and 80 000 triangles of which
/// 4096 pass between two questions.
TEST(CancelledMesh, EveryStepAsks) {
  const ThreadLimit one_thread(1);
  const TriangleMesh mesh = crown_of_triangles();
  MeshRepair repair;
  const PreparedMesh prepared = prepare(mesh, Body::rail, repair);
  std::vector<std::pair<long, std::function<void()>>> steps{
      {9, [&] { merge_close(mesh.vertices, 1e-7); }},
      {250, [&] { connect(*std::make_unique<PreparedMesh>(prepared)); }},
      {19, [&] { orient(*std::make_unique<PreparedMesh>(prepared), Body::rail, repair); }},
      {340, [&] { prepare(mesh, Body::rail, repair); }},
      {90, [&] { find_sectors(prepared, 1.0); }},
      {50, [&] { const Bvh bvh(*std::make_unique<PreparedMesh>(prepared)); }},
  };
  if (has_part("embree")) steps.emplace_back(2, [&] { ray_scene(prepared); });
  for (std::size_t i = 0; i < steps.size(); ++i) {
    SCOPED_TRACE(i);
    const CountingToken never;
    {
      const CancellationScope scope(&never);
      steps[i].second();
    }
    EXPECT_GE(never.passed(), steps[i].first);
    for (const long last : {0L, never.passed() / 2}) {
      const CountingToken token(last);
      const CancellationScope scope(&token);
      EXPECT_THROW(steps[i].second(), Cancelled) << last;
    }
  }
}

}  // namespace
}  // namespace treadmark::mesh
