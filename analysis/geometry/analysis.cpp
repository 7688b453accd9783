// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::geometry {
namespace {

constexpr double kFlangeBack = 70e-3;  // behind the tape line [m]
constexpr double k2mm = 2e-3, k3mm = 3e-3, k4mm = 4e-3;

/// Where the origins of the rails are, outwards from the middle.
std::array<double, 2> rail_places(const SideBodies& right, const SideBodies& left, const PairPlacement& placement) {
  if (!placement.gauge) return {0.5 * placement.rail_origins, 0.5 * placement.rail_origins};
  std::array<double, 2> out{};
  for (const bool is_right : {true, false}) {
    const RailTop top = rail_top(*(is_right ? right : left).rail, placement.gauge_height);
    if (std::isnan(top.y_gauge))
      throw Error(
          ErrorKind::configuration,
          fmt::format("the {} rail's profile is too short: it does not reach {:g} mm below its top on the gauge "
                      "side, where the gauge is measured",
                      is_right ? "right" : "left", kMilli * placement.gauge_height),
          {}, "give the distance of the rails' origins instead of the gauge");
    out[is_right ? 0 : 1] = 0.5 * *placement.gauge - top.y_gauge;
  }
  return out;
}

/// Amplitude of the single value, by the clearance between gauge and active faces (EN 14363).
std::pair<double, std::string> amplitude_by_rule(double clearance) {
  if (std::isnan(clearance)) return {k3mm, "3 mm, as the clearance is not known"};
  const double c = kMilli * clearance;
  if (c >= 7.0) return {k3mm, fmt::format("3 mm for a clearance of at least 7 mm, {:.2f} mm here", c)};
  if (c >= 5.0)
    return {0.5 * (clearance - 1e-3),
            fmt::format("(clearance - 1 mm) / 2 for clearances from 5 to 7 mm, {:.2f} mm here", c)};
  return {k2mm, fmt::format("2 mm for a clearance below 5 mm, {:.2f} mm here", c)};
}

/// What intervals cover together.
double covered(std::vector<std::array<double, 2>> parts) {
  ranges::sort(parts);
  double sum = 0.0, end = -kInfinity;
  for (const auto& [low, high] : parts) {
    if (high > end) sum += high - std::max(low, end);
    end = std::max(end, high);
  }
  return sum;
}

ContactSpread spread_of(const ContactFunctions& f, double middle, double amplitude) {
  ContactSpread out{amplitude, kNaN, kNaN};
  if (f.rows.front().y > middle - amplitude + 1e-9 || f.rows.back().y < middle + amplitude - 1e-9) return out;
  const auto width = [&](Touch Position::*side, double Touch::*place) {
    std::vector<std::array<double, 2>> parts;
    for (std::size_t i = 0; i + 1 < f.rows.size(); ++i) {
      const Position &a = f.rows[i], &b = f.rows[i + 1];
      if (a.y < middle - amplitude - 1e-9 || b.y > middle + amplitude + 1e-9) continue;
      if (std::fabs((a.*side).wheel_y - (b.*side).wheel_y) > kJumpLength) continue;
      if (std::fabs((a.*side).rail_y - (b.*side).rail_y) > kJumpLength) continue;
      parts.push_back({std::min((a.*side).*place, (b.*side).*place), std::max((a.*side).*place, (b.*side).*place)});
    }
    return covered(std::move(parts));
  };
  out.rail = 0.5 * (width(&Position::right, &Touch::rail_y) + width(&Position::left, &Touch::rail_y));
  out.wheel = 0.5 * (width(&Position::right, &Touch::wheel_y) + width(&Position::left, &Touch::wheel_y));
  return out;
}

Steering steering_of(const ContactFunctions& f, double contact_distance, double radius) {
  double to_right = -kInfinity, to_left = -kInfinity;
  const auto middle = ranges::lower_bound(f.rows, -1e-9, {}, &Position::y);
  for (auto p = middle; p != f.rows.end() && p->right.angle < kFlangeAngle; ++p)
    to_right = std::max(to_right, p->radius_difference());
  for (auto p = std::make_reverse_iterator(middle); p != f.rows.rend() && p->left.angle < kFlangeAngle; ++p)
    to_left = std::max(to_left, -p->radius_difference());
  const double least = std::min(to_right, to_left);
  if (!(least > 0.0)) return {kNaN, kNaN};
  return {least, contact_distance * radius / least};
}

void check(const AnalysisSettings& settings) {
  for (std::size_t i = 0; i < settings.amplitudes.size(); ++i)
    if (!(settings.amplitudes[i] > 0.0) || (i > 0 && !(settings.amplitudes[i] > settings.amplitudes[i - 1])))
      throw Error(ErrorKind::configuration, "amplitudes must be positive and increase");
}

}  // namespace

