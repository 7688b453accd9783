// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/contact_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::geometry {
namespace {

/// The same wheelset, seen in a mirror.
Position mirrored(const Position& p) {
  Position out = p;
  out.y = 0.0 - p.y;
  out.roll = 0.0 - p.roll;
  std::swap(out.right, out.left);
  return out;
}

/// Whether the profile reaches the outer rim, so that nothing of the wheel is beyond its end.
bool has_rim(const Section& wheel) {
  constexpr double kRim = 40e-3;  // [m]
  return wheel.last() >= kRim;
}

/// Why there can be no contact on one side, in words; empty where there is one.
std::string trouble(const WheelsetOnTrack& wheelset, const Touch& t, bool right) {
  const char* side = right ? "right" : "left";
  const SideInput& input = wheelset.side(right);
  if (!std::isfinite(t.gap)) return fmt::format("the {} wheel is nowhere over its rail", side);
  switch (t.end) {
    case ProfileEnd::none:
      return t.climbed ? fmt::format("the {} wheel has climbed over its flange", side)
             : t.slipping
                 ? fmt::format("the {} wheel's outer edge slips off the rail: the wheelset falls through the gauge",
                               side)
                 : std::string();
    case ProfileEnd::wheel_field:
      return has_rim(*input.wheel)
                 ? fmt::format("the {} wheel's outer edge slips off the rail: the wheelset falls through the gauge",
                               side)
                 : fmt::format("the {} wheel's profile is too short: it ends at y = {:.1f} mm, over the rail", side,
                               kMilli * input.wheel->last());
    case ProfileEnd::wheel_flange:
      return fmt::format(
          "the {} wheel's profile is too short: it ends at y = {:.1f} mm, where its flange runs on the "
          "rail",
          side, kMilli * input.wheel->first());
    case ProfileEnd::rail_gauge:
      return fmt::format("the {} rail's profile is too short: it ends {:.1f} mm below its top on the gauge side", side,
                         kMilli * t.track_z);
    case ProfileEnd::rail_field:
      return fmt::format("the {} rail's profile is too short: it ends {:.1f} mm below its top on the field side", side,
                         kMilli * t.track_z);
  }
  return {};
}

std::string trouble(const WheelsetOnTrack& wheelset, const Position& p) {
  const std::string right = trouble(wheelset, p.right, true);
  return right.empty() ? trouble(wheelset, p.left, false) : right;
}

/// Flanges must keep the wheelset on its rails: pushed to one side, the other wheel still stands on its rail.
void require_guided(const WheelsetOnTrack& wheelset, const Position& middle) {
  constexpr double kStep = 2e-3, kFarthest = 0.15;  // [m]
  constexpr double kFlange = 0.7;                   // [rad]; steeper than any tread
  if (middle.right.angle > kFlange && middle.left.angle > kFlange)
    throw Error(ErrorKind::numerical, "the flanges jam between the rails", {},
                "the gauge is too narrow for the wheelset");
  for (const bool right : {true, false}) {
    Position p = middle;
    for (double y = 0.0; y < kFarthest; y += kStep) {
      p = wheelset.at(right ? y : -y, &p);
      const Touch &guiding = right ? p.right : p.left, &other = right ? p.left : p.right;
      if (guiding.angle > kFlange || guiding.climbed) break;
      if (guiding.end != ProfileEnd::none) break;  // no flange there, nothing guides
      if (other.end != ProfileEnd::wheel_field && !other.slipping && std::isfinite(other.gap)) continue;
      throw Error(ErrorKind::numerical,
                  fmt::format("{}: shifted by {:.0f} mm before a flange touches, {}",
                              has_rim(*wheelset.side(!right).wheel) ? "the wheelset falls through the gauge"
                                                                    : "a profile is too short",
                              kMilli * y, trouble(wheelset, other, !right)),
                  {}, "check gauge, distance of the wheels and the profiles' origins");
    }
    if (wheelset.symmetric()) break;
  }
}

double moved(const Touch& a, const Touch& b) {
  return std::max(std::fabs(a.wheel_y - b.wheel_y), std::fabs(a.rail_y - b.rail_y));
}

void find_jumps(const WheelsetOnTrack& wheelset, const Position& low, const Position& high, std::vector<Jump>& jumps) {
  const bool right = moved(low.right, high.right) > kJumpLength, left = moved(low.left, high.left) > kJumpLength;
  if (!right && !left) return;
  if (high.y - low.y <= kJumpWidth) {
    if (right) jumps.push_back({low, high, true});
    if (left) jumps.push_back({low, high, false});
    return;
  }
  const Position middle = wheelset.at(0.5 * (low.y + high.y), &low);
  if (!middle.sound()) return;
  find_jumps(wheelset, low, middle, jumps);
  find_jumps(wheelset, middle, high, jumps);
}

}  // namespace

