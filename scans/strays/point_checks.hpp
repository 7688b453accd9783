// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Throws Error(input_data) for fewer points than `least`, or more than indices can tell apart, or one that is not
/// finite.
template <class Point>
void check_points(std::span<const Point> points, std::size_t least, const char* what) {
  const auto fail = [&](const std::string& why, const char* advice) {
    throw Error(ErrorKind::input_data, std::string(what) + ": " + why, {}, advice);
  };
  if (points.size() < least)
    fail(std::to_string(points.size()) + " points, at least " + std::to_string(least) + " are needed",
         "give more points");
  if (points.size() >= std::numeric_limits<std::uint32_t>::max() / 4) fail("too many points", "thin them first");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      fail("point " + std::to_string(i) + " has a coordinate that is not a finite number", "leave such points out");
}

/// The points from the low corner of their box, divided by `unit` (0: the longest side of the box), so that what
/// follows meets numbers of moderate size whatever the unit and the place of the data.
struct NormalisedPoints {
  std::vector<Vec3> points;
  Vec3 corner;
  double unit;
};
inline NormalisedPoints normalise_points(std::span<const Vec3> points, double unit = 0.0) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  NormalisedPoints result{{}, low, unit > 0.0 ? unit : (high - low).maxCoeff()};
  if (!(result.unit > 0.0)) result.unit = 1.0;  // all points equal
  result.points.reserve(points.size());
  for (const Vec3& p : points) result.points.emplace_back((p - low) / result.unit);
  return result;
}

}  // namespace treadmark::scans
