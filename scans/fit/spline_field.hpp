// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/scans/placement/section_fit.hpp"

namespace treadmark::scans {

/// A tensor product of uniform cubic B-splines over a band, of which only some functions are in use. Along a it may be
/// closed.
struct SplineLevel {
  std::size_t intervals_a = 0, intervals_s = 0;
  bool closed = false;
  double knot_a = 0.0, knot_s = 0.0;  ///< between knots [m]
  std::vector<std::uint8_t> active;   ///< of function i_a * functions_s() + i_s
  std::vector<float> coefficient;     ///< [m], 0 where not active

  std::size_t functions_a() const { return closed ? intervals_a : intervals_a + 3; }
  std::size_t functions_s() const { return intervals_s + 3; }
  /// The k-th (0..3) function over an interval along a.
  std::size_t function_a(std::size_t interval, std::size_t k) const {
    return closed ? (interval + k) % intervals_a : interval + k;
  }
  std::size_t size() const { return functions_a() * functions_s(); }
};

/// Sum of levels: the distance of the fitted surface from its section, d(a, s).
class SplineField {
 public:
  SplineField(double length_a, double length_s, bool closed)
      : length_a_(length_a), length_s_(length_s), closed_(closed) {}

  double length_a() const { return length_a_; }
  double length_s() const { return length_s_; }
  bool closed() const { return closed_; }
  const std::vector<SplineLevel>& levels() const { return levels_; }
  void add(SplineLevel level) { levels_.push_back(std::move(level)); }
  void drop_from(std::size_t first) {
    levels_.erase(levels_.begin() + static_cast<std::ptrdiff_t>(first), levels_.end());
  }

  /// a counts from the start of the band; clamped (open) or wrapped (closed). Safe from any thread.
  double value(double a, double s) const;
  /// The finest distance of knots along a among the functions with a coefficient beyond tolerance anywhere across the
  /// band at a.
  double finest_knot_a(double a, double tolerance) const;

 private:
  double length_a_, length_s_;
  bool closed_;
  std::vector<SplineLevel> levels_;
};

}  // namespace treadmark::scans
