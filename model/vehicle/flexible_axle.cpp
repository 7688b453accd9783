// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/flexible_axle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

[[noreturn]] void refuse_axle(std::string message, const SourcePosition& where, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), where, std::move(advice));
}

bool all_finite(const std::vector<double>& values) {
  return ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

void check_oscillator(const std::string& what, double mass, double stiffness, double damping,
                      const SourcePosition& where) {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (!positive(mass) || !positive(stiffness) || !(damping >= 0.0) || !std::isfinite(damping))
    refuse_axle(what + ": mass and frequency must be positive, the damping not negative", where);
}

/// What wheels alone make of the mass of a mode cannot exceed it.
void check_wheels(const std::string& what, double mass, double wheels, const SourcePosition& where) {
  constexpr double kRounding = 1.0 + 1e-6;
  if (wheels > kRounding * mass)
    refuse_axle(fmt::format("{}: its modal mass is {:.6g}, but turning wheels alone make {:.6g} of this shape", what,
                            mass, wheels),
                where, "shape, slope per metre and modal mass must have one scale");
}

bool is_rigid(const FlexibleAxle& axle, const BendingMode& mode) {
  double most = 0.0, off = 0.0;
  const double span = axle.places.back() - axle.places.front();
  for (std::size_t i = 0; i < axle.places.size(); ++i) {
    most = std::max({most, std::abs(mode.shape[i]), span * std::abs(mode.slope[i])});
    const double straight = mode.shape[0] + mode.slope[0] * (axle.places[i] - axle.places[0]);
    off = std::max({off, std::abs(mode.shape[i] - straight), span * std::abs(mode.slope[i] - mode.slope[0])});
  }
  constexpr double kStraight = 1e-6;
  return off <= kStraight * most;
}

void check_bending(const FlexibleAxle& axle, const BendingMode& mode, const std::string& what) {
  check_oscillator(what, mode.mass, mode.stiffness, mode.damping, mode.where);
  if (mode.shape.size() != axle.places.size() || mode.slope.size() != axle.places.size())
    refuse_axle(fmt::format("{} has {} displacements and {} slopes for {} places", what, mode.shape.size(),
                            mode.slope.size(), axle.places.size()),
                mode.where, "give both at every place of the axle");
  if (!all_finite(mode.shape) || !all_finite(mode.slope)) refuse_axle(what + " is not finite", mode.where);
  if (is_rigid(axle, mode))
    refuse_axle(what + " does not bend: its shape is a straight line", mode.where,
                "leave it out, the wheelset moves as a rigid body anyway");
  const double left = deflection_at(axle, mode, -0.5 * axle.wheel_distance).slope,
               right = deflection_at(axle, mode, 0.5 * axle.wheel_distance).slope;
  // About a diameter no wheel has less than half its polar moment of inertia.
  check_wheels(what, mode.mass, 0.5 * axle.wheel_polar_inertia * (left * left + right * right), mode.where);
}

void check_torsion(const FlexibleAxle& axle, const TorsionMode& mode, const std::string& what) {
  check_oscillator(what, mode.inertia, mode.stiffness, mode.damping, mode.where);
  const auto [left, right] = mode.wheel_rotation;
  if (!std::isfinite(left) || !std::isfinite(right)) refuse_axle(what + " is not finite", mode.where);
  if (left == 0.0 && right == 0.0) refuse_axle(what + " does not turn the wheels", mode.where, "leave it out");
  check_wheels(what, mode.inertia, axle.wheel_polar_inertia * (left * left + right * right), mode.where);
}

}  // namespace

void check_axle(const FlexibleAxle& axle) {
  const std::string what = fmt::format("axle '{}'", axle.name);
  if (!(axle.wheel_distance > 0.0) || !std::isfinite(axle.wheel_distance))
    refuse_axle(what + ": the distance of the wheels must be positive", axle.where);
  if (!(axle.wheel_polar_inertia >= 0.0) || !std::isfinite(axle.wheel_polar_inertia))
    refuse_axle(what + ": the moment of inertia of a wheel must not be negative", axle.where);
  if (axle.bending.empty() && axle.torsion.empty())
    refuse_axle(what + " neither bends nor twists", axle.where, "give it modes, or leave it out");
  if (!axle.bending.empty()) {
    if (axle.places.size() < 2 || !all_finite(axle.places) ||
        ranges::adjacent_find(axle.places, std::greater_equal<>{}) != axle.places.end())
      refuse_axle(what + ": bending needs at least two places along the axle, increasing", axle.where);
    const double wheel = 0.5 * axle.wheel_distance;
    if (axle.places.front() > -wheel || axle.places.back() < wheel)
      refuse_axle(fmt::format("{}: the wheels stand at {:.6g} and {:.6g} m, its places go from {:.6g} to {:.6g} m",
                              what, -wheel, wheel, axle.places.front(), axle.places.back()),
                  axle.where);
  }
  for (std::size_t i = 0; i < axle.bending.size(); ++i)
    check_bending(axle, axle.bending[i], fmt::format("bending mode {} of {}", i + 1, what));
  for (std::size_t i = 0; i < axle.torsion.size(); ++i)
    check_torsion(axle, axle.torsion[i], fmt::format("torsion mode {} of {}", i + 1, what));
}

AxleDeflection deflection_at(const FlexibleAxle& axle, const BendingMode& mode, double y) {
  const std::vector<double>& at = axle.places;
  const std::size_t i = piece_at(at, y);
  const double l = at[i + 1] - at[i], p = (y - at[i]) / l, p2 = p * p, p3 = p2 * p;
  const double w0 = mode.shape[i], w1 = mode.shape[i + 1], s0 = mode.slope[i], s1 = mode.slope[i + 1];
  return {w0 + (w1 - w0) * (3.0 * p2 - 2.0 * p3) + l * (s0 * (p - 2.0 * p2 + p3) + s1 * (p3 - p2)),
          (w1 - w0) * 6.0 * (p - p2) / l + s0 * (1.0 - 4.0 * p + 3.0 * p2) + s1 * (3.0 * p2 - 2.0 * p)};
}

}  // namespace treadmark
