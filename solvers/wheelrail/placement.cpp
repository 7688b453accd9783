// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

// Lateral extent of a surface's box seen in frame T, cut to something finite.
LateralRange box_range(const Surface& surface, const Pose& X_ST) {
  constexpr double kFarthest = 0.5;
  const Box3 box = surface.bounds();
  const Pose X_TS = X_ST.inverse();
  LateralRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double x : {box.min.x(), box.max.x()})
    for (const double y : {box.min.y(), box.max.y()})
      for (const double z : {box.min.z(), box.max.z()}) {
        const Vec3 corner(std::isfinite(x) ? x : 0.0, std::clamp(y, -kFarthest, kFarthest), std::clamp(z, -2.0, 2.0));
        const double y_T = X_TS.apply(corner).y();
        range.y_min = std::min(range.y_min, y_T);
        range.y_max = std::max(range.y_max, y_T);
      }
  return range;
}

struct Section {
  std::vector<double> y, z;
};

Section lateral_section(const Surface& surface, const Pose& X_ST, double x_T, const LateralRange& range, double step) {
  const int n = std::clamp(static_cast<int>((range.y_max - range.y_min) / step) + 2, 16, 20000);
  const Grid2 grid{x_T, range.y_min, 1.0, (range.y_max - range.y_min) / (n - 1), 1, n};
  Section section;
  section.z.resize(grid.size());
  surface.heights({X_ST, grid}, {section.z, {}, {}});
  for (int i = 0; i < n; ++i) section.y.push_back(grid.y(i));
  return section;
}

// Boundary of a condition between a point where it holds and one where it does not.
template <class Condition>
double bisect(double holds, double fails, Condition&& condition) {
  for (int i = 0; i < 60 && std::abs(holds - fails) > 1e-13; ++i) {
    const double middle = 0.5 * (holds + fails);
    (condition(middle) ? holds : fails) = middle;
  }
  return holds;
}

constexpr double kScanStep = 2e-4;

}  // namespace

LateralRange visible_range(const Surface& surface, const Pose& X_ST, double x_T) {
  const LateralRange box = box_range(surface, X_ST);
  const Section section = lateral_section(surface, X_ST, x_T, box, kScanStep);
  const auto visible = [&](double y) { return !std::isnan(height_at(surface, X_ST, {x_T, y})); };
  const auto is_hit = [](double z) { return !std::isnan(z); };
  const auto first = std::find_if(section.z.begin(), section.z.end(), is_hit);
  if (first == section.z.end()) throw Error(ErrorKind::configuration, "the rail has no surface seen from above at this position");
  const auto last = std::find_if(section.z.rbegin(), section.z.rend(), is_hit);
  const auto i = static_cast<std::size_t>(first - section.z.begin());
  const auto j = section.z.size() - 1 - static_cast<std::size_t>(last - section.z.rbegin());
  LateralRange range{section.y[i], section.y[j]};
  if (i > 0) range.y_min = bisect(section.y[i], section.y[i - 1], visible);
  if (j + 1 < section.y.size()) range.y_max = bisect(section.y[j], section.y[j + 1], visible);
  return range;
}

GaugePoint gauge_point(const Surface& rail, double cant, double gauge_height) {
  // Frame with the rail's origin and the track's orientation; the rail is rolled by -cant in it.
  const Pose X_RT{Vec3::Zero(), rotation_x(cant)};
  const Section section = lateral_section(rail, X_RT, 0.0, box_range(rail, X_RT), kScanStep);
  const auto height = [&](double y) { return height_at(rail, X_RT, {0.0, y}); };

  std::size_t top = section.z.size();
  for (std::size_t i = 0; i < section.z.size(); ++i)
    if (!std::isnan(section.z[i]) && (top == section.z.size() || section.z[i] < section.z[top])) top = i;
  if (top == section.z.size()) throw Error(ErrorKind::configuration, "the rail has no surface seen from above");

  // Top of the rail by golden sections around the lowest z of the scan.
  double low = section.y[top > 0 ? top - 1 : top], high = section.y[std::min(top + 1, section.y.size() - 1)];
  constexpr double kGolden = 0.6180339887498949;
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double z_a = height(a), z_b = height(b);
  while (high - low > 1e-12) {
    if (z_a <= z_b || std::isnan(z_b)) {
      high = b, b = a, z_b = z_a, a = high - kGolden * (high - low), z_a = height(a);
    } else {
      low = a, a = b, z_a = z_b, b = low + kGolden * (high - low), z_b = height(b);
    }
    if (high - low < 1e-9 && std::abs(z_a - z_b) < 1e-16) break;
  }
  GaugePoint point;
  point.z_top = std::min({section.z[top], std::isnan(z_a) ? section.z[top] : z_a, std::isnan(z_b) ? section.z[top] : z_b});

  // Innermost point not lower than the gauge height: still going inward there, or the inner side itself.
  const auto high_enough = [&](double y) { return height(y) - point.z_top <= gauge_height; };
  for (std::size_t i = 0; i <= top; ++i) {
    if (!(section.z[i] - point.z_top <= gauge_height)) continue;
    point.y = i > 0 ? bisect(section.y[i], section.y[i - 1], high_enough) : section.y[i];
    return point;
  }
  throw Error(ErrorKind::configuration, "no gauge point found on the rail profile", {},
              "check the gauge height and the orientation of the rail profile");
}

Placement place(const Geometry& geometry, const Problem& p) {
  Placement placed;
  const Track& t = p.track;
  placed.X_TR.rotation = rotation_x(-t.cant + t.roll);
  if (t.gauge_based) {
    const GaugePoint gauge = gauge_point(*geometry.rail, t.cant, t.gauge_height);
    placed.X_TR.origin = {0.0, 0.5 * t.gauge_width - gauge.y + t.dy, -gauge.z_top + t.dz};
  } else {
    placed.X_TR.origin = {0.0, t.rail_y0 + t.dy, t.rail_z0 + t.dz};
  }

  const SixMotion& q = p.state.position;
  const SixMotion& d = p.state.wheel_offset;
  const double radius = p.wheelset.nominal_radius;
  placed.X_TWs = {{0.0, q.y, q.z - radius}, rotation_x(q.roll) * rotation_z(q.yaw)};

  double tape_height = 0.0;
  if (p.wheelset.tape_line) {
    // In the wheel surface's own frame: lowest point of the section at the tape line.
    tape_height = height_at(*geometry.wheel, Pose{}, {0.0, *p.wheelset.tape_line}) - radius;
    if (std::isnan(tape_height))
      throw Error(ErrorKind::configuration, "the tape line lies outside the wheel profile");
  }
  const Pose X_WsW{{d.x, 0.5 * p.wheelset.flange_back_distance - p.wheelset.flange_back_position + d.y,
                    radius - tape_height + d.z},
                   rotation_x(d.roll) * rotation_z(d.yaw)};
  placed.X_TW = placed.X_TWs * X_WsW;
  placed.X_TA = placed.X_TW * Pose{{0.0, 0.0, -radius}, rotation_y(q.pitch + d.pitch)};
  return placed;
}

}  // namespace treadmark::wheelrail
