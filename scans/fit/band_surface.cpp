// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/band_surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::scans {
namespace {

constexpr double kFarthest = 33e-3;  // between slices [m]

double wrapped(const FittedBand& fitted, double a) {
  const double u = fitted.u_at(a);
  return fitted.band.body == Body::wheel && fitted.band.closed ? wrap_angle(u) : u;
}

Profile ordered(Body body, std::vector<double> y, std::vector<double> z, std::string name) {
  if (body == Body::wheel) {
    std::reverse(y.begin(), y.end());
    std::reverse(z.begin(), z.end());
  }
  Profile out;
  out.body = body;
  out.y = std::move(y);
  out.z = std::move(z);
  out.name = std::move(name);
  return out;
}

std::vector<double> nodes_across(const FittedBand& fitted, double spacing) {
  const auto steps = to_whole<std::size_t>(std::max(4.0, std::ceil((fitted.s_max - fitted.s_min) / spacing)));
  std::vector<double> out(steps + 1);
  for (std::size_t k = 0; k <= steps; ++k)
    out[k] = fitted.s_min + (fitted.s_max - fitted.s_min) * static_cast<double>(k) / static_cast<double>(steps);
  return out;
}

double finest_knot(const FittedBand& fitted) {
  double finest = fitted.band.length();
  for (const SplineLevel& level : fitted.field.levels()) finest = std::min(finest, level.knot_a);
  return finest;
}

}  // namespace

Vec2 FittedBand::across(double a, double s) const {
  const Section::Point at = band.section.at(s);
  return at.position + field.value(a, s) * at.normal;
}

Vec3 FittedBand::point(double a, double s) const {
  const Vec2 p = across(a, s);
  return from_natural(band.body, {u_at(a), p.x(), p.y()});
}

std::vector<double> slice_stations(const FittedBand& fitted, double tolerance, double finest) {
  const Band& band = fitted.band;
  // the finest grid of knots decides where slices may lie; coarser knots are every second, fourth ... of them
  if (finest == 0.0) finest = finest_knot(fitted);
  auto count = to_whole<std::size_t>(std::round(band.length() / finest));
  // short bands have few knots: between them the splines are what slices on both sides make them again
  constexpr std::size_t kFewestPlaces = 8;
  for (; count < kFewestPlaces; count *= 2) finest *= 0.5;
  const double farthest = std::min(kFarthest, band.length() / static_cast<double>(kFewestPlaces));
  std::vector<double> stations;
  std::size_t last = 0;
  for (std::size_t k = 0; k <= count; ++k) {
    const double a = band.length() * static_cast<double>(k) / static_cast<double>(count);
    if (k == count && band.closed) break;
    // fine steps on both sides of a station that needs them
    double step = farthest;
    for (const double beside : {a - 0.5 * finest, a + 0.5 * finest})
      step = std::min(
          step, fitted.field.finest_knot_a(band.closed ? beside : std::clamp(beside, 0.0, band.length()), tolerance));
    const auto stride = to_whole<std::size_t>(std::max(1.0, std::floor(step / finest + 1e-6)));
    std::size_t power = 1;
    while (2 * power <= stride) power *= 2;
    if (k % power == 0 || k == count || k - last >= power) {
      stations.push_back(a);
      last = k;
    }
  }
  if (!band.closed) {
    // splines along the band know nothing of the curvature at its ends but what slices nearby tell
    constexpr double kNearEnd = 2e-3, kApart = 1e-3;
    for (double from = kNearEnd; from < 0.5 * farthest; from *= 2.0)
      for (const double a : {from, band.length() - from})
        if (ranges::none_of(stations, [&](double other) { return std::fabs(other - a) < kApart; }))
          stations.push_back(a);
  }
  return stations;
}

Profile slice_at(const FittedBand& fitted, double a, double spacing, std::string name) {
  const bool wheel = fitted.band.body == Body::wheel;
  std::vector<double> y, z;
  for (const double s : nodes_across(fitted, spacing)) {
    const Vec2 p = fitted.across(a, s);
    y.push_back(p.x());
    z.push_back(wheel ? p.y() - fitted.band.radius : -p.y());
  }
  return ordered(fitted.band.body, std::move(y), std::move(z), std::move(name));
}

