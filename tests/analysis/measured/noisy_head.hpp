// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measured::testing {

/// The arcs of a rail head: radius up to the distance from the middle [m]. Then a straight side.
inline constexpr double kRadii[] = {0.300, 0.080, 0.013}, kEnds[] = {0.010, 0.026, 0.0358};

/// z of the head at y, and dz/dy there.
struct HeadPoint {
  double z = 0.0, slope = 0.0;
};
inline HeadPoint head_at(double y) {
  double from = 0.0, sine = 0.0, z = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double to = std::min(std::fabs(y), kEnds[k]);
    const double next = sine + (to - from) / kRadii[k];
    z += kRadii[k] * (std::sqrt(1.0 - sine * sine) - std::sqrt(1.0 - next * next));
    from = to, sine = next;
  }
  return {z, std::copysign(sine / std::sqrt(1.0 - sine * sine), y)};
}

/// Points of the head at equal steps of y.
inline Profile head(double step) {
  Profile p;
  const int half = static_cast<int>(std::floor(kEnds[2] / step));
  for (int i = -half; i <= half; ++i) p.y.push_back(i * step), p.z.push_back(head_at(i * step).z);
  return p;
}

/// Normal noise in z.
inline Profile with_noise(Profile p, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, noise);
  for (double& z : p.z) z += normal(random);
  return p;
}

/// z in whole units, from a height that is none.
inline Profile rounded(Profile p, double unit) {
  for (double& z : p.z) z = unit * std::round((z + 0.312345e-3) / unit);
  return p;
}

}  // namespace treadmark::measured::testing
