// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Uniform cubic B-splines in four parts that are not zero on an interval: place in the list of functions, and the
/// functions' values and derivatives by the parameter [1], [1/m], [1/m^2].
struct LineBasis {
  std::size_t first = 0;
  Eigen::Vector4d value, slope, bend;
};

/// How the frame of a line turns over the length, in its own axes.
struct LineTurn {
  double lateral = 0.0;   ///< curvature of the line to the right, along y [1/m]
  double vertical = 0.0;  ///< curvature of the line down, along z [1/m]
  double twist = 0.0;     ///< about x [rad/m]
};

/// The line along which a rail lies in a scan: a curve in space with a frame at every place, x along it, y to the right
/// and z into the rail. Places are lengths along it [m]. Cubic splines for the position and for the roll about x; the
/// roll counts from axes that do not turn about the line (double reflection; Wang, Juttler, Zheng and Liu 2008). Beyond
/// its ends it goes on with the curvature that it has there. Immutable; safe to use from several threads.
class RailLine {
 public:
  RailLine() = default;
  /// positions, rolls: coefficients of cubic B-splines [m], [rad], three more than intervals of the length step [m],
  /// the first of which begins at `from`. up: out of the rail at its beginning, roughly. The speed of the positions
  /// must be about 1. Errors: Error(input_data) for fewer than four coefficients, or up along the line.
  RailLine(double from, double step, std::vector<Vec3> positions, std::vector<double> rolls, const Vec3& up);

  double from() const { return from_; }
  double to() const { return from_ + step_ * static_cast<double>(intervals()); }
  double length() const { return to() - from_; }
  double step() const { return step_; }
  std::size_t intervals() const { return positions_.size() - 3; }

  Vec3 position(double along) const;
  /// Frame of the line in the cloud's.
  Pose at(double along) const;
  LineTurn turn(double along) const;
  /// Roll of the frame from the axes that do not turn [rad].
  double roll(double along) const;
  /// The axis out of the rail that does not turn about the line, from which roll counts.
  Vec3 up(double along) const;
  /// Length of the curve from the beginning, by quadrature; differs from along - from() as far as its speed is not 1.
  double arc(double along) const;

  LineBasis basis(double along) const;

  /// Where a point lies: x the place along the line whose plane across contains it, next to `near`; y and z in that
  /// plane. Nothing where Newton's method finds none, as behind the centre of a curve.
  std::optional<Vec3> locate(const Vec3& p_C, double near) const;
  /// The place of the node of the line nearest to a point, to start from.
  double nearest(const Vec3& p_C) const;

  /// Points of the cloud, straightened in place: each becomes its (x, y, z) of locate; those that have no place, which
  /// lie far off, as the nearest frame sees them. Parallel; the same for any number of threads.
  void straighten(std::span<Vec3> points) const;

 private:
  struct Local {
    Vec3 position, first, second;
  };
  Local local(double along) const;
  Vec3 unturned(double along, const Vec3& tangent) const;

  double from_ = 0.0, step_ = 1.0;
  std::vector<Vec3> positions_;
  std::vector<double> rolls_;
  double node_step_ = 1.0;
  std::vector<Vec3> nodes_;  ///< positions at even places
  std::vector<Vec3> ups_;    ///< out of the rail there, without roll; across the line
  std::vector<double> arcs_;
};

}  // namespace treadmark::scans
