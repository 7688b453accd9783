// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/core/profile.hpp"

namespace treadmark::spline {

/// The two fields of a half-parametric surface: y and z (rail) or y and dr (wheel) [m].
struct NetPair {
  double y = 0.0, w = 0.0;

  friend NetPair operator+(const NetPair& a, const NetPair& b) { return {a.y + b.y, a.w + b.w}; }
  friend NetPair operator-(const NetPair& a, const NetPair& b) { return {a.y - b.y, a.w - b.w}; }
  friend NetPair operator*(double f, const NetPair& a) { return {f * a.y, f * a.w}; }
};

/// Fields with their derivatives; u in its own unit, v in cells.
struct NetValue {
  NetPair value, by_u, by_v;
};
struct NetSecond {
  NetPair by_uu, by_uv, by_vv;
};

/// A tensor B-spline surface (y, w)(u, v) with uniform knots in v, stored for evaluation: on every u-span each v-line of
/// coefficients is a cubic in t = u - start of span. v runs from 1 to positions(); cell k holds v in [k + 1, k + 2].
/// Where a line is missing its numbers are NaN, and so are results that need it. Immutable after building.
class SliceNet {
 public:
  /// One coefficient line on one u-span: powers of t.
  struct LineCubic {
    NetPair power[4];
  };

  /// span_starts: start of each u-span; the last span ends at u_end. closed: u is an angle, taken into
  /// [u_end - 2 pi, u_end) first. Otherwise the first and last span go on for ever.
  SliceNet(std::vector<double> span_starts, double u_end, bool closed, int positions);

  int spans() const { return static_cast<int>(starts_.size()); }
  int lines() const { return positions_ + 2; }
  int positions() const { return positions_; }
  int cells() const { return positions_ - 1; }
  bool closed() const { return closed_; }
  double span_start(int span) const { return starts_[static_cast<std::size_t>(span)]; }
  double span_end(int span) const {
    return span + 1 < spans() ? starts_[static_cast<std::size_t>(span) + 1] : u_end_;
  }
  std::size_t memory_bytes() const { return cubics_.size() * sizeof(LineCubic) + starts_.size() * sizeof(double); }

  LineCubic& line(int span, int line) { return cubics_[index(span, line)]; }
  const LineCubic& line(int span, int line) const { return cubics_[index(span, line)]; }

  /// Span and offset for u; hint: the span of a near point.
  struct Place {
    int span;
    double t;
  };
  Place find(double u, int hint = 0) const;

  /// At the break v = k + 1, 0 <= k < positions().
  NetValue at_break(const Place& place, int k) const;
  /// At v = cell + 1 + f, 0 <= f <= 1.
  NetValue at(const Place& place, int cell, double f) const;
  NetSecond second_at(const Place& place, int cell, double f) const;

  /// Ranges of y and w over a cell on one span, from control points; false if there is no surface.
  bool hull(int span, int cell, Interval& y, Interval& w) const;

 private:
  std::size_t index(int span, int line) const {
    return static_cast<std::size_t>(span) * static_cast<std::size_t>(lines()) + static_cast<std::size_t>(line);
  }

  std::vector<double> starts_;
  double u_end_;
  bool closed_;
  int positions_;
  std::vector<LineCubic> cubics_;
};

inline SliceNet::Place SliceNet::find(double u, int hint) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (closed_ && !(u >= u_end_ - kTurn && u < u_end_)) u -= kTurn * std::floor((u - u_end_) / kTurn + 1.0);
  int span = hint;
  for (int step = 0; step < 4; ++step) {
    if (u < starts_[static_cast<std::size_t>(span)] && span > 0)
      --span;
    else if (span + 1 < spans() && u >= starts_[static_cast<std::size_t>(span) + 1])
      ++span;
    else
      return {span, u - starts_[static_cast<std::size_t>(span)]};
  }
  const auto first = starts_.begin() + 1;
  span = static_cast<int>(std::upper_bound(first, starts_.end(), u) - first);
  return {span, u - starts_[static_cast<std::size_t>(span)]};
}

inline NetValue SliceNet::at_break(const Place& place, int k) const {
  const LineCubic* c = &line(place.span, k);
  const double t = place.t;
  const auto value = [t](const LineCubic& l) { return l.power[0] + t * (l.power[1] + t * (l.power[2] + t * l.power[3])); };
  const auto slope = [t](const LineCubic& l) { return l.power[1] + t * (2.0 * l.power[2] + (3.0 * t) * l.power[3]); };
  const NetPair left = value(c[0]), right = value(c[2]);
  return {(1.0 / 6.0) * (left + 4.0 * value(c[1]) + right), (1.0 / 6.0) * (slope(c[0]) + 4.0 * slope(c[1]) + slope(c[2])),
          0.5 * (right - left)};
}

inline NetValue SliceNet::at(const Place& place, int cell, double f) const {
  const LineCubic* c = &line(place.span, cell);
  const double t = place.t, g = 1.0 - f;
  const double basis[4] = {g * g * g / 6.0, 2.0 / 3.0 - f * f * (1.0 - 0.5 * f), 2.0 / 3.0 - g * g * (1.0 - 0.5 * g),
                           f * f * f / 6.0};
  const double basis_v[4] = {-0.5 * g * g, f * (1.5 * f - 2.0), g * (2.0 - 1.5 * g), 0.5 * f * f};
  NetValue sum;
  for (int k = 0; k < 4; ++k) {
    const NetPair* p = c[k].power;
    const NetPair value = p[0] + t * (p[1] + t * (p[2] + t * p[3]));
    sum.value = sum.value + basis[k] * value;
    sum.by_v = sum.by_v + basis_v[k] * value;
    sum.by_u = sum.by_u + basis[k] * (p[1] + t * (2.0 * p[2] + (3.0 * t) * p[3]));
  }
  return sum;
}

}  // namespace treadmark::spline
