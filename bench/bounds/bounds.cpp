// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include "treadmark/backends/registry.hpp"
#include "treadmark/bench/common/refuse.hpp"
#include "treadmark/bench/common/scene.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::bench {
namespace {

std::vector<Rectangle> squares(const Grid2& g, double side) {
  constexpr int kAcross = 6;
  std::vector<Rectangle> out;
  const double wx = std::max(0.0, g.x(g.nx - 1) - g.x0 - side), wy = std::max(0.0, g.y(g.ny - 1) - g.y0 - side);
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i) {
      const double x = g.x0 + wx * i / (kAcross - 1), y = g.y0 + wy * j / (kAcross - 1);
      out.push_back({x, x + side, y, y + side});
    }
  return out;
}

struct Tightness {
  bool holds = true;
  double bounded = 0.0, actual = 0.0;  ///< sums of the ranges of heights [m]
};

/// Every height over a square lies within its bounds.
Tightness check(const Surface& surface, const Pose& X_SP, const std::vector<Rectangle>& all) {
  constexpr int kPoints = 17;
  constexpr double kRounding = 1e-12;  // [m]
  Tightness t;
  std::vector<double> z(kPoints * kPoints);
  for (const Rectangle& r : all) {
    const HeightBounds b = surface.height_bounds(X_SP, r);
    surface.heights({X_SP,
                     {r.x_min, r.y_min, (r.x_max - r.x_min) / (kPoints - 1), (r.y_max - r.y_min) / (kPoints - 1),
                      kPoints, kPoints}},
                    {z, {}, {}});
    double least = INFINITY, greatest = -INFINITY;
    for (const double h : z)
      if (!std::isnan(h)) least = std::min(least, h), greatest = std::max(greatest, h);
    if (!(least <= greatest)) continue;
    if (b.empty || least < b.z_min - kRounding || greatest > b.z_max + kRounding) t.holds = false;
    t.bounded += b.z_max - b.z_min;
    t.actual += greatest - least;
  }
  return t;
}

void bounds(benchmark::State& state, Body body, const char* backend, double resolution, double side) {
  const ThreadLimit one(1);
  const Subject& s = subject(Scene::damaged, body, backend, resolution);
  if (!s.refusal.empty()) return refuse(state, s.refusal);
  const Pose& X_SP = s.view->tilted.X_SP;
  const std::vector<Rectangle> all = squares(s.view->grid, side);
  const Tightness tightness = check(*s.surface, X_SP, all);
  if (!tightness.holds) return refuse(state, "a height lies outside of its bounds");
  for (auto _ : state)
    for (const Rectangle& r : all) benchmark::DoNotOptimize(s.surface->height_bounds(X_SP, r));
  state.counters["per_square"] = time_each(all.size());
  state.counters["times_too_wide"] = tightness.bounded / tightness.actual;
}

/// Over squares of 1, 5 and 25 mm.
void enter_bounds(Body body, const char* backend, double resolution) {
  for (const int side_mm : {1, 5, 25}) {
    const std::string name =
        std::to_string(side_mm) + "mm" + (body == Body::wheel ? "/wheel/" : "/rail/") + label(backend, resolution);
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
      bounds(state, body, backend, resolution, 1e-3 * side_mm);
    })->Unit(benchmark::kMicrosecond);
  }
}

/// Every backend: with samples 1, 0.5 and 0.25 mm apart, or as given where it needs none.
[[maybe_unused]] const bool entered = [] {
  for (const Backend* backend : backends())
    for (const double mm : backend->resample ? std::vector{1.0, 0.5, 0.25} : std::vector{0.0})
      for (const Body body : {Body::wheel, Body::rail}) enter_bounds(body, backend->name.c_str(), 1e-3 * mm);
  return true;
}();

}  // namespace
}  // namespace treadmark::bench
