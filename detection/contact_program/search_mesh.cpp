// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/detection/contact_program/search_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"

namespace treadmark::detection {

namespace {

double offset_of(const WheelFacets& facets, int k) {
  return facets.half_range * (2.0 * k / (facets.sections - 1) - 1.0);
}

/// Points of one section, in T; NaN heights where the wheel is missing. offset: [rad] or [m] from the lowest line.
std::vector<Vec3> section(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets, double offset,
                          std::span<const double> y) {
  const bool planes = facets.kind == WheelFacets::Sections::planes;
  const double lowest = lowest_angle(X_TW), angle = planes ? lowest : lowest + offset, x = planes ? offset : 0.0;
  const std::vector<double> radius = section_radius(wheel, angle, y);
  const Pose X_TP = X_TW * Pose{Vec3::Zero(), rotation_y(angle)};
  std::vector<Vec3> points;
  points.reserve(y.size());
  for (std::size_t i = 0; i < y.size(); ++i)
    points.push_back(X_TP.apply({x, y[i], std::sqrt(radius[i] * radius[i] - x * x)}));
  return points;
}

}  // namespace

LongitudinalRange facet_range(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets) {
  LongitudinalRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double side : {-1.0, 1.0})
    for (const Vec3& p : section(wheel, X_TW, facets, side * facets.half_range, facets.lines)) {
      if (std::isnan(p.x())) continue;
      range.x_min = std::min(range.x_min, p.x());
      range.x_max = std::max(range.x_max, p.x());
    }
  return range;
}

FacetWheel::FacetWheel(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets)
    : wheel_(wheel), X_TW_(X_TW), facets_(facets) {
  const std::vector<double>& y = facets_.lines;
  for (std::size_t j = 0; j + 1 < y.size(); ++j) widest_ = std::max(widest_, y[j + 1] - y[j]);
  across_ = static_cast<int>(y.size());
  sections_.resize(static_cast<std::size_t>(facets.sections));
}

double FacetWheel::corner_near(double y) const {
  const std::vector<double>& lines = facets_.lines;
  const double at = y - X_TW_.origin.y();
  const auto above = ranges::lower_bound(lines, at);
  if (above == lines.begin()) return 0.0;
  if (above == lines.end()) return across_ - 1.0;
  const auto j = static_cast<std::size_t>(above - lines.begin()) - 1;
  return static_cast<double>(j) + (at - lines[j]) / (lines[j + 1] - lines[j]);
}

std::vector<Vec3> FacetWheel::corners(int k, int first, int last) const {
  return section(
      wheel_, X_TW_, facets_, offset_of(facets_, k),
      std::span(facets_.lines).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first + 1)));
}

Rectangle FacetWheel::reach(const Rectangle& r) const {
  const double lever = facets_.kind == WheelFacets::Sections::angles ? wheel_.bounds().max.z() : 1.0;
  const double along = 1.1 * lever * 2.0 * facets_.half_range / (facets_.sections - 1) + 1.5 * widest_,
               across = 2.0 * widest_ + 0.3 * along;
  return {r.x_min - along, r.x_max + along, r.y_min - across, r.y_max + across};
}

const Vec3& FacetWheel::make_corner(int k, int j) {
  Section& s = sections_[static_cast<std::size_t>(k)];
  constexpr int kSpare = 3;
  const int low = std::max(0, std::min(wanted_first_, j - kSpare)),
            high = std::min(across_ - 1, std::max(wanted_last_, j + kSpare));
  if (s.points.empty()) {
    s.first = low;
    s.points = corners(k, low, high);
  } else {
    const int last = s.first + static_cast<int>(s.points.size()) - 1;
    if (low < s.first) {
      std::vector<Vec3> more = corners(k, low, s.first - 1);
      more.insert(more.end(), s.points.begin(), s.points.end());
      s.points = std::move(more);
      s.first = low;
    }
    if (high > last) {
      const std::vector<Vec3> more = corners(k, last + 1, high);
      s.points.insert(s.points.end(), more.begin(), more.end());
    }
  }
  return s.points[static_cast<std::size_t>(j - s.first)];
}

double FacetWheel::height_over(double x, double y, double& a, double& b) {
  FacetPlace p;
  if (!find_facet([this](int k, int j) -> const Vec3& { return corner(k, j); }, facets_.sections, across_, x, y, a, b,
                  p))
    return kNaN;
  const double z00 = corner(p.k, p.j).z(), z10 = corner(p.k + 1, p.j).z(), z01 = corner(p.k, p.j + 1).z(),
               z11 = corner(p.k + 1, p.j + 1).z();
  return z00 + p.u * (z10 - z00) + p.v * (z01 - z00 + p.u * ((z11 - z01) - (z10 - z00)));
}

void FacetWheel::heights(const Grid2& g, std::span<double> z) {
  constexpr double kNear = 2.0;  // corners beside the grid; more are made when asked for
  wanted_first_ = to_whole<int>(std::max(0.0, corner_near(g.y(0)) - kNear));
  wanted_last_ = to_whole<int>(std::min(across_ - 1.0, corner_near(g.y(g.ny - 1)) + kNear));
  // Where a wheel that is round and upright has this point.
  const double radius = wheel_.bounds().max.z(), per_offset = 0.5 * (facets_.sections - 1) / facets_.half_range;
  const auto section_at = [&](double x) {
    const double offset = x - X_TW_.origin.x();
    const double place =
        facets_.kind == WheelFacets::Sections::planes ? offset : std::asin(std::clamp(offset / radius, -1.0, 1.0));
    return std::clamp((place + facets_.half_range) * per_offset, 0.0, facets_.sections - 1.0);
  };
  for (int iy = 0; iy < g.ny; ++iy) {
    const double b_start = corner_near(g.y(iy));
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
