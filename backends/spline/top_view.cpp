// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/top_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

// Positions where y(s) turns round inside segments, with both ends of the curve.
std::vector<double> turning_points(const ProfileSpline& profile) {
  std::vector<double> turns{profile.begin()};
  const auto breaks = profile.breaks();
  const auto segments = profile.segments();
  double slope_before = 0.0;
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double h = breaks[k + 1] - breaks[k];
    const double* c = segments[k].y;
    if (k > 0 && slope_before * c[1] < 0.0) turns.push_back(breaks[k]);  // at a corner
    // Roots of c1 + 2 c2 t + 3 c3 t^2 inside (0, h), in the form without cancellation.
    const double discriminant = c[2] * c[2] - 3.0 * c[1] * c[3];
    if (discriminant > 0.0) {
      const double q = -(c[2] + std::copysign(std::sqrt(discriminant), c[2]));
      double roots[2] = {q / (3.0 * c[3]), c[1] / q};
      if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
      for (const double root : roots)
        if (root > 0.0 && root < h) turns.push_back(breaks[k] + root);
    }
    slope_before = c[1] + h * (2.0 * c[2] + 3.0 * h * c[3]);
  }
  turns.push_back(profile.end());
  return turns;
}

// s with y(s) = y on a monotonic branch.
double solve_on(const ProfileSpline& profile, const TopView::Section& branch, double y) {
  const double sign = branch.increasing ? 1.0 : -1.0;
  double low = branch.s_min, high = branch.s_max;
  double s = 0.5 * (low + high);
  // Bisection over the breaks first, so that Newton's method works on one cubic.
  int first = profile.find_segment(low), last = profile.find_segment(high);
  const auto breaks = profile.breaks();
  while (last > first) {
    const int middle = first + (last - first) / 2;
    const double end = breaks[static_cast<std::size_t>(middle) + 1];
    if (sign * (profile.position(end).x() - y) >= 0.0) {
      last = middle;
      high = std::min(high, end);
    } else {
      first = middle + 1;
      low = std::max(low, end);
    }
  }
  s = 0.5 * (low + high);
  const CubicSegment& c = profile.segments()[static_cast<std::size_t>(first)];
  const double origin = breaks[static_cast<std::size_t>(first)];
  for (int iteration = 0; iteration < 100 && high > low; ++iteration) {
    const double t = s - origin;
    const double error = c.y[0] + t * (c.y[1] + t * (c.y[2] + t * c.y[3])) - y;
    if (error == 0.0) return s;
    (sign * error > 0.0 ? high : low) = s;
    double next = s - error / (c.y[1] + t * (2.0 * c.y[2] + 3.0 * t * c.y[3]));
    if (!(next >= low && next <= high)) next = 0.5 * (low + high);
    if (next == s) return s;
    const bool done = std::abs(next - s) < 1e-16 * (1.0 + std::abs(s));
    s = next;
    if (done) return s;
  }
  return s;
}

}  // namespace

TopView::TopView(const ProfileSpline& profile, Body body) : profile_(&profile) {
  const std::vector<double> turns = turning_points(profile);
  std::vector<Section> branches;
  std::vector<double> borders;
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const double a = profile.position(turns[i]).x(), b = profile.position(turns[i + 1]).x();
    if (a == b) continue;
    branches.push_back({std::min(a, b), std::max(a, b), turns[i], turns[i + 1], b > a});
    borders.push_back(a);
    borders.push_back(b);
  }
  if (branches.empty()) throw Error(ErrorKind::numerical, "a profile that is upright all over has no top view");
  std::sort(borders.begin(), borders.end());
  borders.erase(std::unique(borders.begin(), borders.end()), borders.end());
  // A valid curve does not cross itself, so between two borders the order of the branches stays the same.
  const double sign = body == Body::rail ? -1.0 : 1.0;
  const Section* previous = nullptr;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double middle = 0.5 * (borders[i] + borders[i + 1]);
    const Section* best = nullptr;
    double best_z = 0.0;
    for (const Section& branch : branches) {
      if (branch.y_min > borders[i] || branch.y_max < borders[i + 1]) continue;
      const double z = sign * profile.position(solve_on(profile, branch, middle)).y();
      if (best == nullptr || z > best_z) best = &branch, best_z = z;
    }
    if (best != nullptr && best == previous) {
      sections_.back().y_max = borders[i + 1];
    } else if (best != nullptr) {
      sections_.push_back(*best);
      sections_.back().y_min = borders[i];
      sections_.back().y_max = borders[i + 1];
    }
    previous = best;
  }
}

double TopView::s_at(double y) const {
  for (const Section& section : sections_)
    if (y >= section.y_min && y <= section.y_max) return solve_on(*profile_, section, y);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace treadmark::spline
