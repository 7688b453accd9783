// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include <Eigen/Core>

#include "treadmark/model/vehicle/flexible_track.hpp"

namespace treadmark::vehicle {

using BeamVector = Eigen::Vector4d;
using BeamMatrix = Eigen::Matrix4d;

/// A finite element of Timoshenko's beam with the interpolation of Friedman and Kosmatka (1993), which is exact for
/// loads at its ends at rest. Coordinates: deflection and rotation of the section at its beginning and at its end; a
/// rotation is positive as the slope of the deflection. A hinge adds no coordinates: its angle is the one at rest.
class BeamElement {
 public:
  /// A hinge in it, at a part 0 ... 1 of the length, with a spring [N m/rad]; >= 0.
  struct Hinge {
    double part = 0.0, stiffness = 0.0;
  };

  /// length [m]; > 0
  BeamElement(const RailBeam& beam, double length, const std::optional<Hinge>& hinge = {});

  BeamMatrix stiffness() const;
  /// Consistent mass, that of rotation included.
  BeamMatrix mass() const;
  /// Integrals along the element of the deflections times 1 - part and times part [m].
  Eigen::Matrix<double, 4, 2> moments() const;
  /// Deflection at part 0 ... 1 of the length by the coordinates.
  BeamVector deflection(double part) const;
  /// Rotation of the section there, behind a hinge at that place.
  BeamVector rotation(double part) const;
  /// Further deflection [m/N] under a force at this place while the ends stand still: what the interpolation of the
  /// deflection cannot follow.
  double own_compliance(double part) const;

 private:
  /// visit(part, weight) at places whose weighted sum is the integral along the element of a polynomial of up to the
  /// seventh power to each side of a hinge.
  template <class Visit>
  void integrate(Visit&& visit) const;
  BeamMatrix whole_stiffness() const;
  BeamVector whole_deflection(double part) const;
  BeamVector whole_rotation(double part) const;
  double whole_compliance(double part) const;
  /// What opening the hinge by 1 rad moves places by while the ends stand still [m].
  double opened(double part) const;

  RailBeam beam_;
  double length_, shear_;  ///< shear_: 12 E I/(kappa G A l^2)
  std::optional<Hinge> hinge_;
  // Of the hinge: coordinates that its opening alone gives; moment that holds the ends over moment that opens it,
  // its spring included; angle by the coordinates.
  BeamVector free_ = BeamVector::Zero(), angle_ = BeamVector::Zero();
  double against_ = 0.0;  ///< [N m/rad]
};

/// Lowest frequency of a beam on hinges at both ends [Hz], which is that of a rail with nodes at its sleepers:
/// the smaller root of Timoshenko's equation for half a wave in the span. span [m]
double pinned_pinned_frequency(const RailBeam& beam, double span);

}  // namespace treadmark::vehicle
