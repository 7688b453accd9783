// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <functional>
#include <random>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::spline::testing {

inline constexpr double kRadius = 0.46;  ///< of wheels [m]

/// Points of z(y) at n positions from y0 to y1, interpolated.
inline Profile graph_profile(Body body, double y0, double y1, int n, const std::function<double(double)>& z) {
  Profile profile;
  profile.body = body;
  profile.name = "graph";
  for (int i = 0; i < n; ++i) {
    profile.y.push_back(y0 + (y1 - y0) * i / (n - 1));
    profile.z.push_back(z(profile.y.back()));
  }
  return profile;
}

/// A rail head of 0.3 m crown radius with round corners of 13 mm and upright, slightly undercut sides.
inline Profile rail_head() {
  Profile profile;
  profile.body = Body::rail;
  profile.name = "rail head";
  const double crown = 0.3, corner = 13e-3, half = 24e-3, undercut = 0.15;
  const double side_angle = std::asin(half / crown), end = std::acos(-1.0) / 2 + undercut;
  std::vector<Vec2> right;
  for (double a = 0.0; a < side_angle; a += 1e-3 / crown)
    right.push_back({crown * std::sin(a), crown * (1 - std::cos(a))});
  const Vec2 centre((crown - corner) * std::sin(side_angle), crown - (crown - corner) * std::cos(side_angle));
  for (int i = 0; i <= 40; ++i) {
    const double a = side_angle + (end - side_angle) * i / 40;
    right.push_back(centre + corner * Vec2(std::sin(a), -std::cos(a)));
  }
  const Vec2 down(-std::sin(undercut), std::cos(undercut));
  const Vec2 last = right.back();
  for (int i = 1; i <= 10; ++i) right.push_back(last + 1e-3 * i * down);
  for (std::size_t i = right.size(); i-- > 1;) profile.y.push_back(-right[i].x()), profile.z.push_back(right[i].y());
  for (const Vec2& p : right) profile.y.push_back(p.x()), profile.z.push_back(p.y());
  return profile;
}

/// A wheel with a coned tread and a flange, points with decreasing y about 1 mm apart.
inline double flanged_wheel_z(double y) {
  const double flange = 28e-3 / (1.0 + std::exp((y + 45e-3) / 4e-3));
  const double back = 6e-3 * std::max(0.0, (-y - 60e-3) / 10e-3) * std::max(0.0, (-y - 60e-3) / 10e-3);
  return -y / 40.0 + flange - back;
}
inline Profile flanged_wheel(int points = 140) {
  return graph_profile(Body::wheel, 60e-3, -70e-3, points, flanged_wheel_z);
}

/// Slices of a wheel with a smooth dent of the given depth round theta_0, all round.
inline SliceSet dented_wheel(double depth = 1e-3, double theta_0 = 0.6, bool approximate = false, int slices = 180) {
  SliceSet set;
  set.body = Body::wheel;
  set.name = "dented wheel";
  set.approximate_u = approximate;
  const double pi = std::acos(-1.0);
  for (int i = 0; i < slices; ++i) {
    const double theta = -pi + 2 * pi * (i + 0.5) / slices;
    set.u.push_back(theta);
    set.profiles.push_back(graph_profile(Body::wheel, 60e-3, -70e-3, 140, [=](double y) {
      const double a = (theta - theta_0) / 0.12, b = (y - 5e-3) / 25e-3;
      return flanged_wheel_z(y) - depth * std::exp(-a * a - b * b);
    }));
  }
  return set;
}

/// Slices of a rail whose head bends to the right, sinks and widens with x.
inline SliceSet bending_rail(bool approximate = false) {
  SliceSet set;
  set.body = Body::rail;
  set.name = "bending rail";
  set.approximate_u = approximate;
  for (int i = 0; i < 30; ++i) {
    const double x = -0.3 + 0.02 * i + 0.004 * std::sin(2.0 * i);
    set.u.push_back(x);
    Profile head = rail_head();
    for (double& y : head.y) y = y * (1.0 + 0.1 * x) + 0.02 * x * x;
    for (std::size_t k = 0; k < head.z.size(); ++k) head.z[k] += 2e-3 * std::sin(5.0 * x);
    set.profiles.push_back(head);
  }
  return set;
}

inline Pose random_pose(std::mt19937& random, double roll, double yaw, double pitch, double shift) {
  std::uniform_real_distribution<double> d(-1.0, 1.0);
  Pose pose;
  pose.rotation = rotation({roll * d(random), yaw * d(random), pitch * d(random)});
  pose.origin = shift * Vec3(d(random), d(random), d(random));
  return pose;
}

}  // namespace treadmark::spline::testing
