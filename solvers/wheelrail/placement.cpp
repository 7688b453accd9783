// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/rail_head.hpp"
#include "treadmark/solvers/wheelrail/rail_memory.hpp"

namespace treadmark::wheelrail {
namespace {

// Lateral extent of a surface's box seen in frame T, cut to what one rail or wheel may have where it is wider.
LateralRange box_range(const Surface& surface, const Pose& X_ST) {
  constexpr double kFarthest = 0.5;
  const Box3 box = surface.bounds();
  const bool wide = !(box.max.y() - box.min.y() < 2.0 * kFarthest);
  const Pose X_TS = X_ST.inverse();
  LateralRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double x : {box.min.x(), box.max.x()})
    for (const double y : {box.min.y(), box.max.y()})
      for (const double z : {box.min.z(), box.max.z()}) {
        const Vec3 corner(std::isfinite(x) ? x : 0.0, wide ? std::clamp(y, -kFarthest, kFarthest) : y,
                          std::clamp(z, -2.0, 2.0));
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
  const int n = 2 + std::clamp(to_whole<int>((range.y_max - range.y_min) / step), 14, 19998);
  const Grid2 grid{x_T, range.y_min, 1.0, (range.y_max - range.y_min) / (n - 1), 1, n};
  Section section;
  section.z.resize(grid.size());
  surface.heights({X_ST, grid}, {section.z, {}, {}});
  for (int i = 0; i < n; ++i) section.y.push_back(grid.y(i));
  return section;
}

constexpr int kSections = 32;  // a row of points costs a surface hardly more than one point
constexpr double kFinest = 1e-13;

// Boundary of a condition on the height between a point where it holds and one where it does not.
template <class Condition>
double boundary(const Surface& surface, const Pose& X_ST, double x_T, double holds, double fails,
                Condition&& condition) {
  while (std::abs(holds - fails) > kFinest) {
    const Section section = lateral_section(surface, X_ST, x_T, {std::min(holds, fails), std::max(holds, fails)},
                                            std::abs(holds - fails) / kSections);
    const int n = static_cast<int>(section.y.size());
    const bool upwards = fails > holds;
    const double before = std::abs(holds - fails);
    for (int k = 1; k < n; ++k) {
      const auto i = static_cast<std::size_t>(upwards ? k : n - 1 - k);
      if (k < n - 1 && condition(section.z[i])) {
        holds = section.y[i];
        continue;
      }
      fails = section.y[i];
      break;
    }
    if (!(std::abs(holds - fails) < 0.5 * before)) break;  // the last bits of y
  }
  return holds;
}

constexpr double kScanStep = 2e-4;

[[noreturn]] void refuse_without_surface(const Surface& rail, double x) {
  const Box3 box = rail.bounds();
  throw Error(
      ErrorKind::configuration,
      fmt::format("the rail has no surface seen from above at x = {:.6g} mm, where the gauge is taken: it reaches "
                  "from x = {:.6g} to {:.6g} mm",
                  kMilli * x, kMilli * box.min.x(), kMilli * box.max.x()),
      {}, "set wheelset.s_mm to a place on it, or place it by track.rail_y_mm");
}

}  // namespace

LateralRange visible_range(const Surface& surface, const Pose& X_ST, double x_T) {
  const LateralRange box = box_range(surface, X_ST);
  const Section section = lateral_section(surface, X_ST, x_T, box, kScanStep);
  const auto is_hit = [](double z) { return !std::isnan(z); };
  const auto first = std::find_if(section.z.begin(), section.z.end(), is_hit);
  if (first == section.z.end())
    throw Error(ErrorKind::configuration, "the rail has no surface seen from above at this position");
  const auto last = std::find_if(section.z.rbegin(), section.z.rend(), is_hit);
  const auto i = static_cast<std::size_t>(first - section.z.begin());
  const auto j = section.z.size() - 1 - static_cast<std::size_t>(last - section.z.rbegin());
  LateralRange range{section.y[i], section.y[j]};
  if (i > 0) range.y_min = boundary(surface, X_ST, x_T, section.y[i], section.y[i - 1], is_hit);
  if (j + 1 < section.y.size()) range.y_max = boundary(surface, X_ST, x_T, section.y[j], section.y[j + 1], is_hit);
  return range;
}

namespace {

/// Height of the top near a point of a section, by ever finer sections.
double top_height(const Surface& rail, const Pose& X_RT, double x, const Section& section, std::size_t top) {
  double height = section.z[top];
  LateralRange around{section.y[top > 0 ? top - 1 : top], section.y[std::min(top + 1, section.y.size() - 1)]};
  constexpr double kFlat = 1e-9;     // the height changes with the square of this [m]
  constexpr int kMostSections = 60;  // far from y = 0 the last bits of y are coarser than that
  for (int left = kMostSections; left > 0 && around.y_max - around.y_min > kFlat; --left) {
    const Section fine = lateral_section(rail, X_RT, x, around, (around.y_max - around.y_min) / kSections);
    std::size_t least = 0;
    for (std::size_t i = 1; i < fine.z.size(); ++i)
      if (!(fine.z[least] <= fine.z[i]) && !std::isnan(fine.z[i])) least = i;
    if (std::isnan(fine.z[least])) break;
    height = std::min(height, fine.z[least]);
    around = {fine.y[least > 0 ? least - 1 : 0], fine.y[std::min(least + 1, fine.y.size() - 1)]};
  }
  return height;
}

}  // namespace

GaugePoint gauge_point(const Surface& rail, double cant, const Track& track, double x) {
  // Frame with the rail's origin and the track's orientation; the rail is rolled by -cant in it.
  const Pose X_RT{Vec3::Zero(), rotation_x(cant)};
  const Section section = lateral_section(rail, X_RT, x, box_range(rail, X_RT), kScanStep);
  if (ranges::all_of(section.z, [](double z) { return std::isnan(z); })) refuse_without_surface(rail, x);
  const std::optional<RailHead> head =
      head_of_rail(section.y, section.z, track.gauge_height, track.gauge_at_innermost,
                   [&](std::size_t top) { return top_height(rail, X_RT, x, section, top); });
  if (!head)
    throw Error(ErrorKind::configuration, "no gauge point found on the rail profile", {},
                "check the gauge height and the orientation of the rail profile");
  // Innermost point not lower than the gauge height: still going inward there, or the inner side itself.
  const auto high_enough = [&](double z) { return z - head->z_top <= track.gauge_height; };
  GaugePoint point;
  point.z_top = head->z_top;
  point.near_top = section.y[head->top];
  point.y = section.y[head->first];
  if (head->first > 0) point.y = boundary(rail, X_RT, x, point.y, section.y[head->first - 1], high_enough);
  // an end that is as steep as the side of a head is one, seen from above
  constexpr double kSteep = 5.0, kReached = 5e-5, kBeside = 5e-5;
  const bool ends = head->first == 0 || std::isnan(section.z[head->first - 1]);
  const Section end = lateral_section(rail, X_RT, x, {point.y + 0.1 * kBeside, point.y + 1.1 * kBeside}, kBeside);
  const double depth = end.z.front() - point.z_top,
               slope = (end.z.front() - end.z.back()) / (end.y.back() - end.y.front());
  point.seen = !ends || !(depth < track.gauge_height - kReached) || !(slope < kSteep);
  return point;
}

Placement place(const Geometry& geometry, const Problem& p, RailMemory* memory) {
  RailMemory own(*geometry.rail);
  RailMemory& rail = memory ? *memory : own;
  Placement placed;
  const Track& t = p.track;
  const double cant = p.roller ? 0.0 : t.cant;
  placed.X_TR.rotation = rotation_x(-cant + t.roll);
  if (t.gauge_based) {
    // A rail without a section at x = 0 is held where the wheelset is.
    const Box3& box = rail.box();
    const bool at_zero = p.roller || (box.min.x() <= 0.0 && box.max.x() >= 0.0);
    const GaugePoint gauge = rail.gauge(cant, t, at_zero ? 0.0 : p.state.position.x);
    placed.gauge_seen = gauge.seen;
    // A roller's height is that of its nominal circle.
    placed.X_TR.origin = {0.0, 0.5 * t.gauge_width - gauge.y + t.dy, (p.roller ? 0.0 : -gauge.z_top) + t.dz};
  } else {
    placed.X_TR.origin = {0.0, t.rail_y0 + t.dy, t.rail_z0 + t.dz};
  }

  const SixMotion& q = p.state.position;
  placed.X_TS = placed.X_TR;
  if (!p.roller) placed.X_TS.origin.x() -= q.x;
  const SixMotion& d = p.state.wheel_offset;
  const double radius = p.wheelset.nominal_radius;
  placed.X_TWs = {{p.roller ? q.x : 0.0, q.y, q.z - radius}, rotation_x(q.roll) * rotation_z(q.yaw)};

  double tape_height = 0.0;
  if (p.wheelset.tape_line) {
    // In the wheel surface's own frame: lowest point of the section at the tape line.
    tape_height = height_at(*geometry.wheel, Pose{}, {0.0, *p.wheelset.tape_line}) - radius;
    if (std::isnan(tape_height)) throw Error(ErrorKind::configuration, "the tape line lies outside the wheel profile");
  }
  const Pose X_WsW{
      {d.x, 0.5 * p.wheelset.flange_back_distance - p.wheelset.flange_back_position + d.y, radius - tape_height + d.z},
      rotation_x(d.roll) * rotation_z(d.yaw)};
  placed.X_TW = placed.X_TWs * X_WsW;
  placed.X_TA = placed.X_TW * Pose{{0.0, 0.0, -radius}, rotation_y(q.pitch + d.pitch)};
  return placed;
}

}  // namespace treadmark::wheelrail
