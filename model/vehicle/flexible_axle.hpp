// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// How a wheelset bends and twists beside its motion as a rigid body, as plain data in SI units: vibrations of the free
/// wheelset at rest, axle and rigid wheels together (docs/flexible-wheelset.md). y along the axle, to the right, from
/// its middle.

/// A vibration in a plane through the axle; there is one in the vertical and an equal one in the horizontal plane.
struct BendingMode {
  double mass = 0.0;          ///< of the shape as it is scaled here [kg]; > 0
  double stiffness = 0.0;     ///< mass times the square of the angular frequency [N/m]; > 0
  double damping = 0.0;       ///< [N s/m]; >= 0
  std::vector<double> shape;  ///< displacement at the places of the axle
  std::vector<double> slope;  ///< its derivative along the axle there [1/m]
  SourcePosition where;
};

/// A vibration about the axle.
struct TorsionMode {
  double inertia = 0.0;                    ///< of the shape as it is scaled here [kg m2]; > 0
  double stiffness = 0.0;                  ///< [N m/rad]; > 0
  double damping = 0.0;                    ///< [N m s/rad]; >= 0
  std::array<double, 2> wheel_rotation{};  ///< of the left and the right wheel
  SourcePosition where;
};

/// An axle with its wheels.
struct FlexibleAxle {
  std::string name;
  double wheel_distance = 0.0;       ///< of the middle planes of both wheels [m]; > 0
  double wheel_polar_inertia = 0.0;  ///< of one wheel about the axle [kg m2]; >= 0
  std::vector<double> places;        ///< y of wheels, axle boxes and what else is of interest, increasing [m]
  std::vector<BendingMode> bending;
  std::vector<TorsionMode> torsion;
  SourcePosition where;
};

/// Errors: Error(configuration) at the axle or its mode for what cannot be.
void check_axle(const FlexibleAxle& axle);

/// Shape and slope of a bending mode at y between its places: exact there, cubic between.
struct AxleDeflection {
  double displacement = 0.0;  ///< 1
  double slope = 0.0;         ///< [1/m]
};
/// y: to the right of the middle, between the outermost places [m].
AxleDeflection deflection_at(const FlexibleAxle& axle, const BendingMode& mode, double y);

}  // namespace treadmark
