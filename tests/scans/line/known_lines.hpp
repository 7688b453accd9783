// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans::tests {

/// The frame of a rail at a place along its line [m].
using Frames = std::function<Pose(double)>;

/// A circle to the right (curvature > 0) in a plane that is tilted by the cant: in closed form.
inline Frames circle(double curvature, double cant_angle = 0.0) {
  return [=](double s) {
    const double psi = curvature * s;
    const Vec3 origin =
        curvature == 0.0 ? Vec3(s, 0.0, 0.0) : Vec3(std::sin(psi) / curvature, (1.0 - std::cos(psi)) / curvature, 0.0);
    return Pose{origin, rotation_z(psi) * rotation_x(cant_angle)};
  };
}

/// A straight until `begin`, a clothoid of this length into a circle, with a ramp of the cant beside it; the heading in
/// closed form, places by Simpson's rule in steps of a centimetre (error far below a micrometre).
struct Clothoid {
  double begin = 0.0, length = 1.0, curvature = 0.0, cant_angle = 0.0;

  double bend(double s) const { return curvature * share(s); }
  double share(double s) const { return s < begin ? 0.0 : s > begin + length ? 1.0 : (s - begin) / length; }
  double heading(double s) const {
    if (s < begin) return 0.0;
    const double on = s - begin;
    return on < length ? 0.5 * curvature * on * on / length : curvature * (on - 0.5 * length);
  }
  Vec2 direction(double s) const { return {std::cos(heading(s)), std::sin(heading(s))}; }
  Frames frames(double from, double to) const {
    constexpr double kStep = 0.01;
    std::vector<Vec2> places{Vec2::Zero()};
    const int count = static_cast<int>(std::ceil((to - from) / kStep)) + 1;
    for (int k = 0; k < count; ++k) {
      const double s = from + k * kStep;
      places.push_back(places.back() +
                       kStep / 6.0 * (direction(s) + 4.0 * direction(s + 0.5 * kStep) + direction(s + kStep)));
    }
    return [*this, from, places](double s) {
      const int k = static_cast<int>(std::floor((s - from) / kStep));
      const double at = from + k * kStep, rest = s - at;
      const Vec2 p = places.at(static_cast<std::size_t>(k)) +
                     rest / 6.0 * (direction(at) + 4.0 * direction(at + 0.5 * rest) + direction(s));
      return Pose{Vec3(p.x(), p.y(), 0.0), rotation_z(heading(s)) * rotation_x(cant_angle * share(s))};
    };
  }
};

/// Points of a straight rail along x laid along a line.
inline std::vector<Vec3> bent(const std::vector<Vec3>& straight, const Frames& frames, const Pose& X_CL = {}) {
  std::vector<Vec3> out;
  out.reserve(straight.size());
  for (const Vec3& p : straight) out.push_back(X_CL.apply(frames(p.x()).apply({0.0, p.y(), p.z()})));
  return out;
}

}  // namespace treadmark::scans::tests
