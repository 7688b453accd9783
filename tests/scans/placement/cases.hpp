// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/scans/placement/elements.hpp"
#include "treadmark/scans/placement/rough_axis.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans::tests {

inline constexpr double kPi = std::numbers::pi;

/// The Error of a call, if it throws one.
template <class Call>
std::optional<Error> error_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

/// A smooth section in closed form: a flange about 28 mm high at negative y, as steep as 60 degrees, and a gently
/// sloping tread.
inline double flanged(double y) { return 14e-3 * (1.0 - std::tanh((y + 35e-3) / 8e-3)) - 0.025 * y; }
inline double flanged_slope(double y) { return -14.0 / 8.0 / std::pow(std::cosh((y + 35e-3) / 8e-3), 2) - 0.025; }

inline std::vector<Vec2> flanged_points(double y_min = -65e-3, double y_max = 60e-3, double step = 0.5e-3) {
  std::vector<Vec2> out;
  const int count = static_cast<int>(std::lround((y_max - y_min) / step));
  for (int k = 0; k <= count; ++k) out.emplace_back(y_min + k * step, flanged(y_min + k * step));
  return out;
}

inline Vec3 gaussian_vector(Random& random) {
  const double x = gaussian(random), y = gaussian(random);
  return {x, y, gaussian(random)};
}

inline Vec3 in_cube(Random& random, double half) {
  const double x = random.uniform(), y = random.uniform();
  return half * Vec3(2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * random.uniform() - 1.0);
}

/// Normals off by noise [rad].
inline void add_element(SurfaceElements& elements, const Pose& X, const Vec3& p, const Vec3& n, double noise,
                        Random& random) {
  elements.position.push_back(X.apply(p));
  elements.normal.push_back((X.rotation * (n + noise * gaussian_vector(random))).normalized() *
                            (random.uniform() < 0.5 ? 1.0 : -1.0));
  elements.weight.push_back(1.0f);
}

/// Elements with the exact normals of the flanged section turned about y (revolution) or swept along x, but for noise
/// [rad]; foreign: part of them that are of anything else nearby.
inline SurfaceElements flanged_elements(Body body, double extent, double foreign, double noise, const Pose& X,
                                        std::uint64_t seed, int count = 3000) {
  constexpr double kRadius = 0.45;
  Random random(seed);
  SurfaceElements out;
  const double chord =
      body == Body::wheel ? (extent < kPi ? 2.0 * kRadius * std::sin(0.5 * extent) : 2.0 * kRadius) : extent;
  out.radius = 0.5 * std::hypot(chord, 0.12);
  const Vec3 middle = body == Body::wheel && extent < kPi ? Vec3(0.0, 0.0, kRadius) : Vec3::Zero();
  out.centre = X.apply(middle);
  for (int k = 0; k < count; ++k) {
    const double u = (random.uniform() - 0.5) * extent, y = -65e-3 + 0.125 * random.uniform();
    const double slope = flanged_slope(y), h = std::hypot(1.0, slope);
    Vec3 p, n;
    if (random.uniform() < foreign) {
      p = middle + in_cube(random, out.radius);
      n = gaussian_vector(random).normalized();
    } else if (body == Body::wheel) {
      const double r = kRadius + flanged(y);
      p = {r * std::sin(u), y, r * std::cos(u)};
      n = Vec3(std::sin(u), -slope, std::cos(u)) / h;
    } else {
      p = {u, y, -flanged(y)};
      n = Vec3(0.0, -slope, -1.0) / h;
    }
    add_element(out, X, p, n, noise, random);
  }
  return out;
}

/// Angle between two lines and how far apart they are where the first one's point lies.
struct AxisError {
  double angle, distance;
};
inline AxisError axis_error(const Axis& found, const Vec3& point, const Vec3& direction) {
  const Vec3 apart = point - found.point;
  return {std::asin(std::min(1.0, found.direction.cross(direction).norm())),
          (apart - found.direction * found.direction.dot(apart)).norm()};
}

}  // namespace treadmark::scans::tests
