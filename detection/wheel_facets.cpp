// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/wheel_facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::detection {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double lowest_angle(const Pose& X_TW) {
  const Vec3 down_W = X_TW.rotation.row(2);
  return std::atan2(down_W.x(), down_W.z());
}

/// Points of the section at a material angle, in T; NaN heights where the wheel is missing.
std::vector<Vec3> section(const Surface& wheel, const Pose& X_TW, double angle, double y_first, double y_step, int count) {
  const Pose X_WP{Vec3::Zero(), rotation_y(angle)};
  const Grid2 line{0.0, y_first, 1.0, y_step, 1, count};
  std::vector<double> radius(line.size());
  wheel.heights({X_WP, line}, {radius, {}, {}});
  const Pose X_TP = X_TW * X_WP;
  std::vector<Vec3> points;
  points.reserve(radius.size());
  for (int i = 0; i < count; ++i) points.push_back(X_TP.apply({0.0, line.y(i), radius[static_cast<std::size_t>(i)]}));
  return points;
}

}  // namespace

LongitudinalRange facet_range(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets) {
  constexpr int kPoints = 600;
  const Box3 box = wheel.bounds();
  LongitudinalRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double side : {-1.0, 1.0})
    for (const Vec3& p : section(wheel, X_TW, lowest_angle(X_TW) + side * facets.half_angle, box.min.y(),
                                 (box.max.y() - box.min.y()) / (kPoints - 1), kPoints)) {
      if (std::isnan(p.x())) continue;
      range.x_min = std::min(range.x_min, p.x());
      range.x_max = std::max(range.x_max, p.x());
    }
  return range;
}

FacetWheel::FacetWheel(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets, const Grid2& g)
    : wheel_(wheel), X_TW_(X_TW), facets_(facets), lowest_(lowest_angle(X_TW)) {
  // Corners divide the whole width; those far from the grid are left out.
  constexpr int kMargin = 20;
  const double outer = wheel.bounds().max.y(), width = outer - wheel.bounds().min.y();
  step_ = width / (1.0 + std::floor(width / facets.lateral_step));
  const double grid_low = g.y0 - X_TW.origin.y(), grid_high = g.y(g.ny - 1) - X_TW.origin.y();
  first_ = outer - step_ * (std::ceil((outer - grid_low) / step_) + kMargin);
  across_ = static_cast<int>(std::ceil((grid_high - first_) / step_)) + kMargin;
  sections_.resize(static_cast<std::size_t>(facets.sections));
}

Rectangle FacetWheel::reach(const Rectangle& r) const {
  const double turn = 2.0 * facets_.half_angle / (facets_.sections - 1);
  const double along = 1.1 * wheel_.bounds().max.z() * turn + 1.5 * step_, across = 2.0 * step_ + 0.3 * along;
  return {r.x_min - along, r.x_max + along, r.y_min - across, r.y_max + across};
}

const Vec3& FacetWheel::make_corner(int k, int j) {
  Section& s = sections_[static_cast<std::size_t>(k)];
  constexpr int kSpare = 3;
  const int low = std::max(0, std::min(wanted_first_, j - kSpare)), high = std::min(across_ - 1, std::max(wanted_last_, j + kSpare));
  const double angle = lowest_ + facets_.half_angle * (2.0 * k / (facets_.sections - 1) - 1.0);
  const auto corners = [&](int first, int last) { return section(wheel_, X_TW_, angle, first_ + first * step_, step_, last - first + 1); };
  if (s.points.empty()) {
    s.first = low;
    s.points = corners(low, high);
  } else {
    const int last = s.first + static_cast<int>(s.points.size()) - 1;
    if (low < s.first) {
      std::vector<Vec3> more = corners(low, s.first - 1);
      more.insert(more.end(), s.points.begin(), s.points.end());
      s.points = std::move(more);
      s.first = low;
    }
    if (high > last) {
      const std::vector<Vec3> more = corners(last + 1, high);
      s.points.insert(s.points.end(), more.begin(), more.end());
    }
  }
  return s.points[static_cast<std::size_t>(j - s.first)];
}

