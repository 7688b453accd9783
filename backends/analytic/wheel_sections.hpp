// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string_view>

#include "treadmark/backends/analytic/graph_curve.hpp"

namespace treadmark::analytic {

/// A tread of EN 13715:2020 with its flange and the slope of its field side.
struct WheelSection {
  enum class Tread { s1002, cone_40, eps };
  Tread tread = Tread::s1002;
  double flange_height = 28.0;     ///< h: 28 ... 32 [mm]
  double flange_thickness = 32.5;  ///< e: 28.5 ... 32.5 in steps of 0.5 [mm]
  double reverse_slope = 0.0;      ///< of the field side: 6.7 ... 15 [%]; 0: 1:15
};

/// "S1002", "1:40" (also "1/40"), "EPS", each alone or followed by what differs: "S1002/h30/e31/10%", in capital
/// letters and without blanks. Nothing for another name. Errors: Error(configuration) for a dimension that the standard
/// does not have.
std::optional<WheelSection> wheel_section(std::string_view name);

/// Tape circle at y = 0, flange back at y = -70 mm, field side up to the chamfer at y = 60 mm, z down. Between the
/// flange heights that are printed (28, 30, 32) the face is the circle of radius 20 + 0.75 (h - 28) tangent to its
/// neighbours.
GraphCurve wheel_curve(const WheelSection& section);

/// A tread that is straight, z = -slope y, for |y| <= 60 mm, without a flange.
GraphCurve cone_curve(double slope);

/// A tread that is hollow with the radius [mm] about its least radius at y = 0, for |y| <= 30 mm, without a flange.
GraphCurve hollow_curve(double radius_mm);

}  // namespace treadmark::analytic
