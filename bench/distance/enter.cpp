// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/distance/enter.hpp"

#include "treadmark/app/bench/check_surface.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::bench {
namespace {

void distance(benchmark::State& state, DistanceMethod method, const char* backend, double resolution) {
  const ThreadLimit one(1);
  for (const Body body : {Body::wheel, Body::rail})
    if (const Subject& s = subject(Scene::damaged, body, backend, resolution); !s.refusal.empty())
      return refuse(state, s.refusal);
  const app::BenchScene& where = scene(Scene::damaged);
  const detection::BodyPair pair = bodies(Scene::damaged, backend, resolution);
  const std::string reason = app::check_distance(pair, where.X_TC, where.contact_grid);
  if (!reason.empty()) return refuse(state, reason);
  for (auto _ : state) benchmark::DoNotOptimize(method(pair, where.X_TC, where.contact_grid));
  state.counters["per_element"] = time_each(where.contact_grid.size());
}

}  // namespace

bool enter_distance(const char* name, DistanceMethod method) {
  for (const Backend* one : backends()) {
    const char* backend = one->name.c_str();
    const double resolution = one->resample ? 0.5e-3 : 0.0;
    benchmark::RegisterBenchmark((std::string(name) + "/" + label(backend, resolution)).c_str(),
                                 [=](benchmark::State& state) { distance(state, method, backend, resolution); })
        ->Unit(benchmark::kMillisecond);
  }
  return true;
}

}  // namespace treadmark::bench