ContactFunctions contact_functions(const WheelsetOnTrack& wheelset, const FunctionSettings& settings) {
  if (!(settings.step > 0.0) || !(settings.farthest >= settings.step))
    throw Error(ErrorKind::configuration, "the step of the shift must be positive and less than the farthest shift");
  ContactFunctions out;
  out.step = settings.step;
  const Position middle = wheelset.at(0.0);
  if (const std::string why = trouble(wheelset, middle); !why.empty())
    throw Error(ErrorKind::numerical, why, {}, "check gauge, distance of the wheels and the profiles' origins");
  require_guided(wheelset, middle);

  const auto count = to_whole<int>(std::floor(settings.farthest / settings.step + 1e-9));
  const auto half = [&](double sign, std::vector<Position>& rows, ShiftLimit& limit) {
    Position last = middle;
    for (int k = 1; k <= count; ++k) {
      check_cancelled();
      const Position p = wheelset.at(sign * k * settings.step, &last);
      if (!p.sound()) {
        limit.limited = true;
        limit.reason = trouble(wheelset, p);
        break;
      }
      last = p;
      rows.push_back(p);
    }
    limit.y = last.y;
  };
  std::vector<Position> to_right, to_left;
  half(1.0, to_right, out.to_right);
  if (wheelset.symmetric()) {
    for (const Position& p : to_right) to_left.push_back(mirrored(p));
    out.to_left = {out.to_right.limited, -out.to_right.y, out.to_right.reason};
    if (const auto at = out.to_left.reason.find("right"); at != std::string::npos)
      out.to_left.reason.replace(at, 5, "left");
    else if (const auto left = out.to_left.reason.find("left"); left != std::string::npos)
      out.to_left.reason.replace(left, 4, "right");
  } else {
    half(-1.0, to_left, out.to_left);
  }
  out.rows.assign(to_left.rbegin(), to_left.rend());
  out.rows.push_back(middle);
  out.rows.insert(out.rows.end(), to_right.begin(), to_right.end());

  const std::size_t first = wheelset.symmetric() ? to_left.size() : 0;
  for (std::size_t i = first; i + 1 < out.rows.size(); ++i)
    find_jumps(wheelset, out.rows[i], out.rows[i + 1], out.jumps);
  if (wheelset.symmetric()) {
    std::vector<Jump> all;
    for (const Jump& jump : out.jumps) all.push_back({mirrored(jump.after), mirrored(jump.before), !jump.right});
    ranges::reverse(all);
    all.insert(all.end(), out.jumps.begin(), out.jumps.end());
    out.jumps = std::move(all);
  }
  if (settings.second > 0.0)
    for (const Position& p : out.rows)
      for (const bool right : {true, false})
        for (const Touch& t : wheelset.further_touches(p, right, settings.second))
          out.others.push_back({p.y, right, t});
  return out;
}

RadiusDifference radius_difference(const ContactFunctions& functions) {
  RadiusDifference out;
  const auto add = [&](const Position& p) {
    if (!out.y.empty() && !(p.y > out.y.back())) return;
    out.y.push_back(p.y);
    out.dr.push_back(p.radius_difference());
  };
  std::size_t jump = 0;
  for (const Position& row : functions.rows) {
    for (; jump < functions.jumps.size() && functions.jumps[jump].before.y < row.y; ++jump) {
      add(functions.jumps[jump].before);
      add(functions.jumps[jump].after);
    }
    add(row);
  }
  return out;
}

}  // namespace treadmark::geometry
