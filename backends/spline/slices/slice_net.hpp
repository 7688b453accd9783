// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/slices/slice_kernels.hpp"
#include "treadmark/core/lanes4.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/slices.hpp"

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

/// A tensor B-spline surface (y, w)(u, v) with uniform knots in v, stored for evaluation: on every u-span each v-line
/// of coefficients is a cubic in t = u - start of span; equal numbers of successive lines lie side by side. v runs from
/// 1 to positions(); cell k holds v in [k + 1, k + 2]. In v it is cubic, or straight between its breaks: then line k +
/// 1 is break k itself, and the outer two lines are missing. Where a line is missing its numbers are NaN, and so are
/// results that need it. Immutable after building.
class SliceNet {
 public:
  /// One coefficient line on one u-span: powers of t.
  struct LineCubic {
    NetPair power[4];
  };

  enum class Across { cubic, straight };

  /// span_starts: start of each u-span; the last span ends at u_end. closed: u is an angle, taken into
  /// [u_end - 2 pi, u_end) first. Otherwise the first and last span go on for ever.
  SliceNet(std::vector<double> span_starts, double u_end, bool closed, int positions, Across across = Across::cubic);

  int spans() const { return static_cast<int>(starts_.size()) - 1; }
  int lines() const { return positions_ + 2; }
  int positions() const { return positions_; }
  int cells() const { return positions_ - 1; }
  bool closed() const { return closed_; }
  bool straight() const { return across_ == Across::straight; }
  double span_start(int span) const { return starts_[static_cast<std::size_t>(span)]; }
  double span_end(int span) const { return starts_[static_cast<std::size_t>(span) + 1]; }
  std::size_t memory_bytes() const { return (cubics_.size() + starts_.size()) * sizeof(double); }

  LineCubic line(int span, int line) const {
    const double* p = numbers(span, line);
    LineCubic cubic;
    for (std::size_t m = 0; m < 4; ++m) cubic.power[m] = {p[2 * m * stride_], p[(2 * m + 1) * stride_]};
    return cubic;
  }
  void set_line(int span, int line, const LineCubic& cubic) {
    double* p = cubics_.data() + index(span, line);
    for (std::size_t m = 0; m < 4; ++m)
      p[2 * m * stride_] = cubic.power[m].y, p[(2 * m + 1) * stride_] = cubic.power[m].w;
  }
  /// The first and the last span are the constant ends of what lies between them.
  void hold_ends(bool first, bool last) { held_first_ = first, held_last_ = last; }
  NetArrays arrays() const {
    return {cubics_.data(), starts_.data(), static_cast<long>(8 * stride_), static_cast<long>(stride_),
            spans(),        straight()};
  }

  /// Span and offset for u; hint: the span of a near point.
  struct Place {
    int span;
    double t;
  };
  Place find(double u, int hint = 0) const;

  /// Which cell's derivative by v is meant at a break where two straight ones meet.
  enum class Side { before, after };
  /// At the break v = k + 1, 0 <= k < positions().
  NetValue at_break(const Place& place, int k, Side side = Side::after) const;
  /// At v = cell + 1 + f, 0 <= f <= 1.
  NetValue at(const Place& place, int cell, double f) const;
  NetSecond second_at(const Place& place, int cell, double f) const;

  /// Numbers that w follows from, of each line at each station where spans meet or end: w there and its derivative by
  /// u, one after the other; along a span w is the cubic that has those of its ends, and a constant end has the value
  /// beside it.
  std::size_t numbers() const { return 2 * static_cast<std::size_t>(lines()) * static_cast<std::size_t>(stations()); }
  struct Number {
    int station, line;
    bool slope;  ///< by u
    double u;
  };
  Number number(std::size_t k) const;
  /// Calls use(k, share) for all that w depends on at a place of a cell; it is the sum of share times number.
  template <class Use>
  void each_number(const Place& place, int cell, double f, const Use& use) const;
  SliceNet with_number(std::size_t k, double amount) const;

  /// Ranges of y and w over a cell for u0 <= u <= u1 within one span, from control points; false if there is no
  /// surface.
  bool hull(int span, int cell, double u0, double u1, Interval& y, Interval& w) const;

 private:
  std::size_t index(int span, int line) const {
    return static_cast<std::size_t>(span) * 8 * stride_ + static_cast<std::size_t>(line);
  }
  bool held(int span) const { return (held_first_ && span == 0) || (held_last_ && span + 1 == spans()); }
  bool whole_turn() const { return closed_ && !held_first_ && !held_last_; }
  int stations() const { return whole_turn() ? spans() : spans() + 1 - (held_first_ ? 1 : 0) - (held_last_ ? 1 : 0); }
  /// At the start of a span that is not held, or at its end.
  int station(int span, bool end) const {
    const int k = span + (end ? 1 : 0);
    return whole_turn() && k == spans() ? 0 : k - (held_first_ ? 1 : 0);
  }
  /// Of a held span.
  int station_beside(int span) const { return held_first_ && span == 0 ? 0 : stations() - 1; }
  const double* numbers(int span, int line) const { return cubics_.data() + index(span, line); }
  /// One line: value and derivatives by u.
  struct LineValue {
    NetPair value, by_u, by_uu;
  };
  LineValue line_at(const Place& place, int line) const;
  NetValue straight_at(const Place& place, int cell, double f) const;

