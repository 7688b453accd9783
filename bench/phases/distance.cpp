// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>

#include "treadmark/bench/phases/scene.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::bench {
namespace {

// Agreement: point by point evaluation gives the same distances.
void distance(benchmark::State& state, const char* backend) {
  const Scene& s = scene(backend);
  const wheelrail::PatchSolution& patch = s.solution.patches.front();
  const Pose& X_TC = patch.frame.X_TC;
  const Grid2& g = patch.grid;
  const auto whole = detection::undeformed_distance(s.bodies, X_TC, g);
  for (int iy = 0; iy < g.ny; iy += 7)
    for (int ix = 0; ix < g.nx; ix += 7) {
      const Vec2 point(g.x(ix), g.y(iy));
      const double h = height_at(*s.bodies.rail, s.bodies.X_TR.inverse() * X_TC, point) -
                       height_at(*s.bodies.wheel, s.bodies.X_TW.inverse() * X_TC, point);
      if (std::abs(h - (whole.distance[g.index(ix, iy)] - whole.approach)) > 1e-11) {
        state.SkipWithError("disagrees with point by point evaluation");
        return;
      }
    }
  for (auto _ : state) benchmark::DoNotOptimize(detection::undeformed_distance(s.bodies, X_TC, g));
  state.counters["elements"] = static_cast<double>(g.size());
}

}  // namespace

BENCHMARK_CAPTURE(distance, analytic, "analytic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(distance, spline, "spline")->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
