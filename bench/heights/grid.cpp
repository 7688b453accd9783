// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What does a height on a grid cost, and one with slopes, over the damaged part?
#include <benchmark/benchmark.h>

#include "treadmark/bench/heights/scene.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::bench {

void register_scattered();

namespace {

void heights(benchmark::State& state, const Subject& subject, bool tilted, bool slopes) {
  const ThreadLimit one(1);
  std::vector<double> z(subject.grid.size()), dx(slopes ? z.size() : 0), dy(dx);
  const PlaneGrid plane{tilted ? subject.tilted : subject.level, subject.grid};
  for (auto _ : state) {
    subject.surface->heights(plane, {z, dx, dy});
    benchmark::DoNotOptimize(z.data());
  }
  state.counters["ns_per_point"] =
      benchmark::Counter(static_cast<double>(z.size()) * 1e-9,
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace
}  // namespace treadmark::bench

int main(int argc, char** argv) {
  using namespace treadmark::bench;
  benchmark::Initialize(&argc, argv);
  for (const Subject& s : subjects()) {
    benchmark::RegisterBenchmark(("level/" + s.name).c_str(), [&s](benchmark::State& state) { heights(state, s, false, false); });
    benchmark::RegisterBenchmark(("tilted/" + s.name).c_str(), [&s](benchmark::State& state) { heights(state, s, true, false); });
    benchmark::RegisterBenchmark(("slopes/" + s.name).c_str(), [&s](benchmark::State& state) { heights(state, s, false, true); });
  }
  register_scattered();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
