// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/running_limits.hpp"

#include <cmath>

namespace treadmark {
namespace {

constexpr double kKilometrePerHour = 1.0 / 3.6;

std::vector<RunningLimit> made_usual_limits() {
  using enum VehicleKind;
  std::vector<RunningLimit> rows{{.quantity = "Q", .constant = 90e3, .by_load = 0.5},
                                 {.quantity = "Q", .constant = 200e3},
                                 {.quantity = "Q", .above_speed = 160.0 * kKilometrePerHour, .constant = 190e3},
                                 {.quantity = "Q", .above_speed = 200.0 * kKilometrePerHour, .constant = 180e3},
                                 {.quantity = "Q", .above_speed = 250.0 * kKilometrePerHour, .constant = 170e3},
                                 {.quantity = "Q", .above_speed = 300.0 * kKilometrePerHour, .constant = 160e3},
                                 {.quantity = "Q_qst", .constant = 145e3},
                                 {.quantity = "Y_qst", .constant = 60e3},
                                 {.quantity = "YQ_2m", .from_radius = 250.0, .constant = 0.8}};
  for (const VehicleKind kind : {locomotive, passenger, freight}) {
    // Prud'homme 1967
    const double k = kind == freight ? 0.85 : 1.0;
    rows.push_back({.quantity = "sumY_2m", .vehicle = kind, .constant = 10e3 * k, .by_load = k / 3.0});
    rows.push_back({.quantity = "sumY_rms", .vehicle = kind, .constant = 5e3 * k, .by_load = k / 6.0});  // half of it
    if (kind == freight) continue;
    rows.push_back({.quantity = "ay_safety", .vehicle = kind, .constant = 3.0});
    for (const char* ride : {"ay_ride", "az_ride"})
      rows.push_back({.quantity = ride, .vehicle = kind, .constant = 2.5});
  }
  return rows;
}

bool holds(const RunningLimit& limit, const LimitInput& in) {
  constexpr double kSlack = 0.5 * kKilometrePerHour;  // by which the mean speed of a section may scatter
  return (!limit.vehicle || *limit.vehicle == in.vehicle) && (!limit.section || *limit.section == in.section) &&
         (limit.from_radius == 0.0 || in.radius >= limit.from_radius) &&
         (!limit.to_radius || in.radius < *limit.to_radius) &&
         (limit.above_speed == 0.0 || in.speed > limit.above_speed + kSlack);
}

/// A part that is not there needs nothing.
double part(double factor, double of) { return factor == 0.0 ? 0.0 : factor * of; }

}  // namespace

const RunningLimits& usual_limits() {
  static const RunningLimits limits{"UIC 518 and EN 14363 as the literature quotes them", false, made_usual_limits()};
  return limits;
}

double limit_of(const RunningLimits& limits, std::string_view quantity, const LimitInput& input) {
  double least = kNaN;
  for (const RunningLimit& row : limits.limits) {
    if (row.quantity != quantity || !holds(row, input)) continue;
    const double value = row.constant + part(row.by_load, input.load) + part(row.by_curvature, 1.0 / input.radius);
    if (std::isnan(value)) return kNaN;
    if (!(least <= value)) least = value;
  }
  return least;
}

}  // namespace treadmark
