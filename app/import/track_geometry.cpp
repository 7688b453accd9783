// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/track_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::app {
namespace {

constexpr double kGaugeDepth = 14e-3;  // below the heads [m]

/// The section of a rail at a place along it, in the cloud's frame.
std::vector<Vec3> section_in_cloud(const TrackSide& rail, double x) {
  constexpr double kApart = 0.25e-3;
  const scans::FittedBand fitted{rail.band, rail.field, rail.s_min, rail.s_max, rail.u_zero};
  const Pose frame = frame_in_cloud(rail.placed, x);
  const auto steps = to_whole<std::size_t>(std::max(1.0, std::ceil((rail.s_max - rail.s_min) / kApart)));
  std::vector<Vec3> out;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double s = rail.s_min + (rail.s_max - rail.s_min) * static_cast<double>(k) / static_cast<double>(steps);
    const Vec2 p = fitted.across(x + rail.u_zero - rail.band.a_min, s);
    out.push_back(frame.apply({0.0, p.x(), -p.y()}));
  }
  return out;
}

/// The least way * y of a section down to a depth below its top; NaN where it does not reach so far down on that side.
double gauge_face(const std::vector<Vec2>& section, std::size_t top, double way) {
  const double bottom = section[top].y() + kGaugeDepth;
  double least = kInfinity;
  bool reaches = false;
  for (std::size_t k = 0; k < section.size(); ++k) {
    const Vec2& p = section[k];
    const bool beside = way * (p.x() - section[top].x()) <= 0.0;
    if (p.y() <= bottom) least = std::min(least, way * p.x());
    if (k == 0) continue;
    const Vec2& before = section[k - 1];
    if ((before.y() <= bottom) == (p.y() <= bottom)) continue;
    const double share = (bottom - before.y()) / (p.y() - before.y());
    least = std::min(least, way * (before.x() + share * (p.x() - before.x())));
    reaches = reaches || beside;
  }
  return reaches ? least : kNaN;
}

/// The place along the left rail in the plane across the right one; NaN where there is none.
double place_beside(const TrackSide& left, const Pose& right, double near) {
  constexpr int kRounds = 50;
  constexpr double kStill = 1e-9, kAlong = 0.5;  // [m]; cosine of rails that run the same way
  for (int round = 0; round < kRounds; ++round) {
    const Pose here = frame_in_cloud(left.placed, near);
    const Vec3 ahead = right.rotation.col(0);
    const double rate = ahead.dot(here.rotation.col(0)), off = ahead.dot(here.origin - right.origin);
    if (!(std::fabs(rate) > kAlong)) return kNaN;
    near -= off / rate;
    if (std::fabs(off) < kStill) return near >= left.x_min && near <= left.x_max ? near : kNaN;
  }
  return kNaN;
}

io::ImportReport::TrackPlace look_across(const TrackSide& left, const TrackSide& right, double x, double x_left,
                                         const std::optional<Vec3>& up) {
  const std::vector<Vec3> on_left = section_in_cloud(left, x_left), on_right = section_in_cloud(right, x);
  const Pose frame = frame_in_cloud(right.placed, x);
  const Vec3 ahead = frame.rotation.col(0);
  Vec3 y = frame.origin - frame_in_cloud(left.placed, x_left).origin;
  y = (y - ahead * ahead.dot(y)).normalized();
  std::vector<Vec2> sections[2];
  std::size_t tops[2] = {0, 0};
  // turned until the line that touches both from above is level
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    const Vec3 z = ahead.cross(y);
    for (const std::size_t side : {0u, 1u}) {
      sections[side].clear();
      for (const Vec3& p : side == 0 ? on_left : on_right)
        sections[side].emplace_back(y.dot(p - frame.origin), z.dot(p - frame.origin));
      tops[side] =
          static_cast<std::size_t>(std::min_element(sections[side].begin(), sections[side].end(),
                                                    [](const Vec2& a, const Vec2& b) { return a.y() < b.y(); }) -
                                   sections[side].begin());
    }
    const Vec2 from = sections[0][tops[0]], to = sections[1][tops[1]];
    const double angle = std::atan2(to.y() - from.y(), to.x() - from.x());
    y = std::cos(angle) * y + std::sin(angle) * z;
  }
  io::ImportReport::TrackPlace out;
  out.x = x;
  const Vec3 &top_left = on_left[tops[0]], &top_right = on_right[tops[1]];
  out.place = 0.5 * (top_left + top_right);
  out.gauge = gauge_face(sections[1], tops[1], 1.0) + gauge_face(sections[0], tops[0], -1.0);
  if (up) out.cant = (top_left - top_right).dot(*up);
  return out;
}

}  // namespace

io::ImportReport::Track measure_track(const TrackSide& left, const TrackSide& right, const std::optional<Vec3>& up) {
  constexpr double kApart = 0.5, kFewest = 8.0, kMost = 1000.0;  // [m]; places
  const double length = right.x_max - right.x_min;
  const auto count = to_whole<std::size_t>(std::clamp(std::ceil(length / kApart), kFewest, kMost));
  io::ImportReport::Track out;
  double beside = left.x_max;  // it runs the other way
  for (std::size_t k = 0; k < count; ++k) {
    check_cancelled();
    const double x = right.x_min + length * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    const double x_left = place_beside(left, frame_in_cloud(right.placed, x), beside);
    if (std::isnan(x_left)) continue;
    beside = x_left;
    out.places.push_back(look_across(left, right, x, x_left, up));
  }
  double sum = 0.0, known = 0.0;
  for (const auto& place : out.places) {
    if (std::isnan(place.gauge)) continue;
    sum += place.gauge, known += 1.0;
    out.gauge_least = std::isnan(out.gauge_least) ? place.gauge : std::min(out.gauge_least, place.gauge);
    out.gauge_greatest = std::isnan(out.gauge_greatest) ? place.gauge : std::max(out.gauge_greatest, place.gauge);
  }
  if (known > 0.0) out.gauge_mean = sum / known;
  return out;
}

}  // namespace treadmark::app
