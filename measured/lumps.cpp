// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/measured/lumps.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "treadmark/core/pose.hpp"

namespace treadmark::measured {
namespace {

constexpr std::size_t kBeside = 6;  ///< points of the profile to each side

/// Parabola through the points beside first ... last in the axes of the chord; the greatest deviation of those between,
/// with its sign, and the rms of those beside.
struct Deviation {
  double greatest = 0.0, beside = 0.0;
  double turn = 0.0;  ///< between the ways before and behind [rad]
};

Deviation deviation(const Profile& p, std::size_t first, std::size_t last) {
  const std::size_t from = first - kBeside, to = last + kBeside;
  const auto at = [&](std::size_t i) { return Vec2(p.y[i], p.z[i]); };
  const Vec2 origin = at(from), along = (at(to) - origin).normalized(), across(-along.y(), along.x());
  const double length = (at(to) - origin).norm();
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const auto row = [&](std::size_t i) {
    const double t = (at(i) - origin).dot(along) / length - 0.5;
    return Eigen::Vector3d(1.0, t, t * t);
  };
  const auto height = [&](std::size_t i) { return (at(i) - origin).dot(across); };
  for (std::size_t i = from; i <= to; ++i) {
    if (i >= first && i <= last) continue;
    normal += row(i) * row(i).transpose();
    right += row(i) * height(i);
  }
  const Eigen::Vector3d c = normal.ldlt().solve(right);
  Deviation out;
  for (std::size_t i = from; i <= to; ++i) {
    const double d = height(i) - c.dot(row(i));
    if (i < first || i > last)
      out.beside += d * d / static_cast<double>(2 * kBeside);
    else if (std::fabs(d) > std::fabs(out.greatest))
      out.greatest = d;
  }
  out.beside = std::sqrt(out.beside);
  const Vec2 before = at(first - 1) - at(from), behind = at(to) - at(last + 1);
  out.turn = std::fabs(std::atan2(before.x() * behind.y() - before.y() * behind.x(), before.dot(behind)));
  return out;
}

}  // namespace

std::optional<Lump> highest_lump(const Profile& p, double noise, bool narrow) {
  constexpr std::size_t kMostPoints = 6;
  constexpr double kWidest = 3e-3, kWidestOfThree = 4.5e-3, kLeast = 0.1e-3, kTimesNoise = 8.0, kTimesBeside = 6.0;
  constexpr double kStraight = 0.35;  // [rad]
  std::optional<Lump> best;
  for (std::size_t first = kBeside; first + kBeside < p.y.size(); ++first)
    for (std::size_t last = first; last < first + kMostPoints && last + kBeside < p.y.size(); ++last) {
      const double width = std::hypot(p.y[last + 1] - p.y[first - 1], p.z[last + 1] - p.z[first - 1]);
      if (width > kWidestOfThree) break;
      if (width > kWidest && (narrow || last - first != 2)) continue;
      const Deviation d = deviation(p, first, last);
      const double size = std::fabs(d.greatest);
      if (size < std::max({kLeast, kTimesNoise * noise, kTimesBeside * d.beside}) || d.turn > kStraight) continue;
      if (best && size <= std::fabs(best->height)) continue;
      // a rail runs with growing y, so that out of its material is to the left of the way; a wheel likewise
      best = Lump{first, last, -d.greatest};
    }
  return best;
}

}  // namespace treadmark::measured
