// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What does a height at points without a grid cost, and inverse evaluation with curvatures?
#include <benchmark/benchmark.h>

#include "treadmark/bench/heights/scene.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::bench {
namespace {

std::vector<Vec2> points(const Grid2& grid) {
  std::vector<Vec2> out;
  for (int iy = 0; iy < grid.ny; iy += 3)
    for (int ix = 0; ix < grid.nx; ix += 3) out.push_back({grid.x(ix) + 3e-5 * (iy % 2), grid.y(iy)});
  return out;
}

benchmark::Counter per_point(std::size_t n) {
  return {static_cast<double>(n) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

void scattered(benchmark::State& state, const Subject& subject) {
  const ThreadLimit one(1);
  const std::vector<Vec2> p = points(subject.grid);
  std::vector<double> z(p.size());
  for (auto _ : state) {
    subject.surface->heights_at(subject.tilted, p, {z, {}, {}});
    benchmark::DoNotOptimize(z.data());
  }
  state.counters["ns_per_point"] = per_point(p.size());
}

void located(benchmark::State& state, const Subject& subject) {
  const ThreadLimit one(1);
  const std::vector<Vec2> p = points(subject.grid);
  std::vector<SurfacePoint> out(p.size());
  for (auto _ : state) {
    subject.surface->locate(subject.tilted, p, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["ns_per_point"] = per_point(p.size());
}

}  // namespace

void register_scattered() {
  for (const Subject& s : subjects()) {
    benchmark::RegisterBenchmark(("scattered/" + s.name).c_str(), [&s](benchmark::State& state) { scattered(state, s); });
    benchmark::RegisterBenchmark(("locate/" + s.name).c_str(), [&s](benchmark::State& state) { located(state, s); });
  }
}

}  // namespace treadmark::bench
