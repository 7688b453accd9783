// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/spline_field.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

struct Place {
  std::size_t interval;
  double t;
};

Place place(double x, double knot, std::size_t intervals) {
  const double at = std::clamp(x / knot, 0.0, static_cast<double>(intervals));
  const auto interval = std::min(intervals - 1, to_whole<std::size_t>(at));
  return {interval, at - static_cast<double>(interval)};
}

double inside(double a, double length, bool closed) {
  if (!closed) return a;
  a = std::fmod(a, length);
  return a < 0.0 ? a + length : a;
}

}  // namespace

double SplineField::value(double a, double s) const {
  a = inside(a, length_a_, closed_);
  double sum = 0.0;
  for (const SplineLevel& level : levels_) {
    const Place pa = place(a, level.knot_a, level.intervals_a), ps = place(s, level.knot_s, level.intervals_s);
    const auto ba = cubic_basis(pa.t), bs = cubic_basis(ps.t);
    for (std::size_t i = 0; i < 4; ++i) {
      const float* c = level.coefficient.data() + level.function_a(pa.interval, i) * level.functions_s() + ps.interval;
      sum += ba[i] * (bs[0] * c[0] + bs[1] * c[1] + bs[2] * c[2] + bs[3] * c[3]);
    }
  }
  return sum;
}

double SplineField::finest_knot_a(double a, double tolerance) const {
  a = inside(a, length_a_, closed_);
  double finest = length_a_;
  for (const SplineLevel& level : levels_) {
    if (level.knot_a >= finest) continue;
    const Place pa = place(a, level.knot_a, level.intervals_a);
    for (std::size_t i = 0; i < 4 && level.knot_a < finest; ++i) {
      const float* row = level.coefficient.data() + level.function_a(pa.interval, i) * level.functions_s();
      if (std::any_of(row, row + level.functions_s(), [&](float c) { return std::fabs(c) > tolerance; }))
        finest = level.knot_a;
    }
  }
  return finest;
}

}  // namespace treadmark::scans
