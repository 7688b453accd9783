// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "treadmark/backends/analytic/arc_graph.hpp"

namespace treadmark::analytic {

/// Where the origin of a cutter passes: y, z and roll as piecewise cubic functions of x.
class CutterPath {
 public:
  enum Coordinate { kY, kZ, kRoll };
  using Values = std::array<std::vector<double>, 3>;

  /// Natural cubic splines through the values at increasing x.
  static CutterPath natural_spline(std::vector<double> x, const Values& values);
  /// Cubic pieces with the given values and slopes at increasing x.
  static CutterPath hermite(std::vector<double> x, const Values& values, const Values& slopes);

  double x_min() const { return x_.front(); }
  double x_max() const { return x_.back(); }
  std::size_t find(double x, std::size_t guess) const {
    const std::size_t last = pieces_.size() - 1;
    std::size_t i = guess;
    while (i < last && x > x_[i + 1]) ++i;
    while (i > 0 && x < x_[i]) --i;
    return i;
  }
  /// x belongs to the given piece.
  Jet at(Coordinate which, double x, std::size_t piece) const {
    const Cubic& p = pieces_[piece][which];
    const double t = x - x_[piece];
    return {p[0] + t * (p[1] + t * (p[2] + t * p[3])), p[1] + t * (2.0 * p[2] + 3.0 * t * p[3]),
            2.0 * p[2] + 6.0 * t * p[3]};
  }
  /// Least and greatest value and greatest size of the slope over [a, b], clipped to the path.
  struct Range {
    double low = 0.0, high = 0.0, steepest = 0.0;
  };
  Range range(Coordinate which, double a, double b) const;
  std::size_t memory_bytes() const { return pieces_.capacity() * sizeof(Piece) + x_.capacity() * sizeof(double); }

 private:
  using Cubic = std::array<double, 4>;
  using Piece = std::array<Cubic, 3>;
  std::vector<double> x_;
  std::vector<Piece> pieces_;
};

}  // namespace treadmark::analytic
