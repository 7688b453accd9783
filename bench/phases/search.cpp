// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <benchmark/benchmark.h>

#include <cmath>

#include "treadmark/bench/phases/scene.hpp"

namespace treadmark::bench {
namespace {

// Agreement: the search on a grid four times as fine finds the same reference point.
void search(benchmark::State& state, const char* backend) {
  const Scene& s = scene(backend);
  detection::SearchSettings fine = s.search;
  fine.grid_T.dx *= 0.5, fine.grid_T.nx = 2 * fine.grid_T.nx - 1;
  fine.grid_T.dy *= 0.5, fine.grid_T.ny = 2 * fine.grid_T.ny - 1;
  const auto expected = detection::search_contact(s.bodies, fine), found = detection::search_contact(s.bodies, s.search);
  if (found.patches.size() != expected.patches.size() || std::abs(found.patches.at(0).x - expected.patches.at(0).x) > 2e-5 ||
      std::abs(found.patches.at(0).y - expected.patches.at(0).y) > 2e-5) {
    state.SkipWithError("disagrees with the search on a finer grid");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(detection::search_contact(s.bodies, s.search));
  state.counters["points"] = static_cast<double>(s.search.grid_T.size());
}

void search_shifted(benchmark::State& state, const char* backend) {
  const Scene& s = scene(backend);
  const detection::ContactSearch search(s.bodies, s.search);
  detection::BodyPair moved = s.bodies;
  moved.X_TW.origin.z() += 1e-6;
  const auto expected = detection::search_contact(moved, s.search);
  if (std::abs(search.at(1e-6).patches.at(0).y - expected.patches.at(0).y) > 1e-9) {
    state.SkipWithError("disagrees with a new search");
    return;
  }
  for (auto _ : state) benchmark::DoNotOptimize(search.at(1e-6));
}

}  // namespace

BENCHMARK_CAPTURE(search, analytic, "analytic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search, spline, "spline")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_shifted, analytic, "analytic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(search_shifted, spline, "spline")->Unit(benchmark::kMillisecond);

}  // namespace treadmark::bench
