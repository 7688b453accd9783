// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/model/shape/defects.hpp"
#include "treadmark/tests/backends/analytic/brute_force.hpp"

namespace treadmark::testing {

/// A rail of one big arc, R 80 mm, milled by a cutter of one arc, R 60 mm, that sinks and moves aside along a path of
/// two stations, hence straight, or of three, and rolls. The formulas know nothing of chains and splines.
struct MilledRail {
  static constexpr double kRail = 0.08, kCutter = 0.06, kHalf = 0.4;  ///< radii, half angle of the cutter section
  bool curved = false;

  static ArcChain rail() { return analytic::cylinder_chain(kRail, 0.8); }
  MillingPath path() const {
    MillingPath m;
    m.stations = {{-0.05, -0.010, -0.002, -0.05}, {0.05, 0.006, 0.003, 0.03}};
    if (curved) m.stations.push_back({0.13, 0.004, 0.0, 0.01});
    m.start_y = -kCutter * std::sin(kHalf);
    m.start_z = kCutter * (1.0 - std::cos(kHalf));
    m.start_angle = -kHalf;
    m.section = {{2.0 * kCutter * kHalf, 1.0 / kCutter}};
    return m;
  }
  double x_end() const { return curved ? 0.13 : 0.05; }

  struct At {
    double y, z, roll;
  };
  At at(double x) const {
    const auto m = path();
    const auto value = [&](auto member) {
      const double a = m.stations[0].*member, b = m.stations[1].*member;
      if (!curved) return a + (b - a) * (x + 0.05) / 0.1;
      // natural cubic spline of three points: one unknown second derivative in the middle
      const double c = m.stations[2].*member, h = 0.1, k = 0.08;
      const double M = 6.0 * ((c - b) / k - (b - a) / h) / (2.0 * (h + k));
      if (x < 0.05) {
        const double t = x + 0.05;
        return a + t * ((b - a) / h - M * h / 6.0) + M * t * t * t / (6.0 * h);
      }
      const double t = 0.13 - x;
      return c + t * ((b - c) / k - M * k / 6.0) + M * t * t * t / (6.0 * k);
    };
    return {value(&MillingPath::Station::y), value(&MillingPath::Station::z), value(&MillingPath::Station::roll)};
  }

  /// > 0 inside of the removed volume.
  double removed(const Vec3& p) const {
    const double along = std::min(p.x() + 0.05, x_end() - p.x());
    if (along <= 0.0) return along;
    const At a = at(p.x());
    const double e_y = p.y() - a.y, e_z = p.z() - a.z;
    const double s = std::cos(a.roll) * e_y + std::sin(a.roll) * e_z,
                 q = std::cos(a.roll) * e_z - std::sin(a.roll) * e_y;
    const double ends = kCutter * std::sin(kHalf) - std::fabs(s);
    if (ends <= 0.0) return ends;
    return std::min({kCutter - std::sqrt(kCutter * kCutter - s * s) - q, ends, along});
  }
  Outside outside() const {
    return [this](const Vec3& p) {
      const double w = kRail * std::sin(0.8);
      if (std::fabs(p.y()) > w) return std::numeric_limits<double>::quiet_NaN();
      return std::max(kRail - std::sqrt(kRail * kRail - p.y() * p.y()) - p.z(), removed(p));
    };
  }
  std::vector<Pose> planes() const {
    const auto pose = [](double x, double y, double z, double roll, double yaw, double pitch) {
      return Pose{{x, y, z}, rotation({roll, yaw, pitch})};
    };
    return {pose(0.0, 0.0, 0.0, 0.0, 0.0, 0.0),        pose(0.01, 0.002, 0.001, 0.2, 0.0, 0.0),
            pose(0.02, -0.004, 0.0, -0.3, 0.1, -0.05), pose(0.0, 0.0, 0.0, 0.5, -1.2, 0.2),
            pose(0.01, -0.01, 0.004, -0.9, 0.3, 0.1),  pose(-0.02, 0.01, 0.004, 1.0, 0.7, -0.6)};
  }
};

}  // namespace treadmark::testing
