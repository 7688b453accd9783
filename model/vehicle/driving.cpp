// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/driving.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/line.hpp"

namespace treadmark {
namespace {

/// Speed gained per time from point i on.
double slope(const SpeedProfile& p, std::size_t i) {
  return i + 1 < p.time.size() ? (p.speed[i + 1] - p.speed[i]) / (p.time[i + 1] - p.time[i]) : 0.0;
}

double way(double speed, double slope, double time) { return time * (speed + 0.5 * slope * time); }

}  // namespace

Travel travel_at(const SpeedProfile& p, double time) {
  double distance = 0.0;
  for (std::size_t i = 0;; ++i) {
    const double a = slope(p, i);
    if (i + 1 == p.time.size() || time < p.time[i + 1]) {
      const double since = time - p.time[i];
      return {distance + way(p.speed[i], a, since), p.speed[i] + a * since, a};
    }
    distance += way(p.speed[i], a, p.time[i + 1] - p.time[i]);
  }
}

double time_at(const SpeedProfile& p, double distance) {
  for (std::size_t i = 0;; ++i) {
    const double a = slope(p, i), v = p.speed[i];
    if (i + 1 < p.time.size()) {
      const double whole = way(v, a, p.time[i + 1] - p.time[i]);
      if (distance >= whole) {
        distance -= whole;
        continue;
      }
    }
    // The root of a t^2/2 + v t = distance that is exact for small a.
    return p.time[i] + 2.0 * distance / (v + std::sqrt(std::max(0.0, v * v + 2.0 * a * distance)));
  }
}

double highest_speed(const SpeedProfile& p) { return *std::max_element(p.speed.begin(), p.speed.end()); }

double torque_at(const AxleTorque& t, double time) { return BrokenLine(t.time, t.torque).held_at(time); }

double force_at(const BodyForce& f, double time) { return BrokenLine(f.time, f.force).held_at(time); }

}  // namespace treadmark
