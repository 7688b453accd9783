// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/search/enter.hpp"

#include <cmath>
#include <string_view>

#include "treadmark/app/bench/check_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::bench {
namespace {

enum class Window { x1, x2, fine };

const char* name_of(Window window) {
  return window == Window::x1 ? "window_x1/" : window == Window::x2 ? "window_x2/" : "grid_0.1mm/";
}

struct Contestant {
  detection::SearchMethod method;
  Scene scene;
  const char* backend;
  double resolution;
  bool cold;
  Window window;
  int threads;
};

void double_window(Grid2& g) {
  g.x0 -= 0.5 * (g.nx - 1) * g.dx;
  g.y0 -= 0.5 * (g.ny - 1) * g.dy;
  g.nx = 2 * g.nx - 1;
  g.ny = 2 * g.ny - 1;
}

void refine(Grid2& g) {
  constexpr double kStep = 1e-4;
  g.nx = static_cast<int>(std::round((g.nx - 1) * g.dx / kStep)) + 1;
  g.ny = static_cast<int>(std::round((g.ny - 1) * g.dy / kStep)) + 1;
  g.dx = g.dy = kStep;
}

/// The full grid is the oracle of the other methods; it is held against itself on a grid twice as fine.
std::string check_full_grid(const detection::BodyPair& pair, const detection::SearchSettings& settings) {
  constexpr double kReference = 2e-5;  // [m]
  detection::SearchSettings fine = settings;
  fine.grid_T.dx *= 0.5, fine.grid_T.nx = 2 * fine.grid_T.nx - 1;
  fine.grid_T.dy *= 0.5, fine.grid_T.ny = 2 * fine.grid_T.ny - 1;
  const auto expected = detection::search_contact(pair, fine), found = detection::search_contact(pair, settings);
  if (found.patches.size() != expected.patches.size()) return "other patches than on a finer grid";
  for (std::size_t i = 0; i < found.patches.size(); ++i)
    if (!(std::hypot(found.patches[i].x - expected.patches[i].x, found.patches[i].y - expected.patches[i].y) <=
          kReference))
      return "another reference than on a finer grid";
  return {};
}

void search(benchmark::State& state, const Contestant& c) {
  const ThreadLimit limit(c.threads);
  for (const Body body : {Body::wheel, Body::rail})
    if (const Subject& s = subject(c.scene, body, c.backend, c.resolution); !s.refusal.empty())
      return refuse(state, s.refusal);
  const detection::BodyPair pair = bodies(c.scene, c.backend, c.resolution);
  detection::SearchSettings settings = scene(c.scene).search;
  settings.method = c.method;
  if (c.window == Window::x2) double_window(settings.grid_T);
  if (c.window == Window::fine) refine(settings.grid_T);
  std::string reason = app::check_search(pair, settings);
  if (reason.empty() && c.method == detection::SearchMethod::full_grid) reason = check_full_grid(pair, settings);
  if (!reason.empty()) return refuse(state, reason);
  detection::ContactSearch counted(pair, settings);
  counted.at(0.0);
  state.counters["points_evaluated"] = static_cast<double>(counted.points_evaluated());
  if (c.cold) {
    for (auto _ : state) benchmark::DoNotOptimize(detection::ContactSearch(pair, settings).at(0.0));
  } else {
    detection::ContactSearch search(pair, settings);
    search.at(0.0);
    bool further = false;  // never twice the same position
    for (auto _ : state)
      benchmark::DoNotOptimize(search.at((further = !further) ? app::kWarmStep : 2.0 * app::kWarmStep));
  }
  state.counters["window_points"] = static_cast<double>(settings.grid_T.size());
}

}  // namespace

bool enter_search(const char* name, detection::SearchMethod method, Scene scene) {
  struct Backend {
    const char* name;
    double resolution;
  };
  for (const Backend& b :
       {Backend{"analytic", 0.0}, Backend{"spline", 0.5e-3}, Backend{"mesh", 0.5e-3}, Backend{"offset", 0.5e-3}}) {
    if (ranges::count(backend_names(), b.name) == 0) continue;  // left out of this build
    // the others do not know that they have one profile
    const bool one_profile = std::string_view(b.name) == "analytic" || std::string_view(b.name) == "spline";
    if (method == detection::SearchMethod::locus && !one_profile) continue;
    for (const bool cold : {true, false})
      for (const Window window : {Window::x1, Window::x2, Window::fine})
        for (const int threads : {1, 2}) {
          const Contestant c{method, scene, b.name, b.resolution, cold, window, threads};
          const std::string full = std::string(name) + (cold ? "/cold/" : "/warm/") + name_of(window) +
                                   std::to_string(threads) + (threads == 1 ? "_thread/" : "_threads/") +
                                   label(b.name, b.resolution);
          benchmark::RegisterBenchmark(full.c_str(), [c](benchmark::State& state) { search(state, c); })
              ->Unit(benchmark::kMillisecond)
              ->UseRealTime();
        }
  }
  return true;
}

}  // namespace treadmark::bench
