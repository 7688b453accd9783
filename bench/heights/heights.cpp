// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <filesystem>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/common/scene.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::bench {
namespace {

struct Contestant {
  Body body;
  const char* backend;
  double resolution;
};

/// The contestant, after its heights have been checked.
const Subject* admitted(benchmark::State& state, const Contestant& c) {
  const Subject& s = subject(Scene::damaged, c.body, c.backend, c.resolution);
  if (s.refusal.empty()) return &s;
  refuse(state, s.refusal);
  return nullptr;
}

void grid(benchmark::State& state, const Contestant& c, bool tilted, bool slopes) {
  const ThreadLimit one(1);
  const Subject* s = admitted(state, c);
  if (s == nullptr) return;
  std::vector<double> z(s->view->grid.size()), dx(slopes ? z.size() : 0), dy(dx);
  const PlaneGrid plane{tilted ? s->view->tilted.X_SP : s->view->level.X_SP, s->view->grid};
  for (auto _ : state) {
    s->surface->heights(plane, {z, dx, dy});
    benchmark::DoNotOptimize(z.data());
  }
  state.counters["per_point"] = time_each(z.size());
}

std::vector<Vec2> scattered_points(const Grid2& g) {
  std::vector<Vec2> out;
  for (int iy = 0; iy < g.ny; iy += 5)
    for (int ix = 0; ix < g.nx; ix += 3) out.push_back({g.x(ix) + 3e-5 * (iy % 2), g.y(iy)});
  return out;
}

void scattered(benchmark::State& state, const Contestant& c) {
  const ThreadLimit one(1);
  const Subject* s = admitted(state, c);
  if (s == nullptr) return;
  const std::vector<Vec2> p = scattered_points(s->view->grid);
  std::vector<double> z(p.size());
  for (auto _ : state) {
    s->surface->heights_at(s->view->tilted.X_SP, p, {z, {}, {}});
    benchmark::DoNotOptimize(z.data());
  }
  state.counters["per_point"] = time_each(p.size());
}

void located(benchmark::State& state, const Contestant& c) {
  const ThreadLimit one(1);
  const Subject* s = admitted(state, c);
  if (s == nullptr) return;
  const std::vector<Vec2> p = scattered_points(s->view->grid);
  std::vector<SurfacePoint> out(p.size());
  for (auto _ : state) {
    s->surface->locate(s->view->tilted.X_SP, p, out);
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["per_point"] = time_each(p.size());
}

/// Level and tilted, with slopes, at points without a grid, and inverse evaluation.
void enter_heights(Body body, const char* backend, double resolution) {
  const Contestant c{body, backend, resolution};
  const std::string end = std::string(body == Body::wheel ? "/wheel/" : "/rail/") + label(backend, resolution);
  const auto enter = [&](const char* name, auto run) {
    benchmark::RegisterBenchmark((name + end).c_str(), run)->Unit(benchmark::kMillisecond);
  };
  enter("level", [c](benchmark::State& state) { grid(state, c, false, false); });
  enter("tilted", [c](benchmark::State& state) { grid(state, c, true, false); });
  enter("slopes", [c](benchmark::State& state) { grid(state, c, true, true); });
  enter("scattered", [c](benchmark::State& state) { scattered(state, c); });
  enter("locate", [c](benchmark::State& state) { located(state, c); });
}

/// A wheel whose offsets lie in a file of NanoVDB, after it gave the heights of the one in memory.
void mapped(benchmark::State& state, bool tilted) {
  constexpr double kResolution = 1e-3, kSame = 1e-15;
  const ThreadLimit one(1);
  const app::BenchScene& s = scene(Scene::damaged);
  const app::BenchView& view = s.view(Body::wheel);
  const OutputFolder folder(std::filesystem::temp_directory_path(), OutputFolder::Old::kept);
  const std::filesystem::path file = folder.path() / "wheel.nvdb";
  write_offsets(file, s.natural(Body::wheel), {"offset", kResolution, s.regions.wheel});
  const auto surface = read_offset_surface(file).surface;
  const PlaneGrid plane{tilted ? view.tilted.X_SP : view.level.X_SP, view.grid};
  std::vector<double> z(view.grid.size()), in_memory(z);
  surface->heights(plane, {z, {}, {}});
  subject(Scene::damaged, Body::wheel, "offset", kResolution).surface->heights(plane, {in_memory, {}, {}});
  for (std::size_t k = 0; k < z.size(); ++k)
    if (std::isnan(z[k]) != std::isnan(in_memory[k]) || std::fabs(z[k] - in_memory[k]) > kSame)
      return refuse(state, "heights differ from those of offsets in memory");
  for (auto _ : state) {
    surface->heights(plane, {z, {}, {}});
    benchmark::DoNotOptimize(z.data());
  }
  state.counters["per_point"] = time_each(z.size());
}

/// Every backend: with samples 1, 0.5 and 0.25 mm apart, or as given where it needs none.
[[maybe_unused]] const bool entered = [] {
  for (const Backend* backend : backends())
    for (const double mm : backend->resample ? std::vector{1.0, 0.5, 0.25} : std::vector{0.0})
      for (const Body body : {Body::wheel, Body::rail}) enter_heights(body, backend->name.c_str(), 1e-3 * mm);
  if (has_part("nanovdb"))
    for (const bool tilted : {false, true})
      benchmark::RegisterBenchmark(tilted ? "tilted/wheel/offset.nvdb/1mm" : "level/wheel/offset.nvdb/1mm",
                                   [tilted](benchmark::State& state) { mapped(state, tilted); })
          ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
}  // namespace treadmark::bench
