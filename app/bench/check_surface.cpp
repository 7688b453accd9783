// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/bench/check_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/undeformed_distance.hpp"

namespace treadmark::app {

namespace {

constexpr double kExact = 1e-9;  // [m] the same point of one surface, found in another way
constexpr double kSteep = 3.0;   // slopes beyond this may hide behind others when turned
constexpr double kStep = 1e-6;   // of differences [m]
constexpr double kSlope = 1e-3;  // of differences, relative to 1 + slope^2 [-]
constexpr RollYawPitch kOtherTurn{-0.03, 0.01, -0.04};
constexpr std::size_t kSamples = 500;

bool missing(double z) { return std::isnan(z); }

/// Whether the surface as given ends (or begins) within so many points.
bool near_end(const BenchView::Plane& truth, const Grid2& g, int ix, int iy, int reach) {
  bool any = false, all = true;
  for (int jy = std::max(0, iy - reach); jy <= std::min(g.ny - 1, iy + reach); ++jy)
    for (int jx = std::max(0, ix - reach); jx <= std::min(g.nx - 1, ix + reach); ++jx) {
      const bool hit = !missing(truth.z[g.index(jx, jy)]);
      any = any || hit;
      all = all && hit;
    }
  return any && !all;
}

std::string place(const Grid2& g, std::size_t i) {
  const int nx = g.nx;
  return fmt::format("at x = {:.2f} mm, y = {:.2f} mm of the plane", 1e3 * g.x(static_cast<int>(i) % nx),
                     1e3 * g.y(static_cast<int>(i) / nx));
}

/// Normal distances from the truth over the whole grid.
std::string check_truth(const BenchView::Plane& subject, const BenchView::Plane& truth, const Grid2& g,
                        double resolution, double limit, double& largest) {
  const int reach = 2 + to_whole<int>(std::ceil(2.0 * resolution / g.dx));
  std::size_t worst = 0;
  double here = 0.0;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      if (missing(subject.z[i]) != missing(truth.z[i])) {
        if (near_end(truth, g, ix, iy, reach)) continue;
        return fmt::format(
            "{} {}", missing(truth.z[i]) ? "a height where there is no surface" : "no height where there is a surface",
            place(g, i));
      }
      if (missing(truth.z[i])) continue;
      const double d = std::abs(subject.z[i] - truth.z[i]) /
                       std::sqrt(1.0 + truth.dzdx[i] * truth.dzdx[i] + truth.dzdy[i] * truth.dzdy[i]);
      if (d > here) here = d, worst = i;
    }
  largest = std::max(largest, here);
  if (here <= limit) return {};
  return fmt::format("{:.3g} um from the surface as given {}, {:.3g} um allowed", 1e6 * here, place(g, worst),
                     1e6 * limit);
}

/// Points of the grid that are there and not steep.
std::vector<std::size_t> samples(const BenchView::Plane& plane, std::size_t count) {
  std::vector<std::size_t> out;
  const std::size_t every = std::max<std::size_t>(1, plane.z.size() / count);
  for (std::size_t i = every / 2; i < plane.z.size(); i += every)
    if (std::hypot(plane.dzdx[i], plane.dzdy[i]) < kSteep) out.push_back(i);  // false for NaN
  return out;
}

/// Smooth meshes depend on the direction of sight by order 5 in the size of their triangles; nothing else does.
double turning_limit(double resolution, double largest_curvature) {
  constexpr double kPart = 0.01;
  return kExact + kPart * std::pow(resolution, 5) * std::pow(largest_curvature, 4);
}

/// The points found are points of the surface in another plane too, asked for one by one.
std::string check_turned(const Surface& subject, const BenchView::Plane& plane, const Grid2& g, double limit) {
  const Pose X_SQ{plane.X_SP.origin, plane.X_SP.rotation * rotation(kOtherTurn)};
  for (const std::size_t i : samples(plane, kSamples)) {
    const int nx = g.nx, k = static_cast<int>(i);
    const Vec3 point_Q = X_SQ.apply_inverse(plane.X_SP.apply({g.x(k % nx), g.y(k / nx), plane.z[i]}));
    const double off = std::abs(height_at(subject, X_SQ, point_Q.head<2>()) - point_Q.z());
    if (!(off <= limit * (1.0 + plane.dzdx[i] * plane.dzdx[i] + plane.dzdy[i] * plane.dzdy[i])))
      return fmt::format("{:.3g} nm from its own single heights seen from elsewhere {}", 1e9 * off, place(g, i));
  }
  return {};
}

/// Slopes lie between the differences to both sides, which differ at the edges of facets.
std::string check_slopes(const Surface& subject, const BenchView::Plane& plane, const Grid2& g) {
  const std::vector<std::size_t> chosen = samples(plane, kSamples);
  std::vector<Vec2> points;
  for (const std::size_t i : chosen) {
    const int nx = g.nx, k = static_cast<int>(i);
    const Vec2 p(g.x(k % nx), g.y(k / nx));
    for (const Vec2& d : {Vec2(-kStep, 0.0), Vec2(kStep, 0.0), Vec2(0.0, -kStep), Vec2(0.0, kStep)})
      points.emplace_back(p + d);
  }
  std::vector<double> z(points.size());
  subject.heights_at(plane.X_SP, points, {z, {}, {}});
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    const std::size_t i = chosen[n];
    const double room = kSlope * (1.0 + plane.dzdx[i] * plane.dzdx[i] + plane.dzdy[i] * plane.dzdy[i]);
    for (const bool along : {true, false}) {
      const double slope = along ? plane.dzdx[i] : plane.dzdy[i];
      const double *before = &z[4 * n + (along ? 0 : 2)], *after = before + 1;
      const double left = (plane.z[i] - *before) / kStep, right = (*after - plane.z[i]) / kStep;
      if (slope >= std::fmin(left, right) - room && slope <= std::fmax(left, right) + room) continue;
      return fmt::format("slopes differ from differences of heights: {:.6f} instead of {:.6f} to {:.6f} {}", slope,
                         left, right, place(g, i));
    }
  }
  return {};
}

}  // namespace

double representation_limit(double resolution, double largest_curvature) {
  constexpr double kRoom = 2.0, kRounding = 5e-8;
  return resolution > 0.0 ? kRoom * resolution * resolution / 8.0 * largest_curvature + kRounding : kExact;
}

SurfaceAgreement check_surface(const Surface& subject, const BenchView& truth, double resolution, bool one_place) {
  const Grid2& g = truth.grid;
  const double limit = one_place ? kInfinity : representation_limit(resolution, truth.largest_curvature);
  const double turned = turning_limit(resolution, truth.largest_curvature);
  SurfaceAgreement result;
  for (const bool level : {true, false}) {
    const BenchView::Plane& expected = level ? truth.level : truth.tilted;
    BenchView::Plane plane{expected.X_SP, std::vector<double>(g.size()), std::vector<double>(g.size()),
                           std::vector<double>(g.size())};
    subject.heights({plane.X_SP, g}, {plane.z, plane.dzdx, plane.dzdy});
    std::string reason = check_truth(plane, expected, g, resolution, limit, result.difference);
    if (reason.empty()) reason = check_turned(subject, plane, g, turned);
    if (reason.empty()) reason = check_slopes(subject, plane, g);
    if (!reason.empty()) {
      result.reason = fmt::format("{} plane: {}", level ? "level" : "tilted", reason);
      return result;
    }
  }
  return result;
}

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
    const std::string reason = compare(found, detection::search_contact(detection::moved(bodies, dz), full));
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
