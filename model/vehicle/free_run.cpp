// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/free_run.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

/// A train as a point that turns its wheels.
class Point {
 public:
  Point(const FreeRun& run, const DrivenTrain& driven) : run_(run), driven_(driven) {
    for (const BodySpec& body : driven.train.bodies) mass_ += body.mass;
    for (const WheelsetSpec& w : driven.train.wheelsets) {
      const BodySpec& body = *ranges::find(driven.train.bodies, w.body, &BodySpec::name);
      if (body.free.at(static_cast<std::size_t>(Freedom::pitch)))
        inertia_ += body.inertia.y() / (w.nominal_radius * w.nominal_radius);
    }
    inertia_ += mass_;
  }

  /// distance: travelled [m].
  double acceleration(double time, double distance, double speed) const {
    double force = -resistance_at(run_, speed);
    for (const AxleTorque& t : driven_.torques)
      force += torque_at(t, time) / driven_.train.wheelsets.at(static_cast<std::size_t>(t.wheelset)).nominal_radius;
    for (const BodyForce& f : driven_.forces)
      if (f.direction == Freedom::x) force += force_at(f, time);
    if (!run_.place.empty())
      for (const BodySpec& body : driven_.train.bodies)
        force -= driven_.gravity * body.mass * gradient_at(run_, driven_.start + distance + body.position.x());
    return force / inertia_;
  }

 private:
  const FreeRun& run_;
  const DrivenTrain& driven_;
  double mass_ = 0.0, inertia_ = 0.0;
};

}  // namespace

double gradient_at(const FreeRun& run, double place) {
  return run.place.empty() ? 0.0 : BrokenLine(run.place, run.gradient).held_at(place);
}

double resistance_at(const FreeRun& run, double speed) {
  return run.resistance + speed * (run.by_speed + speed * run.by_square);
}

SpeedProfile free_speed(const FreeRun& run, const DrivenTrain& driven, double speed, double distance) {
  constexpr double kStep = 0.1;      // [s], against forces that change within seconds
  constexpr double kFirst = 1e-6;    // [s], so that at the start, which is a balance, it accelerates as forces are then
  constexpr double kSlowest = 0.05;  // [m/s]
  constexpr std::size_t kMost = 1'000'000;
  const Point train(run, driven);
  SpeedProfile out = constant_speed(speed);
  out.distance = {0.0};
  while (out.distance.back() < distance) {
    const double t = out.time.back(), v = out.speed.back(), s = out.distance.back(), h = t > 0.0 ? kStep : kFirst;
    // Runge and Kutta's method of fourth order.
    const double a1 = train.acceleration(t, s, v), v2 = v + 0.5 * h * a1;
    const double a2 = train.acceleration(t + 0.5 * h, s + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
    const double a3 = train.acceleration(t + 0.5 * h, s + 0.5 * h * v2, v3), v4 = v + h * a3;
    const double a4 = train.acceleration(t + h, s + h * v3, v4);
    const double next = v + h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    if (!(next > kSlowest) || out.time.size() > kMost)
      throw Error(ErrorKind::configuration, fmt::format("the train comes to rest after {:.6g} s and {:.6g} m", t, s),
                  {}, "shorten the run (simulation.distance_m), or drive it on (simulation.torques)");
    out.time.push_back(t + h);
    out.speed.push_back(next);
    out.distance.push_back(s + 0.5 * h * (v + next));
  }
  return out;
}

}  // namespace treadmark
