// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/node_change.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "treadmark/backends/spline/banded.hpp"

namespace treadmark::spline {

std::vector<ShapeParameter> node_parameters(const ProfileSpline& profile) {
  // between near points little height is much curvature, some four times this: little beside that of a rail's crown,
  // while contact still moves by more than its place is uncertain
  constexpr double kCurvature = 1e-3, kLeast = 2e-11, kMost = 5e-8;  // [1/m], [m], [m]
  const std::span<const double> s = profile.breaks();
  std::vector<ShapeParameter> out;
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double before = k > 0 ? s[k] - s[k - 1] : s[1] - s[0], after = k + 1 < s.size() ? s[k + 1] - s[k] : before;
    const double width = std::min(before, after);
    out.push_back({"point_" + std::to_string(k), "m", std::clamp(kCurvature * width * width, kLeast, kMost)});
  }
  return out;
}

ProfileSpline node_change(const ProfileSpline& profile, std::size_t node) {
  const std::span<const double> s = profile.breaks();
  const std::size_t n = s.size();
  const auto value = [&](std::size_t k) { return k == node ? 1.0 : 0.0; };
  const auto width = [&](std::size_t k) { return s[k + 1] - s[k]; };
  const auto slope = [&](std::size_t k) { return (value(k + 1) - value(k)) / width(k); };
  // second derivatives at the breaks, 0 at the ends
  std::vector<double> bend(n, 0.0);
  if (n > 2) {
    BandedCholesky matrix(static_cast<int>(n) - 2, 1);
    std::vector<double> inner(n - 2);
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const int row = static_cast<int>(k) - 1;
      matrix.at(row, row) = 2.0 * (width(k - 1) + width(k));
      if (row > 0) matrix.at(row, row - 1) = width(k - 1);
      inner[k - 1] = 6.0 * (slope(k) - slope(k - 1));
    }
    matrix.factor();
    matrix.solve(inner);
    for (std::size_t k = 1; k + 1 < n; ++k) bend[k] = inner[k - 1];
  }
  std::vector<CubicSegment> segments(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    double* z = segments[k].z;
    z[0] = value(k);
    z[1] = slope(k) - width(k) * (2.0 * bend[k] + bend[k + 1]) / 6.0;
    z[2] = 0.5 * bend[k];
    z[3] = (bend[k + 1] - bend[k]) / (6.0 * width(k));
  }
  return {{s.begin(), s.end()}, std::move(segments)};
}

ProfileSpline with_node(const ProfileSpline& profile, std::size_t node, double amount) {
  const ProfileSpline change = node_change(profile, node);
  std::vector<CubicSegment> segments(profile.segments().begin(), profile.segments().end());
  for (std::size_t k = 0; k < segments.size(); ++k)
    for (int power = 0; power < 4; ++power) segments[k].z[power] += amount * change.segments()[k].z[power];
  return {{profile.breaks().begin(), profile.breaks().end()},
          std::move(segments),
          {profile.kinks().begin(), profile.kinks().end()}};
}

}  // namespace treadmark::spline
