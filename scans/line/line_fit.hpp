// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "treadmark/scans/line/rail_line.hpp"

namespace treadmark::scans {

/// Where a window of points along a rail says that its line is.
struct LineTarget {
  double along = 0.0;               ///< [m]
  Vec3 position = Vec3::Zero();     ///< in the cloud's frame [m]
  double roll = 0.0;                ///< from the axes of the line that do not turn [rad]
  Mat3 axes = Mat3::Identity();     ///< of the frame there, in the cloud's
  Mat3 information = Mat3::Zero();  ///< of shifts along y and z [1/m^2] and of the roll [1/rad^2]
};

/// What a line is made of.
struct LineShape {
  enum class Kind { straight, even_bend, splines };
  Kind kind = Kind::straight;
  std::size_t intervals = 1;  ///< of splines

  /// Numbers that are free.
  double numbers() const;
};

struct LineFit {
  RailLine line;
  /// Sum of the targets' squared distances over their errors, of none more than a far one's.
  double loss = 0.0;
  std::vector<LineTurn> errors;  ///< standard errors at the places that were asked for
};

/// A line from `from` to `to` [m] through targets: least squares with Tukey's weights for whole targets, so that damage
/// does not bend it. scatter: what the targets scatter by over what their information says. up: as RailLine's.
/// errors_at: places whose errors are wanted. Errors: Error(input_data) for fewer targets than the shape needs.
LineFit fit_line(std::span<const LineTarget> targets, const LineShape& shape, double from, double to, double scatter,
                 const Vec3& up, std::span<const double> errors_at = {});

}  // namespace treadmark::scans