WheelsetOnTrack place(const SideBodies& right, const SideBodies& left, const PairPlacement& placement, Roll roll,
                      double yaw) {
  const auto [rail_right, rail_left] = rail_places(right, left, placement);
  const double half = 0.5 * placement.wheel_origins;
  return {{right.wheel, right.rail, half, rail_right, right.cant},
          {left.wheel, left.rail, half, rail_left, left.cant},
          0.5 * (right.radius + left.radius),
          roll,
          yaw};
}

Analysis analyse(const SideBodies& right, const SideBodies& left, const PairPlacement& placement,
                 const AnalysisSettings& settings) {
  check(settings);
  const WheelsetOnTrack wheelset = place(right, left, placement, settings.roll, settings.yaw);
  Analysis out;
  out.wheel_origins = placement.wheel_origins;
  out.radius_right = right.radius, out.radius_left = left.radius;
  out.rail_y_right = wheelset.side(true).rail_y, out.rail_y_left = wheelset.side(false).rail_y;
  out.gauge = out.rail_y_right + rail_top(*right.rail, placement.gauge_height).y_gauge + out.rail_y_left +
              rail_top(*left.rail, placement.gauge_height).y_gauge;
  const double face_right = wheel_marks(*right.wheel).face_y, face_left = wheel_marks(*left.wheel).face_y;
  out.flange_thickness_right = kFlangeBack + face_right;
  out.flange_thickness_left = kFlangeBack + face_left;
  out.active_faces = placement.wheel_origins + face_right + face_left;

  // Shifts as far as the amplitudes need them.
  constexpr double kMore = 3e-3, kFarthest = 60e-3;
  const double most = settings.amplitudes.empty() ? 0.0 : settings.amplitudes.back();
  FunctionSettings wanted{settings.step, std::max(settings.farthest, std::min(most, kFarthest) + kMore),
                          settings.second};
  std::optional<KinematicMotion> motion;
  const ShiftLimit* ends = nullptr;
  for (;;) {
    out.functions = contact_functions(wheelset, wanted);
    out.difference = radius_difference(out.functions);
    if (out.difference.y.size() < 2)
      throw Error(ErrorKind::numerical,
                  "the wheelset cannot be shifted: " +
                      (out.functions.to_right.limited ? out.functions.to_right.reason : out.functions.to_left.reason));
    motion.emplace(out.difference);
    const auto& f = out.functions;
    // the end that is nearer to the equilibrium stops the motion
    const double y0 = motion->equilibrium().value_or(0.0);
    ends = f.to_right.limited && (!f.to_left.limited || f.to_right.y - y0 < y0 - f.to_left.y) ? &f.to_right
           : f.to_left.limited                                                                ? &f.to_left
                                                                                              : nullptr;
    const bool enough = !motion->equilibrium() || motion->greatest_amplitude() >= most;
    if (enough || (f.to_right.limited && f.to_left.limited) || wanted.farthest >= kFarthest) break;
    wanted.farthest += kMore;
  }
  out.equilibrium = motion->equilibrium();
  out.no_equilibrium = motion->no_equilibrium();
  out.greatest_amplitude = motion->greatest_amplitude();

  const auto conicity_at = [&](double amplitude) {
    Conicity c = motion->conicity(amplitude);
    if (out.equilibrium && amplitude > out.greatest_amplitude && ends != nullptr)
      c.reason = fmt::format("beyond the flanges: shifted further than {:.2f} mm {}", kMilli * ends->y, ends->reason);
    return c;
  };
  if (out.equilibrium && ends != nullptr && !settings.amplitudes.empty() &&
      settings.amplitudes.front() > out.greatest_amplitude)
    throw Error(ErrorKind::configuration,
                fmt::format("the amplitude of {:g} mm lies beyond the flanges: the greatest one is {:.2f} mm, as {}",
                            kMilli * settings.amplitudes.front(), kMilli * out.greatest_amplitude, ends->reason),
                {}, "ask for less");
  for (const double a : settings.amplitudes) {
    out.conicity.push_back(conicity_at(a));
    if (settings.harmonic) out.harmonic.push_back(motion->harmonic_conicity(a));
  }
  out.at_3mm = conicity_at(k3mm);
  out.nonlinearity = (conicity_at(k4mm).tan_gamma - conicity_at(k2mm).tan_gamma) / k2mm;
  if (settings.wanted_amplitude) {
    out.rule = "asked for";
    out.single = conicity_at(*settings.wanted_amplitude);
  } else {
    const auto [amplitude, rule] = amplitude_by_rule(out.gauge - out.active_faces);
    out.rule = rule;
    out.single = conicity_at(amplitude);
  }

  const double y0 = out.equilibrium.value_or(0.0);
  out.spread = spread_of(out.functions, y0, k3mm);
  out.steering = steering_of(out.functions, placement.wheel_origins, wheelset.nominal_radius());
  const Position a = wheelset.at(y0 - k3mm), b = wheelset.at(y0 + k3mm);
  out.gravitational_stiffness =
      a.sound() && b.sound() ? (wheelset.holding_force(b) - wheelset.holding_force(a)) / (2.0 * k3mm) : kNaN;
  return out;
}

}  // namespace treadmark::geometry
