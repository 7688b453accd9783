// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>

#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/nurbs/bezier_patch.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_kernels.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_limits.hpp"

namespace treadmark::spline {

/// Where a line along the plane normal meets a leaf.
struct LeafRoot {
  double s = 0.0, t = 0.0;                            ///< -1/2 .. 1/2
  double z = 0.0, dzdx = 0.0, dzdy = 0.0;             ///< in the plane frame
  double s_x = 0.0, s_y = 0.0, t_x = 0.0, t_y = 0.0;  ///< derivatives of (s, t) by the point of the plane
};

/// Box of the control points of a part in the plane frame, and the range of weights.
struct ControlBox {
  Interval x = Interval::none(), y = Interval::none(), z = Interval::none(), weight = Interval::none();
  explicit ControlBox(const BezierPatch& part);
};

/// A part of a patch in the plane frame, with what is needed to find S(s, t) = (x, y, .) safely. With the inverse
/// Jacobian A of the middle, the equations are A G(s, t) = 0, G = N_xy - (x, y) W, and A dG = 1 + E. Control points
/// bound E over the whole part: where |E| < 1 the equations have at most one solution, and (s, t) - A G contracts
/// towards it.
class NurbsLeaf {
 public:
  NurbsLeaf(const BezierPatch& part, const ControlBox& box);

  /// At most one solution, found from anywhere.
  bool regular() const { return regular_; }
  /// Of a part that is not: which direction to halve, the one in which it bends, or its weights change, more.
  bool bends_along_u() const { return bends_along_u_; }
  const ControlBox& box() const { return box_; }

  /// False: the line through (x, y) does not meet the leaf, regular or not: the control points of A G lie on one side
  /// of 0. This is a box in axes that suit the leaf. Otherwise s and t are set to the solution of the linear equations.
  bool may_meet(double x, double y, double& s, double& t) const {
    const double dx = x - middle_x_, dy = y - middle_y_;
    s = a_[0] * dx + a_[1] * dy;
    t = a_[2] * dx + a_[3] * dy;
    return upright_ || (meets(s, s_) && meets(t, t_));
  }

  /// The solution in a regular leaf from a first guess, or false if there is none. Damped Newton steps, then the
  /// contraction. exact: slopes, s and t to rounding, too.
  bool solve(double x, double y, double s, double t, bool exact, LeafRoot& root) const;

  /// Of a regular leaf, for the kernels.
  PatchPowers powers() const;

 private:
  // 0 in the range of A G: over the patch it is range - q W at the point with A (p - middle) = q.
  bool meets(double q, const Interval& range) const {
    const double a = q * box_.weight.low, b = q * box_.weight.high;
    return std::min(a, b) <= range.high && std::max(a, b) >= range.low;
  }
  bool contract(double x, double y, LeafRoot& root) const;
  double newton_step(double x, double y, LeafRoot& root, double& ds, double& dt) const;

  PowerPatch power_;
  double a_[4];  // inverse Jacobian at the middle
  double middle_x_, middle_y_;
  ControlBox box_;
  Interval s_, t_;
  bool regular_ = false, bends_along_u_ = false;
  bool upright_ = false;  // no inverse at the middle
};

}  // namespace treadmark::spline
