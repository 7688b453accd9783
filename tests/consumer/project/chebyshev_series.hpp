// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

/// A function of one variable as a truncated series of Chebyshev polynomials, sum c_n T_n(t), where t goes from -1 to 1
/// over [begin, end]. Outside it keeps the values at its ends; with a period > 0 it is joined by a straight line round
/// the turn. Immutable, so safe from any thread.
class ChebyshevSeries {
 public:
  struct Jet {
    double value = 0.0, slope = 0.0, bend = 0.0;  ///< and the first two derivatives
  };
  struct Range {
    double low = 0.0, high = 0.0, steepest = 0.0;  ///< of the value, and of the magnitude of the slope
  };

  /// The n zeros of T_n, where values are wanted; from end to begin.
  static std::vector<double> nodes(double begin, double end, std::size_t n);

  /// Through values at the nodes, without the last coefficients that are rounding or together no more than negligible.
  ChebyshevSeries(double begin, double end, const std::vector<double>& values, double period = 0.0,
                  double negligible = 0.0);

  Jet jet(double x) const;
  /// Conservative, whatever the interval; ends may be infinite.
  Range range(double from, double to) const;
  std::size_t memory_bytes() const { return sizeof(*this) + coefficients_.capacity() * sizeof(double); }

 private:
  double to_unit(double x) const { return (x - middle_) / half_; }
  double on_this_turn(double x) const;
  Jet unit_jet(double t) const;
  double outer_value(double x) const;                                               ///< beyond the ends, on this turn
  double rounding() const { return 1e-13 * (sum_ + std::fabs(coefficients_[0])); }  ///< more than that of a value
  Range inner_range(double t_from, double t_to) const;

  double middle_, half_, period_;
  std::vector<double> coefficients_;
  double first_ = 0.0, last_ = 0.0;  ///< values at begin and end
  double join_ = 0.0;                ///< slope of the straight line from the end round to the beginning
  /// Sums of |c_n|, n |c_n| and n^2 |c_n| without n = 0: they bound sum c_n cos(n theta) and its derivatives by theta.
  double sum_ = 0.0, sum_1_ = 0.0, sum_2_ = 0.0;
};
