// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/profile_spline.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"

namespace treadmark::spline {

ProfileSpline::ProfileSpline(std::vector<double> breaks, std::vector<CubicSegment> segments, std::vector<double> kinks)
    : breaks_(std::move(breaks)), segments_(std::move(segments)), kinks_(std::move(kinks)) {
  if (segments_.empty() || breaks_.size() != segments_.size() + 1)
    throw Error(ErrorKind::configuration, "a profile spline needs one segment between every two breaks");
  for (std::size_t i = 0; i < segments_.size(); ++i)
    if (!(breaks_[i] < breaks_[i + 1]))
      throw Error(ErrorKind::configuration, "the breaks of a profile spline must increase strictly");
}

int ProfileSpline::find_segment(double s) const { return static_cast<int>(piece_at(breaks_, s)); }

Vec2 ProfileSpline::position(double s) const {
  s = std::clamp(s, begin(), end());
  const auto k = static_cast<std::size_t>(find_segment(s));
  const CubicSegment& c = segments_[k];
  const double t = s - breaks_[k];
  return {c.y[0] + t * (c.y[1] + t * (c.y[2] + t * c.y[3])), c.z[0] + t * (c.z[1] + t * (c.z[2] + t * c.z[3]))};
}

Vec2 ProfileSpline::derivative(double s) const {
  s = std::clamp(s, begin(), end());
  const auto k = static_cast<std::size_t>(find_segment(s));
  const CubicSegment& c = segments_[k];
  const double t = s - breaks_[k];
  return {c.y[1] + t * (2 * c.y[2] + 3 * t * c.y[3]), c.z[1] + t * (2 * c.z[2] + 3 * t * c.z[3])};
}

Vec2 ProfileSpline::second_derivative(double s) const {
  s = std::clamp(s, begin(), end());
  const auto k = static_cast<std::size_t>(find_segment(s));
  const CubicSegment& c = segments_[k];
  const double t = s - breaks_[k];
  return {2 * c.y[2] + 6 * t * c.y[3], 2 * c.z[2] + 6 * t * c.z[3]};
}

double ProfileSpline::inclination(double s) const {
  const Vec2 d = derivative(s);
  return std::atan2(d.y(), d.x());
}

}  // namespace treadmark::spline