// Continuous indices (a, b) of the facet point over (x, y): Newton on the bilinear map, cell by cell.
double FacetWheel::height_over(double x, double y, double& a, double& b) {
  constexpr int kMaxSteps = 40;
  for (int step = 0; step < kMaxSteps; ++step) {
    const int k = std::clamp(static_cast<int>(std::floor(a)), 0, facets_.sections - 2);
    const int j = std::clamp(static_cast<int>(std::floor(b)), 0, across_ - 2);
    const double u = a - k, v = b - j;
    if (!has_corners(k, j) || !has_corners(k + 1, j))
      for (const int dk : {0, 1})
        for (const int dj : {0, 1}) corner(k + dk, j + dj);
    const Vec3 *first = &corner(k, j), *second = &corner(k + 1, j);
    const Vec3 &p00 = first[0], &p01 = first[1], &p10 = second[0], &p11 = second[1];
    const Vec3 along = p10 - p00, twist = (p11 - p01) - along, du = along + v * twist, across = p01 - p00, dv = across + u * twist;
    const double rx = x - (p00.x() + u * along.x() + v * dv.x()), ry = y - (p00.y() + u * along.y() + v * dv.y());
    const double inverse = 1.0 / (du.x() * dv.y() - du.y() * dv.x());
    const double da = (rx * dv.y() - ry * dv.x()) * inverse, db = (ry * du.x() - rx * du.y()) * inverse;
    if (!std::isfinite(da) || !std::isfinite(db)) return kNaN;
    // The rest of the way is twist * da * db.
    constexpr double kClose = 1e-11;  // [m]
    constexpr double kRim = 1e-7;     // of a facet
    if (std::abs(da * db) * (std::abs(twist.x()) + std::abs(twist.y())) < kClose) {
      const double u_end = u + da, v_end = v + db;
      const bool inside = u_end > -kRim && u_end < 1 + kRim && v_end > -kRim && v_end < 1 + kRim;
      if (inside) {
        a = k + u_end, b = j + v_end;
        return p00.z() + u_end * along.z() + v_end * (across.z() + u_end * twist.z());
      }
      if (std::abs(da) < kRim && std::abs(db) < kRim) return kNaN;
    }
    a = std::clamp(a + da, -0.5, facets_.sections - 0.5);
    b = std::clamp(b + db, -0.5, across_ - 0.5);
  }
  return kNaN;
}

void FacetWheel::heights(const Grid2& g, std::span<double> z) {
  constexpr double kNear = 2.0;  // corners beside the grid; more are made when asked for
  const auto corner_at = [&](double y) { return (y - X_TW_.origin.y() - first_) / step_; };
  wanted_first_ = static_cast<int>(std::clamp(corner_at(g.y(0)) - kNear, 0.0, across_ - 1.0));
  wanted_last_ = static_cast<int>(std::clamp(corner_at(g.y(g.ny - 1)) + kNear, 0.0, across_ - 1.0));
  // Where a wheel that is round and upright has this point.
  const double radius = wheel_.bounds().max.z(), per_angle = 0.5 * (facets_.sections - 1) / facets_.half_angle;
  const auto section_at = [&](double x) {
    const double angle = std::asin(std::clamp((x - X_TW_.origin.x()) / radius, -1.0, 1.0));
    return std::clamp((angle + facets_.half_angle) * per_angle, 0.0, facets_.sections - 1.0);
  };
  for (int iy = 0; iy < g.ny; ++iy) {
    const double b_start = corner_at(g.y(iy));
    double a = section_at(g.x(0)), b = b_start, step_a = 0.0, step_b = 0.0;
    bool started = false;
    for (int ix = 0; ix < g.nx; ++ix) {
      double a_try = a + step_a, b_try = b + step_b;
      double height = height_over(g.x(ix), g.y(iy), a_try, b_try);
      if (std::isnan(height)) {
        // The neighbour led astray: start once more.
        a_try = section_at(g.x(ix)), b_try = b_start;
        height = height_over(g.x(ix), g.y(iy), a_try, b_try);
      }
      z[g.index(ix, iy)] = height;
      if (std::isnan(height)) continue;
      step_a = started ? a_try - a : 0.0, step_b = started ? b_try - b : 0.0;
      a = a_try, b = b_try, started = true;
    }
  }
}

}  // namespace treadmark::detection
