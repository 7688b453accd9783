// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/strays/mixed_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/core/median.hpp"

namespace treadmark::scans {
namespace {

/// Two points as their scanner sees them.
struct BeamStep {
  double angle = 0.0;  ///< between their beams [rad]
  double along = 0.0;  ///< what one is farther away than the other, any unit
  double apart = 0.0;
};

std::optional<BeamStep> step_between(const PointCloud& cloud, std::size_t from, std::size_t to) {
  if (!cloud.passes.empty() && cloud.passes[from] != cloud.passes[to]) return std::nullopt;
  const Vec3* const station = station_of(cloud, from);
  if (station == nullptr) return std::nullopt;
  const Vec3 a = cloud.points[from] - *station, b = cloud.points[to] - *station;
  if (!(a.norm() > 0.0 && b.norm() > 0.0)) return std::nullopt;
  return BeamStep{std::atan2(a.cross(b).norm(), a.dot(b)), std::fabs(b.norm() - a.norm()), (b - a).norm()};
}

}  // namespace

MixedPoints find_mixed_points(const PointCloud& cloud) {
  constexpr std::size_t kMostLooked = 200'000, kFewest = 100;
  constexpr double kOrdered = 0.05;               // of the angle between any two points
  constexpr double kNextBeams = 6.0, kFar = 8.0;  // usual steps
  constexpr double kAlongBeam = 0.9848;           // cosine of 10 degrees
  MixedPoints out;
  const std::size_t count = cloud.points.size();
  if (cloud.stations.empty() || count < kFewest) return out;
  std::vector<double> angles, along, any;
  for (std::size_t i = 0; i + 1 < count; i += 1 + count / kMostLooked) {
    if (const auto step = step_between(cloud, i, i + 1)) angles.push_back(step->angle), along.push_back(step->along);
    if (const auto step = step_between(cloud, i, (i + count / 2) % count)) any.push_back(step->angle);
  }
  // of several scans hardly any two points half of all apart are of the same one
  if (any.size() < kFewest)
    for (std::size_t i = 0, far = count / 50; i + far < count; i += 1 + count / kMostLooked)
      if (const auto step = step_between(cloud, i, i + far)) any.push_back(step->angle);
  if (angles.size() < kFewest || any.size() < kFewest) return out;
  const double next = median_of(angles), usual = median_of(along);
  out.in_order = next < kOrdered * median_of(any);
  if (!out.in_order) return out;
  out.of_point.assign(count, 0);
  // more such steps in a row are a surface that is seen at a grazing angle
  constexpr std::size_t kMostInARow = 3;
  for (std::size_t from = 0, i = 0; i < count; ++i) {
    const auto step = i + 1 < count ? step_between(cloud, i, i + 1) : std::nullopt;
    if (step && step->angle <= kNextBeams * next && step->along >= kFar * usual &&
        step->along >= kAlongBeam * step->apart)
      continue;
    if (i > from && i - from <= kMostInARow)
      std::fill(out.of_point.begin() + static_cast<std::ptrdiff_t>(from),
                out.of_point.begin() + static_cast<std::ptrdiff_t>(i + 1), std::uint8_t{1});
    from = i + 1;
  }
  out.count = static_cast<std::size_t>(std::count(out.of_point.begin(), out.of_point.end(), std::uint8_t{1}));
  return out;
}

}  // namespace treadmark::scans
