// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/driving.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  std::size_t first = 0;
  if (!p.distance.empty()) {
    const auto behind = std::upper_bound(p.time.begin() + 1, p.time.end(), time);
    first = static_cast<std::size_t>(behind - p.time.begin()) - 1;
    distance = p.distance[first];
  }
  for (std::size_t i = first;; ++i) {
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

std::vector<RailShift> twist_shifts(const TwistTest& test, std::span<const double> places) {
  std::vector<std::size_t> from_front(places.size());
  std::iota(from_front.begin(), from_front.end(), std::size_t{0});
  std::stable_sort(from_front.begin(), from_front.end(),
                   [&](std::size_t a, std::size_t b) { return places[a] > places[b]; });
  const auto size = static_cast<std::size_t>(test.wheelsets_per_bogie);
  const auto middle = [&](std::size_t first, std::size_t count) {
    double sum = 0.0;
    for (std::size_t i = first; i < first + count; ++i) sum += places[from_front[i]];
    return sum / static_cast<double>(count);
  };
  std::vector<RailShift> shifts;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double bogie = middle(i - i % size, size);
    const double level =
        test.vehicle * (bogie - middle(0, places.size())) + test.bogie * (places[from_front[i]] - bogie);
    for (const bool left : {true, false}) {
      RailShift& shift = shifts.emplace_back();
      shift.wheelset = static_cast<int>(from_front[i]);
      shift.left = left;
      const double most = left ? -0.5 * level : 0.5 * level;  // the left rail rises
      // points of rest before and behind: a run begins on rails that do not move yet
      shift.time = {-0.25 * test.period, 0.0, 0.25 * test.period, 0.75 * test.period, test.period, 1.25 * test.period};
      shift.displacement = {0.0, 0.0, most, -most, 0.0, 0.0};
    }
  }
  return shifts;
}

}  // namespace treadmark