SliceSet to_slices(const FittedBand& fitted, double spacing, double tolerance, std::string name) {
  const Band& band = fitted.band;
  SliceSet out;
  out.body = band.body;
  out.name = name;
  std::vector<std::pair<double, double>> order;  // u, a
  for (const double a : slice_stations(fitted, tolerance)) order.emplace_back(wrapped(fitted, a), a);
  std::sort(order.begin(), order.end());
  if (band.closed) {
    // the turn begins at -pi, so that it ends at pi; a slice next to it would only make the splines uneven
    constexpr double kNear = 0.25;
    const double near = kNear * finest_knot(fitted) / band.radius, pi = std::numbers::pi;
    std::erase_if(order, [&](const auto& station) { return station.first < near - pi || station.first > pi - near; });
    order.insert(order.begin(), {-pi, band.radius * (fitted.u_zero - pi) - band.a_min});
  }
  out.u.resize(order.size());
  out.profiles.resize(order.size());
  parallel_for(order.size(), [&](std::size_t k) {
    out.u[k] = order[k].first;
    out.profiles[k] = slice_at(fitted, order[k].second, spacing, name);
  });
  if (band.closed) {
    out.u.push_back(std::numbers::pi);
    out.profiles.push_back(out.profiles.front());
  }
  return out;
}

Profile section_profile(const FittedBand& fitted, double nominal_radius, double spacing, std::string name) {
  std::vector<double> y, z;
  for (const double s : nodes_across(fitted, spacing)) {
    const Vec2 p = fitted.band.section.at(s).position;
    y.push_back(p.x());
    z.push_back(fitted.band.body == Body::wheel ? p.y() - nominal_radius : -p.y());
  }
  return ordered(fitted.band.body, std::move(y), std::move(z), std::move(name));
}

std::vector<Vec2> triangle_nodes(const FittedBand& fitted, const BandPoints& points, std::span<const std::uint8_t> open,
                                 double spacing) {
  // rows along a; every second column half a step further, sides of triangles a little below spacing
  const double side = 0.866 * spacing;
  const double length = fitted.band.length(), width = fitted.s_max - fitted.s_min;
  const auto along = to_whole<std::size_t>(std::max(4.0, std::ceil(length / side)));
  const auto across = to_whole<std::size_t>(std::max(4.0, std::ceil(width / (0.866 * side))));
  const double step = length / static_cast<double>(along);
  std::vector<Vec2> out;
  const auto add = [&](double a, double s) {
    if (!open.empty()) {
      const auto row = std::min(points.rows - 1, to_whole<std::size_t>(a / points.cell_a)),
                 column = std::min(points.columns - 1, to_whole<std::size_t>(s / points.cell_s));
      if (open[row * points.columns + column] != 0) return;
    }
    out.emplace_back(a, s);
  };
  for (std::size_t j = 0; j <= across; ++j) {
    const double s = fitted.s_min + width * static_cast<double>(j) / static_cast<double>(across);
    const bool odd = j % 2 == 1;
    if (odd && !fitted.band.closed) add(0.0, s);
    for (std::size_t i = 0; i < along + (fitted.band.closed || odd ? 0 : 1); ++i)
      add(step * (static_cast<double>(i) + (odd ? 0.5 : 0.0)), s);
    if (odd && !fitted.band.closed) add(length, s);
  }
  return out;
}

std::vector<double> sagitta(const FittedBand& fitted, std::span<const Vec2> nodes) {
  // the section's share: what is left of it over the straight line between its ends
  const Section& section = fitted.band.section;
  constexpr double kStep = 0.1e-3;
  const auto steps = to_whole<std::size_t>(section.length() / kStep) + 2;
  std::vector<double> bent(steps, 0.0);  // twice integrated curvature
  double slope = 0.0;
  for (std::size_t k = 1; k < steps; ++k) {
    const double curvature = section.at(kStep * (static_cast<double>(k) - 1.0)).curvature;
    bent[k] = bent[k - 1] + kStep * slope - 0.5 * kStep * kStep * curvature;
    slope -= kStep * curvature;
  }
  std::vector<double> out;
  for (const Vec2& n : nodes) {
    const auto k = std::min(steps - 2, to_whole<std::size_t>(n.y() / kStep));
    const double t = n.y() / kStep - static_cast<double>(k);
    double h = fitted.field.value(n.x(), n.y()) + bent[k] + t * (bent[k + 1] - bent[k]);
    if (fitted.band.body == Body::wheel) h -= n.x() * n.x() / (2.0 * fitted.band.radius);
    out.push_back(h);
  }
  return out;
}

}  // namespace treadmark::scans
