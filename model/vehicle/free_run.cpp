// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/free_run.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

const BodySpec& body_of(const VehicleModel& train, const WheelsetSpec& wheelset) {
  return *ranges::find(train.bodies, wheelset.body, &BodySpec::name);
}

/// What of 1 N or 1 N m drives a train [N]: 0: not along x.
double driving(const DrivenTrain& driven, const BodyForce& force) {
  if (force.direction == Freedom::x) return 1.0;
  if (force.direction != Freedom::pitch) return 0.0;
  const auto axle = ranges::find(driven.train.wheelsets, force.body, &WheelsetSpec::body);
  return axle == driven.train.wheelsets.end() ? 0.0
                                              : -1.0 / axle->nominal_radius;  // axles roll on with a negative rate
}

/// Of gradients on a train that goes from one place to another, as a mean over the way [N]. Forward: from < to.
double held_back(const FreeRun& run, const DrivenTrain& driven, double from, double to) {
  if (run.place.empty()) return 0.0;
  const BrokenLine line(run.place, run.gradient);
  double sum = 0.0;
  for (const BodySpec& body : driven.train.bodies) {
    const double below = driven.start + body.position.x();
    sum += body.mass * line.held_integral(below + from, below + to);
  }
  return driven.gravity * sum / (to - from);
}

/// Speed after so long under a force beside the resistance: Runge and Kutta's method of fourth order.
double speed_after(const FreeRun& run, double mass, double force, double v, double h) {
  const auto acceleration = [&](double speed) { return (force - resistance_at(run, speed)) / mass; };
  const double a1 = acceleration(v), a2 = acceleration(v + 0.5 * h * a1), a3 = acceleration(v + 0.5 * h * a2),
               a4 = acceleration(v + h * a3);
  return v + h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
}

}  // namespace

double gradient_at(const FreeRun& run, double place) {
  return run.place.empty() ? 0.0 : BrokenLine(run.place, run.gradient).held_at(place);
}

double resistance_at(const FreeRun& run, double speed) {
  return run.resistance + speed * (run.by_speed + speed * run.by_square);
}

double running_mass(const VehicleModel& train) {
  double mass = 0.0;
  for (const BodySpec& body : train.bodies) mass += body.mass;
  for (const WheelsetSpec& w : train.wheelsets)
    if (const BodySpec& body = body_of(train, w); body.free.at(static_cast<std::size_t>(Freedom::pitch)))
      mass += body.inertia.y() / (w.nominal_radius * w.nominal_radius);
  return mass;
}

double impulse(const DrivenTrain& driven, double from, double to) {
  double sum = 0.0;
  for (const AxleTorque& t : driven.torques)
    sum += BrokenLine(t.time, t.torque).held_integral(from, to) /
           driven.train.wheelsets.at(static_cast<std::size_t>(t.wheelset)).nominal_radius;
  for (const BodyForce& f : driven.forces)
    if (const double along = driving(driven, f); along != 0.0)
      sum += along * BrokenLine(f.time, f.force).held_integral(from, to);
  return sum;
}

std::vector<double> points_in_time(const DrivenTrain& driven) {
  std::vector<double> times;
  for (const AxleTorque& t : driven.torques) times.insert(times.end(), t.time.begin(), t.time.end());
  for (const BodyForce& f : driven.forces)
    if (driving(driven, f) != 0.0) times.insert(times.end(), f.time.begin(), f.time.end());
  ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

SpeedProfile free_speed(const FreeRun& run, const DrivenTrain& driven, double speed, double distance) {
  constexpr double kStep = 0.1;  // the longest one [s]
  // [s], so that at the start, which is a balance, it accelerates as forces are then; points that are as near are one
  constexpr double kFirst = 1e-6;
  constexpr double kSlowest = 0.05;  // [m/s]
  constexpr std::size_t kMost = 1'000'000;
  constexpr int kRounds = 3;  // for the way that gradients hold back along: the last one changes it by picometres
  const double mass = running_mass(driven.train);
  const std::vector<double> points = points_in_time(driven);
  SpeedProfile out = constant_speed(speed);
  out.distance = {0.0};
  while (out.distance.back() < distance) {
    const double t = out.time.back(), v = out.speed.back(), s = out.distance.back();
    const auto point = std::upper_bound(points.begin(), points.end(), t + kFirst);
    double end = t > 0.0 ? t + kStep : kFirst;
    if (t > 0.0 && point != points.end()) end = std::min(end, *point);
    const double h = end - t, force = impulse(driven, t, end) / h;
    double next = v, way = h * v;
    for (int i = 0; i < kRounds; ++i) {
      next = speed_after(run, mass, force - held_back(run, driven, s, s + way), v, h);
      way = 0.5 * h * (v + next);
    }
    if (!(next > kSlowest))
      throw Error(ErrorKind::configuration, fmt::format("the train comes to rest after {:.6g} s and {:.6g} m", t, s),
                  {}, "shorten the run (simulation.distance_m), or drive it on (simulation.torques)");
    if (out.time.size() > kMost)
      throw Error(ErrorKind::configuration, fmt::format("the speed has more than {} points within {:.6g} m", kMost, s),
                  {}, "shorten the run (simulation.distance_m), or give torques and forces at fewer times");
    out.time.push_back(end);
    out.speed.push_back(next);
    out.distance.push_back(s + way);
  }
  return out;
}

bool is_another_speed(double speed, double wanted) {
  constexpr double kShare = 0.01, kNothing = 0.01;  // [m/s]
  return !(std::abs(speed - wanted) <= std::max(kShare * wanted, kNothing));
}

}  // namespace treadmark
