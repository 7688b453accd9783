// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/check_detection.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::app {
namespace {

// Methods may look at other points: references and least gaps are known to a part of the steps of the refined grids.
constexpr double kReference = 1e-5;  // [m]
constexpr double kGap = 1e-7;        // [m]
constexpr double kDistance = 1e-10;  // [m]

std::string compare(const detection::SearchResult& found, const detection::SearchResult& expected) {
  if (found.patches.size() != expected.patches.size())
    return fmt::format("{} patches instead of {}", found.patches.size(), expected.patches.size());
  for (std::size_t i = 0; i < found.patches.size(); ++i) {
    const detection::ContactPatch &a = found.patches[i], &b = expected.patches[i];
    const double apart = std::hypot(a.x - b.x, a.y - b.y);
    if (!(apart <= kReference)) return fmt::format("the reference of patch {} is off by {:.3g} um", i + 1, 1e6 * apart);
    if (!(std::abs(a.least_gap - b.least_gap) <= kGap))
      return fmt::format("the least gap of patch {} is off by {:.3g} nm", i + 1, 1e9 * (a.least_gap - b.least_gap));
  }
  return {};
}

}  // namespace

std::string check_search(const detection::BodyPair& bodies, const detection::SearchSettings& settings, int* patches) {
  detection::SearchSettings full = settings;
  full.method = detection::SearchMethod::full_grid;
  detection::ContactSearch search(bodies, settings);
  for (const double dz : {0.0, kWarmStep}) {
    const detection::SearchResult found = search.at(dz);
    if (patches != nullptr) *patches = static_cast<int>(found.patches.size());
    const std::string reason = compare(found, detection::search_contact(search.bodies_at(dz), full));
    if (!reason.empty()) return fmt::format("{} search: {}", dz == 0.0 ? "cold" : "warm", reason);
  }
  return {};
}

std::string check_distance(const detection::BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C) {
  constexpr int kEvery = 3;
  const detection::UndeformedDistance whole = detection::undeformed_distance(bodies, X_TC, grid_C);
  const Pose X_RC = bodies.X_TR.inverse() * X_TC, X_WC = bodies.X_TW.inverse() * X_TC;
  for (int iy = 0; iy < grid_C.ny; iy += kEvery)
    for (int ix = 0; ix < grid_C.nx; ix += kEvery) {
      const Vec2 point(grid_C.x(ix), grid_C.y(iy));
      const double expected = height_at(*bodies.rail, X_RC, point) - height_at(*bodies.wheel, X_WC, point);
      const double found = whole.distance[grid_C.index(ix, iy)] - whole.approach;
      if (std::isnan(expected) != std::isnan(found) || std::abs(found - expected) > kDistance)
        return fmt::format("undeformed distance: {:.3g} nm from single heights at x = {:.2f} mm, s = {:.2f} mm",
                           1e9 * (found - expected), 1e3 * point.x(), 1e3 * point.y());
    }
  return {};
}

}  // namespace treadmark::app
