// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <Eigen/Core>

#include "treadmark/model/flexible_track.hpp"

namespace treadmark::vehicle {

using BeamVector = Eigen::Vector4d;
using BeamMatrix = Eigen::Matrix4d;

/// A finite element of Timoshenko's beam with the interpolation of Friedman and Kosmatka (1993), which is exact for
/// loads at its ends at rest. Coordinates: deflection and rotation of the section at its beginning and at its end; a
/// rotation is positive as the slope of the deflection.
class BeamElement {
 public:
  /// length [m]; > 0
  BeamElement(const RailBeam& beam, double length);

  BeamMatrix stiffness() const;
  /// Consistent mass, that of rotation included.
  BeamMatrix mass() const;
  /// Deflection at part 0 ... 1 of the length by the coordinates.
  BeamVector deflection(double part) const;
  /// Slope of the deflection there, shear included.
  BeamVector slope(double part) const;
  /// Rotation of the section there.
  BeamVector rotation(double part) const;
  /// Further deflection [m/N] under a force at this place while the ends stand still: what the interpolation of the
  /// deflection cannot follow.
  double own_compliance(double part) const;
  /// Its derivative along the element [1/N].
  double own_compliance_slope(double part) const;

 private:
  RailBeam beam_;
  double length_, shear_;  ///< shear_: 12 E I/(kappa G A l^2)
};

/// Lowest frequency of a beam on hinges at both ends [Hz], which is that of a rail with nodes at its sleepers:
/// the smaller root of Timoshenko's equation for half a wave in the span. span [m]
double pinned_pinned_frequency(const RailBeam& beam, double span);

}  // namespace treadmark::vehicle
