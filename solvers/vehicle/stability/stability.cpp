// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/stability/stability.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"

namespace treadmark::vehicle {
namespace {

void require_sense(const StabilitySettings& s) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::configuration, what); };
  if (s.speeds.empty()) refuse("stability needs a speed");
  for (std::size_t i = 0; i < s.speeds.size(); ++i)
    if (!std::isfinite(s.speeds[i]) || !(s.speeds[i] > (i > 0 ? s.speeds[i - 1] : 0.0)))
      refuse(fmt::format("speeds must be positive and increase; number {} is {:g} m/s", i + 1, s.speeds[i]));
  if (!(s.speed_tolerance > 0.0) || !(s.neutral >= 0.0))
    refuse("the tolerance of the critical speed must be positive, and what counts as no growth must not be negative");
}

/// How much two shapes are the same, 0 ... 1 (modal assurance criterion).
double likeness(const Eigenmode& a, const Eigenmode& b) {
  const double product = std::abs(a.shape.dot(b.shape)), lengths = a.shape.squaredNorm() * b.shape.squaredNorm();
  return product * product / lengths;
}

/// Numbers of the motions at a speed: those of the nearest ones at the speed before, new ones for what has none there.
void follow(const ModesAtSpeed& before, ModesAtSpeed& now, int& next) {
  constexpr double kNear = 1.0;
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < before.modes.size(); ++i)
    for (std::size_t j = 0; j < now.modes.size(); ++j) {
      const Eigenmode &a = before.modes[i], &b = now.modes[j];
      if ((a.frequency > 0.0) != (b.frequency > 0.0)) continue;
      const double apart = std::abs(a.value - b.value) / (1.0 + std::min(std::abs(a.value), std::abs(b.value)));
      if (apart > kNear) continue;
      const double distance = apart + 1.0 - likeness(a, b);
      if (distance < kNear) pairs.emplace_back(distance, i, j);
    }
  ranges::sort(pairs);
  now.branch.assign(now.modes.size(), -1);
  std::vector<bool> taken(before.modes.size(), false);
  for (const auto& [distance, i, j] : pairs) {
    if (taken[i] || now.branch[j] >= 0) continue;
    taken[i] = true;
    now.branch[j] = before.branch[i];
  }
  for (int& branch : now.branch)
    if (branch < 0) branch = next++;
}

CriticalSpeed bisect(const VehicleAtSpeed& vehicle, double stable, ModesAtSpeed beyond,
                     const StabilitySettings& settings) {
  while (beyond.speed - stable > settings.speed_tolerance) {
    const double middle = 0.5 * (stable + beyond.speed);
    if (!(middle > stable && middle < beyond.speed)) break;
    ModesAtSpeed found = modes_at_speed(vehicle, middle, settings.neutral);
    if (found.report.status != Status::ok) break;
    if (found.fastest_growth)
      beyond = std::move(found);
    else
      stable = middle;
  }
  const double half = 0.5 * (beyond.speed - stable);
  return {stable + half, half, std::move(beyond)};
}

}  // namespace

ModesAtSpeed modes_at_speed(const VehicleAtSpeed& vehicle, double speed, double neutral) {
  check_cancelled();
  const VehicleOnTrack v = vehicle(speed);
  const Equilibrium equilibrium = find_equilibrium(v);
  ModesAtSpeed out;
  out.speed = speed;
  out.report = equilibrium.report;
  out.residual = equilibrium.residual;
  if (out.report.status != Status::ok) return out;
  out.modes = all_eigenmodes(v, equilibrium.state);
  for (std::size_t i = 0; i < out.modes.size(); ++i) {
    const Eigenmode& m = out.modes[i];
    if (m.frequency > 0.0 && (!out.least_damped || m.damping_ratio < out.modes[*out.least_damped].damping_ratio))
      out.least_damped = i;
    if (m.value.real() > neutral &&
        (!out.fastest_growth || m.value.real() > out.modes[*out.fastest_growth].value.real()))
      out.fastest_growth = i;
  }
  return out;
}

StabilityResult stability(const VehicleAtSpeed& vehicle, const StabilitySettings& settings) {
  require_sense(settings);
  StabilityResult result;
  int next = 0;
  const ModesAtSpeed none;
  for (const double speed : settings.speeds) {
    result.at.push_back(modes_at_speed(vehicle, speed, settings.neutral));
    follow(result.at.size() > 1 ? result.at[result.at.size() - 2] : none, result.at.back(), next);
  }
  const auto changes = ranges::find_if(
      result.at, [](const ModesAtSpeed& m) { return m.report.status != Status::ok || m.fastest_growth; });
  if (changes == result.at.end()) {
    result.verdict = StabilityVerdict::stable;
  } else if (changes->report.status == Status::ok) {
    result.verdict = changes == result.at.begin() ? StabilityVerdict::unstable : StabilityVerdict::critical;
    if (changes != result.at.begin()) result.critical = bisect(vehicle, std::prev(changes)->speed, *changes, settings);
  }
  return result;
}

}  // namespace treadmark::vehicle
