// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <vector>

#include "treadmark/model/shape/spline_surface.hpp"

namespace treadmark::spline {

inline constexpr int kMostDegree = kHighestHierarchicalDegree;
/// One number for each of the degree + 1 functions over an interval; the rest is 0.
using KnotWeights = std::array<double, kMostDegree + 1>;

/// The blossom of a polynomial at degree arguments, as weights of its Bernstein coefficients between low and high.
KnotWeights bernstein_blossom(int degree, const double* arguments, double low, double high);

/// B-splines of one variable: their degree, their knots and the intervals between different knots (de Boor 1978).
class KnotLine {
 public:
  /// Simple knots, but full ones at both ends. Errors (all three): Error(input_data) for a degree that is not 1, 2 or
  /// 3, too few knots, knots that decrease, are not finite or are repeated more than degree times between the ends.
  static KnotLine open(int degree, std::span<const double> breaks);
  /// Simple knots; the last break is the first one a period on.
  static KnotLine periodic(int degree, std::span<const double> breaks);
  /// As files have them; the functions begin at knot degree and end as many before the last.
  static KnotLine of_knots(SplineKnots knots);

  int degree() const { return degree_; }
  bool closed() const { return closed_; }
  int functions() const { return functions_; }
  int intervals() const { return static_cast<int>(breaks_.size()) - 1; }
  double from(int interval) const { return breaks_[static_cast<std::size_t>(interval)]; }
  double to(int interval) const { return breaks_[static_cast<std::size_t>(interval) + 1]; }
  const std::vector<double>& breaks() const { return breaks_; }
  const std::vector<double>& knots() const { return knots_; }  ///< of a closed line: degree more before and behind
  /// The interval that holds x, clamped to the ends.
  int find(double x) const;

  /// The k-th function over an interval, k = 0 .. degree.
  int function(int interval, int k) const;
  struct Support {
    int first, last;  ///< intervals, both included; those of a closed line are counted on beyond its end
  };
  Support support(int function) const { return support_[static_cast<std::size_t>(function)]; }
  int folded(int interval) const { return closed_ && interval >= intervals() ? interval - intervals() : interval; }

  /// The blossom of the polynomial over an interval at degree arguments, as weights of the coefficients of its
  /// functions (Ramshaw 1987): Bernstein coefficients, finer splines and values are blossoms.
  KnotWeights blossom(int interval, const double* arguments) const;
  /// Coefficient k of the Bernstein polynomials of an interval.
  KnotWeights bernstein(int interval, int k) const;
  /// The degree inner knots of the k-th function over an interval: the blossom there is the function's coefficient.
  const double* inner_knots(int interval, int k) const;

  /// Every break of the other line, each with as many knots or more: a space that holds the other one.
  bool holds(const KnotLine& other) const;
  /// The positions: every interval halved that divide(its number) names.
  template <class Divide>
  std::vector<double> halved(const Divide& divide) const {
    std::vector<double> out{breaks_.front()};
    for (int i = 0; i < intervals(); ++i) {
      if (divide(i)) out.push_back(0.5 * (from(i) + to(i)));
      out.push_back(to(i));
    }
    return out;
  }

 private:
  KnotLine(int degree, std::vector<double> knots, bool closed);

  int degree_, functions_ = 0;
  bool closed_;
  std::vector<double> knots_, breaks_;
  std::vector<int> span_;  // of each interval: the knot at which it begins
  std::vector<Support> support_;
};

}  // namespace treadmark::spline
