// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/node_change.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/core/surface_change.hpp"

namespace treadmark::spline {
namespace {

/// Of the second derivatives at the inner breaks of a natural spline, three breaks at least; the right-hand side is six
/// times the changes of slope from chord to chord.
BandedCholesky natural_spline(std::span<const double> s) {
  BandedCholesky matrix(static_cast<int>(s.size()) - 2, 1);
  for (std::size_t k = 1; k + 1 < s.size(); ++k) {
    const int row = static_cast<int>(k) - 1;
    matrix.at(row, row) = 2.0 * (s[k + 1] - s[k - 1]);
    if (row > 0) matrix.at(row, row - 1) = s[k] - s[k - 1];
  }
  matrix.factor();
  return matrix;
}

}  // namespace

std::vector<ShapeParameter> node_parameters(const ProfileSpline& profile) {
  const std::span<const double> s = profile.breaks();
  std::vector<ShapeParameter> out;
  for (std::size_t k = 0; k < s.size(); ++k) {
    const double before = k > 0 ? s[k] - s[k - 1] : s[1] - s[0], after = k + 1 < s.size() ? s[k + 1] - s[k] : before;
    const double width = std::min(before, after);
    const Vec2 place = profile.position(s[k]);
    out.push_back({"point_" + std::to_string(k), "m", step_over(width), {0.0, place.x(), place.y()}});
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
    std::vector<double> inner(n - 2);
    for (std::size_t k = 1; k + 1 < n; ++k) inner[k - 1] = 6.0 * (slope(k) - slope(k - 1));
    natural_spline(s).solve(inner);
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

void pull_back_to_nodes(const ProfileSpline& profile, std::span<const double> v, std::span<const double> weights,
                        std::span<double> by) {
  const std::span<const double> s = profile.breaks();
  const std::size_t n = s.size();
  const auto width = [&](std::size_t k) { return s[k + 1] - s[k]; };
  std::vector<double> by_bend(n, 0.0);  // by second derivatives at the breaks
  for (std::size_t i = 0; i < v.size(); ++i) {
    const auto k = static_cast<std::size_t>(profile.find_segment(v[i]));
    const double h = width(k), b = (v[i] - s[k]) / h, a = 1.0 - b, bending = weights[i] * h * h / 6.0;
    by[k] += weights[i] * a, by[k + 1] += weights[i] * b;
    by_bend[k] += bending * (a * a * a - a), by_bend[k + 1] += bending * (b * b * b - b);
  }
  if (n <= 2) return;
  const std::span<double> inner = std::span(by_bend).subspan(1, n - 2);
  natural_spline(s).solve(inner);  // it is symmetric
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double before = 6.0 * inner[k - 1] / width(k - 1), after = 6.0 * inner[k - 1] / width(k);
    by[k - 1] += before, by[k] -= before + after, by[k + 1] += after;
  }
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
