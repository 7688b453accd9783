// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/analytic/defects/flat_depth.hpp"
#include "treadmark/backends/analytic/graph_curve.hpp"
#include "treadmark/backends/analytic/wheels/wheel_hull.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::analytic {

/// The steepest chords of a curve to the right and to the left of a point: whether a line that leaves the curve
/// there can meet it again is one comparison of slopes.
class ChordSlopes {
 public:
  explicit ChordSlopes(const GraphCurve& curve);
  /// Upper bound of (h(y2) - h(y))/(y2 - y) over y2 > y.
  double greatest_right(double y) const { return right_[cell(y)]; }
  /// Lower bound of (h(y) - h(y2))/(y - y2) over y2 < y.
  double least_left(double y) const { return left_[cell(y)]; }
  /// The other two: upper bound over y2 < y, lower bound over y2 > y.
  double greatest_left(double y) const { return left_most_[cell(y)]; }
  double least_right(double y) const { return right_least_[cell(y)]; }
  /// The first two as arrays by cell.
  struct Cells {
    const double* slopes;
    double begin, per_length;
    int count;
  };
  Cells towards(bool right) const {
    return {(right ? right_ : left_).data(), y_min_, per_length_, static_cast<int>(right_.size())};
  }
  std::size_t memory_bytes() const { return 4 * right_.capacity() * sizeof(double); }

 private:
  std::size_t cell(double y) const;
  double y_min_, per_length_;
  std::vector<double> right_, left_, right_least_, left_most_;
};

/// Wheel geometry without the Surface interface: r(theta, y) = R + z(y) - D(theta, y).
struct WheelBody {
  GraphCurve curve;
  double nominal_radius = 0.0;
  FlatDepth flats;
  ChordSlopes chords;
  WheelHull hull;
  std::vector<PieceLanes> pieces;  ///< for the kernels, as are these:
  std::vector<FlatLanes> narrow_flats;
  bool all_narrow = true;
  double r_min = 0.0;  ///< least radius, flats included
  double r_max = 0.0;  ///< greatest radius, rounded up

  /// Errors: Error(configuration) if the radius is not positive or the profile or a flat reaches the axle.
  WheelBody(GraphCurve profile, double radius, const std::vector<WheelFlat>& wheel_flats);
};

/// A point of the wheel with the gradient of F = r - r(theta, y) there.
struct WheelHit {
  double t = 0.0;
  double x = 0.0, y = 0.0, z = 0.0, r = 0.0;
  double f_theta = 0.0;  ///< dF/dtheta [m]
  double f_y = 0.0;      ///< dF/dy [-]
  double depth = 0.0;    ///< D [m]
};

/// Finds where lines o + t n meet a wheel, for one direction n: the hit with the greatest t on the half of the wheel
/// that faces +n. A guess costs one or two Newton steps. Their result is checked to be the outermost hit by comparing
/// the line's slope with chords of the profile; if that fails, an interval search with rigorous bounds decides.
/// One object serves one thread.
class WheelRay {
 public:
  WheelRay(const WheelBody& body, const Vec3& direction);

  /// False: no hit. guess = NaN: none. Without `exact` only t is final, the rest of the hit belongs to a point within
  /// kNear of it.
  bool cast(const Vec3& origin, double guess, WheelHit& hit, bool exact = true);
  static constexpr double kNear = 3e-8;  ///< [m]
  /// Everything about the last hit at exactly its t.
  void refine(WheelHit& hit);
  /// Whether the line through a point that was found on the wheel cannot meet it further out.
  static bool is_outermost(const WheelBody& body, const Vec3& direction, double spin, const WheelHit& hit);
  /// Whether the line of the last successful cast meets the wheel again below the hit.
  bool hides_others(const WheelHit& hit);

 private:
  struct Bracket {
    double t, g;
  };
  bool clip();
  double gap(double t, double& slope, WheelHit& at);
  bool newton(double guess, WheelHit& hit, bool exact);
  bool rises_to(const WheelHit& hit) const;
  double search(Bracket a, Bracket b, int depth);
  double polish(Bracket a, Bracket b);
  double radial_slope(double t) const;

  const WheelBody& body_;
  Vec3 n_;
  double a_ = 0.0;  ///< n_x^2 + n_z^2
  Vec3 o_ = Vec3::Zero();
  double closest_ = 0.0, spin_ = 0.0;  ///< t nearest to the axle; o_z n_x - o_x n_z
  double t_low_ = 0.0, t_high_ = 0.0;
  int piece_ = 0;
};

}  // namespace treadmark::analytic
