// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/beam_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "treadmark/core/constants.hpp"

namespace treadmark::vehicle {

BeamElement::BeamElement(const RailBeam& beam, double length)
    : beam_(beam), length_(length), shear_(12.0 * beam.bending_stiffness / (beam.shear_stiffness * length * length)) {}

BeamMatrix BeamElement::stiffness() const {
  const double l = length_, near = (4.0 + shear_) * l * l, far = (2.0 - shear_) * l * l;
  BeamMatrix k;
  k << 12.0, 6.0 * l, -12.0, 6.0 * l,   //
      6.0 * l, near, -6.0 * l, far,     //
      -12.0, -6.0 * l, 12.0, -6.0 * l,  //
      6.0 * l, far, -6.0 * l, near;
  return beam_.bending_stiffness / (l * l * l * (1.0 + shear_)) * k;
}

BeamVector BeamElement::deflection(double p) const {
  const double p2 = p * p, p3 = p2 * p, s = shear_;
  return BeamVector(2.0 * p3 - 3.0 * p2 - s * p + 1.0 + s, length_ * (p3 - (2.0 + 0.5 * s) * p2 + (1.0 + 0.5 * s) * p),
                    -2.0 * p3 + 3.0 * p2 + s * p, length_ * (p3 - (1.0 - 0.5 * s) * p2 - 0.5 * s * p)) /
         (1.0 + s);
}

BeamVector BeamElement::slope(double p) const {
  const double p2 = p * p, s = shear_;
  return BeamVector((6.0 * p2 - 6.0 * p - s) / length_, 3.0 * p2 - (4.0 + s) * p + 1.0 + 0.5 * s,
                    (-6.0 * p2 + 6.0 * p + s) / length_, 3.0 * p2 - (2.0 - s) * p - 0.5 * s) /
         (1.0 + s);
}

BeamVector BeamElement::rotation(double p) const {
  const double p2 = p * p, s = shear_;
  return BeamVector(6.0 * (p2 - p) / length_, 3.0 * p2 - (4.0 + s) * p + 1.0 + s, -6.0 * (p2 - p) / length_,
                    3.0 * p2 - (2.0 - s) * p) /
         (1.0 + s);
}

BeamMatrix BeamElement::mass() const {
  // Gauss' four points: exact up to the seventh power, the products here have the sixth.
  constexpr std::array<double, 4> kPlaces{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                          0.8611363115940526};
  constexpr std::array<double, 4> kWeights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                           0.3478548451374538};
  BeamMatrix m = BeamMatrix::Zero();
  for (std::size_t i = 0; i < kPlaces.size(); ++i) {
    const double part = 0.5 * (1.0 + kPlaces[i]), weight = 0.5 * length_ * kWeights[i];
    const BeamVector w = deflection(part), turn = rotation(part);
    m += weight * (beam_.mass * w * w.transpose() + beam_.rotary_inertia * turn * turn.transpose());
  }
  return m;
}

double BeamElement::own_compliance(double part) const {
  if (!(part > 0.0 && part < 1.0)) return 0.0;
  const BeamMatrix before = BeamElement(beam_, part * length_).stiffness(),
                   after = BeamElement(beam_, (1.0 - part) * length_).stiffness();
  const Eigen::Matrix2d k = before.bottomRightCorner<2, 2>() + after.topLeftCorner<2, 2>();
  return k(1, 1) / k.determinant();
}

double BeamElement::own_compliance_slope(double part) const {
  // A quotient of polynomials: differences over this share of the length are exact to ten digits.
  constexpr double kStep = 1e-4;
  const double low = std::max(0.0, part - kStep), high = std::min(1.0, part + kStep);
  return (own_compliance(high) - own_compliance(low)) / ((high - low) * length_);
}

double pinned_pinned_frequency(const RailBeam& beam, double span) {
  const double k2 = kPi * kPi / (span * span), bending = beam.bending_stiffness * k2, shear = beam.shear_stiffness;
  // (shear k2 - m w2)(shear + bending - J w2) = shear2 k2 for w2, the square of the angular frequency.
  const double a = beam.mass * beam.rotary_inertia,
               b = beam.mass * (shear + bending) + beam.rotary_inertia * shear * k2, c = shear * k2 * bending;
  return std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c))) / (2.0 * kPi);
}

}  // namespace treadmark::vehicle
