// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::scans::tests {

inline constexpr double kWheelRadius = 0.46;  ///< of sample wheels [m]

/// Standard normal numbers (Box and Muller 1958).
inline double gaussian(Random& random) {
  return std::sqrt(-2.0 * std::log(1.0 - random.uniform())) * std::cos(2.0 * std::numbers::pi * random.uniform());
}

struct SimpleCloud {
  std::vector<Vec3> points_S;
  std::vector<Vec3> points_C;
  Pose X_CS;
};

/// Points of a surface at random stations of [u_min, u_max] and on a grid of y, moved along their normals by noise;
/// outliers: part of the points that lie anywhere within 0.2 m of where they should.
inline SimpleCloud simple_cloud(const Surface& surface, Body body, double u_min, double u_max, double y_min,
                                double y_max, int stations, int across, double noise, double outliers, const Pose& X_CS,
                                std::uint64_t seed = 1) {
  SimpleCloud out;
  out.X_CS = X_CS;
  Random random(seed);
  std::vector<double> y(static_cast<std::size_t>(across)), h(y.size()), slope(y.size());
  for (int i = 0; i < stations; ++i) {
    const double u = u_min + (u_max - u_min) * random.uniform();
    for (int k = 0; k < across; ++k)
      y[static_cast<std::size_t>(k)] = y_min + (y_max - y_min) * (k + random.uniform()) / across;
    HeightsOut heights;
    heights.z = h;
    heights.dzdy = slope;
    section_heights(surface, body, u, y, heights);
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (std::isnan(h[k])) continue;
      const double off = noise * gaussian(random), n = std::hypot(1.0, slope[k]);
      // out of the material: -z of a rail, +r of a wheel
      const double sign = body == Body::rail ? -1.0 : 1.0;
      const double yy = y[k] - sign * off * slope[k] / n, hh = h[k] + sign * off / n;
      Vec3 p = body == Body::rail ? Vec3(u, yy, hh) : Vec3(hh * std::sin(u), yy, hh * std::cos(u));
      if (random.uniform() < outliers)
        p += 0.4 * Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5);
      out.points_S.push_back(p);
      out.points_C.push_back(X_CS.apply(p));
    }
  }
  return out;
}

inline Pose some_frame(std::uint64_t seed) {
  Random random(seed);
  const Vec3 axis = Vec3(gaussian(random), gaussian(random), gaussian(random)).normalized();
  const double angle = 2.0 * std::numbers::pi * random.uniform();
  return {Vec3(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5),
          Mat3(Eigen::AngleAxisd(angle, axis))};
}

/// A nominal profile as a section: v = z of a wheel, -z of a rail.
inline std::vector<Vec2> nominal_points(const char* name, Body body) {
  const double radius = body == Body::wheel ? 0.5 : 0.0;
  const auto surface = create_surface({body, radius, StandardProfile{name}, {}});
  std::vector<double> y, h;
  for (double at = -80e-3; at <= 80e-3; at += 0.25e-3) y.push_back(at);
  h.resize(y.size());
  HeightsOut out;
  out.z = h;
  section_heights(*surface, body, 0.0, y, out);
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < y.size(); ++k)
    if (!std::isnan(h[k])) points.emplace_back(y[k], body == Body::wheel ? h[k] - radius : -h[k]);
  return points;
}

}  // namespace treadmark::scans::tests
