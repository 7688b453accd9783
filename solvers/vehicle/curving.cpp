// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/curving.hpp"

#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/roots.hpp"

namespace treadmark::vehicle {

namespace {

void check_curving(const CurvingVehicle& v, double cant, double gravity) {
  const auto need = [](bool right, const char* what) {
    if (!right) throw Error(ErrorKind::configuration, std::string("curving: ") + what);
  };
  need(v.mass > 0.0 && std::isfinite(v.mass), "the mass must be positive");
  need(v.base > 0.0 && std::isfinite(v.base), "the base must be positive");
  need(v.centre_height > 0.0 && std::isfinite(v.centre_height), "the centre of mass must be above the rails");
  need(v.roll_flexibility >= 0.0 && std::isfinite(v.roll_flexibility), "the roll flexibility must not be negative");
  need(std::isfinite(v.roll_centre_height), "the roll centre must be finite");
  need(std::abs(cant) < v.base, "the cant must be less than its base");
  need(gravity > 0.0 && std::isfinite(gravity), "gravity must be positive");
}

/// Centre of mass against the track, where the apparent weight is inclined by gamma (outwards of a right-hand curve).
struct Leaning {
  double aside, height;  ///< y, and above the rail tops [m]
};
Leaning leaning(const CurvingVehicle& v, double gamma) {
  const double lever = v.centre_height - v.roll_centre_height, roll = -v.roll_flexibility * gamma;
  return {lever * std::sin(roll), v.roll_centre_height + lever * std::cos(roll)};
}

/// Moment about the middle of the track that loads the left rail, over the apparent weight [m].
double tilting(const CurvingVehicle& v, double gamma) {
  const Leaning at = leaning(v, gamma);
  return at.height * std::sin(gamma) - at.aside * std::cos(gamma);
}

}  // namespace

Curving curving(const CurvingVehicle& v, const CurvingState& state) {
  check_curving(v, state.cant.value, state.gravity);
  if (!(state.speed >= 0.0) || !std::isfinite(state.speed * state.speed * state.curvature.value))
    throw Error(ErrorKind::configuration, "curving: the speed must not be negative");
  const double g = state.gravity, square = state.speed * state.speed, centripetal = square * state.curvature.value,
               angle = std::asin(state.cant.value / v.base);
  Curving c;
  c.equilibrium_cant = v.base * centripetal / g;
  c.cant_deficiency = c.equilibrium_cant - state.cant.value;
  c.lateral_acceleration = centripetal * std::cos(angle) - g * std::sin(angle);
  c.normal_acceleration = g * std::cos(angle) + centripetal * std::sin(angle);
  const double gamma = std::atan2(c.lateral_acceleration, c.normal_acceleration),
               apparent = std::hypot(c.lateral_acceleration, c.normal_acceleration);
  c.body_roll = -v.roll_flexibility * gamma;
  c.body_lateral_acceleration = apparent * std::sin(gamma - c.body_roll);
  c.guiding_force = v.mass * c.lateral_acceleration;
  const double half = 0.5 * v.mass * c.normal_acceleration, moved = v.mass * apparent * tilting(v, gamma) / v.base;
  c.left_load = half + moved;
  c.right_load = half - moved;
  c.load_shift = moved / half;
  c.cant_rate = state.speed * state.cant.first;
  c.deficiency_rate = state.speed * (v.base * square * state.curvature.first / g - state.cant.first);
  return c;
}

Curving curving(const CurvingVehicle& vehicle, const PathPoint& point, double speed, double gravity) {
  return curving(vehicle, {speed, gravity, point.curvature, point.cant});
}

double overturning_speed(const CurvingVehicle& v, double curvature, double cant, double gravity) {
  check_curving(v, cant, gravity);
  if (curvature == 0.0) return kInfinity;
  // As in a curve to the right.
  const double angle = std::asin((curvature > 0.0 ? cant : -cant) / v.base);
  // The left rail carries all where the moment equals that of the weight at half the base; it grows with gamma as long
  // as the mass leans less than a right angle.
  const auto surplus = [&](double gamma) { return tilting(v, gamma) - 0.5 * v.base * std::cos(gamma); };
  const double most = kPi / 2.0 / std::max(1.0, v.roll_flexibility);
  if (surplus(most) < 0.0) return kInfinity;
  const auto short_of = [&](double gamma) { return surplus(gamma) < 0.0; };
  const double inclination = angle + bisect(0.0, most, short_of, 200, 1e-15).high;
  if (inclination >= kPi / 2.0) return kInfinity;
  return std::sqrt(gravity * std::tan(inclination) / std::abs(curvature));
}

std::vector<NamedNumber> named_numbers(const Curving& c) {
  constexpr double kDegree = kPi / 180.0, kKilo = 1e-3;
  return {{"equilibrium_cant_mm", c.equilibrium_cant * kMilli, "cant at which nothing is felt"},
          {"cant_deficiency_mm", c.cant_deficiency * kMilli, "what the cant lacks of it"},
          {"lateral_acceleration_m_s2", c.lateral_acceleration, "not compensated, in the track plane"},
          {"normal_acceleration_m_s2", c.normal_acceleration, "apparent gravity across the track plane"},
          {"body_lateral_acceleration_m_s2", c.body_lateral_acceleration, "in the plane of the leaning floor"},
          {"body_roll_deg", c.body_roll / kDegree, "of the vehicle against the track"},
          {"guiding_force_kN", c.guiding_force * kKilo, "sum of the lateral forces of the rails"},
          {"left_load_kN", c.left_load * kKilo, "of all wheels on the left rail"},
          {"right_load_kN", c.right_load * kKilo, "of all wheels on the right rail"},
          {"load_shift", c.load_shift, "difference of the loads over their sum"},
          {"cant_rate_mm_s", c.cant_rate * kMilli, "as the vehicle meets it"},
          {"deficiency_rate_mm_s", c.deficiency_rate * kMilli, "of cant, as the vehicle meets it"}};
}

}  // namespace treadmark::vehicle
