// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "treadmark/backends/analytic/arc_graph.hpp"
#include "treadmark/backends/analytic/graph_curve.hpp"
#include "treadmark/core/pose.hpp"

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

/// A cutter section q = h(s) swept along a path through a rail: what lies above it, between the ends of the section and
/// those of the path, is removed. At x the section's origin is at (Y, Z) and it is rolled by r:
///   s = cos r (y - Y) + sin r (z - Z),   q = -sin r (y - Y) + cos r (z - Z).
/// Removed is where all bounds are positive: h(s) - q, s - s_min, s_max - s, x - x_min, x_max - x.
class Cutter {
 public:
  /// Errors: Error(configuration), begun with name, if the path is steeper than 45 degrees somewhere or rolls so fast
  /// that the ends of the section do, or if the rolled section is inclined by more than 80 degrees.
  Cutter(CutterPath path, GraphCurve section, const std::string& name);

  enum Bound { kSection, kStart, kEnd, kFirst, kLast };  ///< in the order above

  /// A point in cutter coordinates. x beyond the path belongs to its ends, s beyond the section has the h of its ends.
  struct Place {
    double s = 0.0, q = 0.0, h = 0.0, dh = 0.0;
    double s_x = 0.0, q_x = 0.0;
    double cos = 1.0, sin = 0.0;
    double gap() const { return h - q; }
  };
  /// What was found last, so that neighbours need no search and points of one x share the path. One for each thread.
  struct Hint {
    std::size_t path = 0;
    int section = 0;
    double x = std::numeric_limits<double>::quiet_NaN();
    Jet y, z, roll;
    double cos = 1.0, sin = 0.0;
  };
  Place place(const Vec3& p, Hint& hint) const;
  bool in_domain(const Place& at, double x) const { return x > x_min_ && x < x_max_ && at.s > s_min_ && at.s < s_max_; }
  double value(Bound bound, const Place& at, double x) const;
  Vec3 gradient(Bound bound, const Place& at) const;
  Mat3 hessian(Bound bound, const Vec3& p, Hint& hint) const;

  double x_min() const { return x_min_; }
  double x_max() const { return x_max_; }
  double s_min() const { return s_min_; }
  double s_max() const { return s_max_; }
  double steepest() const { return steepest_; }  ///< of |h'|
  double roll_middle() const { return 0.5 * (roll_.low + roll_.high); }
  double roll_half() const { return 0.5 * (roll_.high - roll_.low); }
  double roll_rate() const { return roll_.steepest; }
  double path_slope() const { return path_slope_; }
  const CutterPath& path() const { return path_; }
  const GraphCurve& section() const { return section_; }
  const ChordTree& chords() const { return chords_; }  ///< of the section
  double reach() const { return reach_; }              ///< greatest distance of the section from its origin
  /// Greatest z and widest y that the cutter reaches.
  double z_max() const { return z_max_; }
  double y_min() const { return y_min_; }
  double y_max() const { return y_max_; }
  std::size_t memory_bytes() const { return sizeof(*this) + path_.memory_bytes() + chords_.memory_bytes(); }

 private:
  void move_to(double x, Hint& hint) const;

  CutterPath path_;
  GraphCurve section_;
  ChordTree chords_;
  double x_min_, x_max_, s_min_, s_max_;
  double steepest_ = 0.0, path_slope_ = 0.0, reach_ = 0.0;
  double z_max_ = 0.0, y_min_ = 0.0, y_max_ = 0.0;
  CutterPath::Range roll_;
};

}  // namespace treadmark::analytic