  std::vector<double> starts_;  // of the spans, and the end of the last
  bool closed_, held_first_ = false, held_last_ = false;
  Across across_;
  int positions_;
  std::size_t stride_;  // from a power to the next: lines and NaN up to where four breaks at a time may read
  std::vector<double> cubics_;
};

// Both fields at once in one register.
namespace detail {
using lanes::Pair;

inline Pair both(double x) { return Pair{x, x}; }
inline NetPair store(const Pair& p) { return {p[0], p[1]}; }
}  // namespace detail

template <class Use>
void SliceNet::each_number(const Place& place, int cell, double f, const Use& use) const {
  const double g = 1.0 - f;
  const std::array<double, 4> across = straight() ? std::array{0.0, g, f, 0.0}
                                                  : std::array{g * g * g / 6.0, 2.0 / 3.0 - f * f * (1.0 - 0.5 * f),
                                                               2.0 / 3.0 - g * g * (1.0 - 0.5 * g), f * f * f / 6.0};
  const auto share = [&](int at, std::size_t slope, double along) {
    for (std::size_t b = 0; b < across.size(); ++b)
      if (across[b] != 0.0) use(2 * (static_cast<std::size_t>(at * lines() + cell) + b) + slope, along * across[b]);
  };
  if (held(place.span)) return share(station_beside(place.span), 0, 1.0);
  const double h = span_end(place.span) - span_start(place.span), x = place.t / h, y = 1.0 - x;
  share(station(place.span, false), 0, y * y * (1.0 + 2.0 * x));
  share(station(place.span, false), 1, h * x * y * y);
  share(station(place.span, true), 0, x * x * (1.0 + 2.0 * y));
  share(station(place.span, true), 1, -h * x * x * y);
}

inline SliceNet::Place SliceNet::find(double u, int hint) const {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const double u_end = starts_.back();
  if (closed_ && !(u >= u_end - kTurn && u < u_end)) u -= kTurn * std::floor((u - u_end) / kTurn + 1.0);
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
  span = static_cast<int>(std::upper_bound(first, starts_.end() - 1, u) - first);
  return {span, u - starts_[static_cast<std::size_t>(span)]};
}

inline NetValue SliceNet::at_break(const Place& place, int k, Side side) const {
  using detail::Pair;
  if (straight()) return side == Side::after ? straight_at(place, k, 0.0) : straight_at(place, k - 1, 1.0);
  const double* c = numbers(place.span, k);
  const Pair t = detail::both(place.t);
  // Powers of t at the break first, then one polynomial instead of three.
  Pair power[4], change[4];
  for (std::size_t m = 0; m < 4; ++m) {
    const double *y = c + 2 * m * stride_, *w = y + stride_;
    const Pair left{y[0], w[0]}, middle{y[1], w[1]}, right{y[2], w[2]};
    power[m] = detail::both(1.0 / 6.0) * (left + right) + detail::both(2.0 / 3.0) * middle;
    change[m] = right - left;
  }
  return {detail::store(power[0] + t * (power[1] + t * (power[2] + t * power[3]))),
          detail::store(power[1] + t * (detail::both(2.0) * power[2] + t * (detail::both(3.0) * power[3]))),
          detail::store(detail::both(0.5) * (change[0] + t * (change[1] + t * (change[2] + t * change[3]))))};
}

inline NetValue SliceNet::at(const Place& place, int cell, double f) const {
  using detail::Pair;
  if (straight()) return straight_at(place, cell, f);
  const double* c = numbers(place.span, cell);
  const double g = 1.0 - f;
  const double basis[4] = {g * g * g * (1.0 / 6.0), 2.0 / 3.0 - f * f * (1.0 - 0.5 * f),
                           2.0 / 3.0 - g * g * (1.0 - 0.5 * g), f * f * f * (1.0 / 6.0)};
  const double basis_v[4] = {-0.5 * g * g, f * (1.5 * f - 2.0), g * (2.0 - 1.5 * g), 0.5 * f * f};
  const Pair t = detail::both(place.t), two = detail::both(2.0), t3 = detail::both(3.0 * place.t);
  Pair value{}, by_u{}, by_v{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto power = [&](std::size_t m) { return Pair{c[2 * m * stride_ + k], c[(2 * m + 1) * stride_ + k]}; };
    const Pair p1 = power(1), p2 = power(2), p3 = power(3);
    const Pair at_t = power(0) + t * (p1 + t * (p2 + t * p3));
    value += detail::both(basis[k]) * at_t;
    by_v += detail::both(basis_v[k]) * at_t;
    by_u += detail::both(basis[k]) * (p1 + t * (two * p2 + t3 * p3));
  }
  return {detail::store(value), detail::store(by_u), detail::store(by_v)};
}

/// Slices cut along their kinks: each part of the sections is a surface of its own, so that it may turn sharply where
/// the next one begins; both have the same edge. Without kinks the slices themselves. Errors: Error(input_data) for a
/// kink that is not an inner feature, or kinks that do not increase.
std::vector<SliceSet> split_at_kinks(const SliceSet& slices);

}  // namespace treadmark::spline
