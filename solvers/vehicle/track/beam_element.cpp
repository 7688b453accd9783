// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/beam_element.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "treadmark/core/constants.hpp"

namespace treadmark::vehicle {

BeamElement::BeamElement(const RailBeam& beam, double length, const std::optional<Hinge>& hinge)
    : beam_(beam),
      length_(length),
      shear_(12.0 * beam.bending_stiffness / (beam.shear_stiffness * length * length)),
      hinge_(hinge) {
  if (!hinge) return;
  // Opened by 1 rad while nothing else bends, what lies behind it turns. Bending that back to ends that stand still
  // takes the moment r' K r at the hinge; coordinates q open it by the moment r' K q.
  free_ = BeamVector(0.0, 0.0, (1.0 - hinge->part) * length, 1.0);
  const BeamVector moment = whole_stiffness() * free_;
  against_ = hinge->stiffness + free_.dot(moment);
  angle_ = moment / against_;
}

BeamMatrix BeamElement::stiffness() const {
  return hinge_ ? BeamMatrix(whole_stiffness() - against_ * angle_ * angle_.transpose()) : whole_stiffness();
}

double BeamElement::opened(double p) const {
  return std::max(0.0, p - hinge_->part) * length_ - whole_deflection(p).dot(free_);
}

BeamVector BeamElement::deflection(double p) const {
  return hinge_ ? BeamVector(whole_deflection(p) + opened(p) * angle_) : whole_deflection(p);
}

BeamVector BeamElement::rotation(double p) const {
  if (!hinge_) return whole_rotation(p);
  return whole_rotation(p) + ((p >= hinge_->part ? 1.0 : 0.0) - whole_rotation(p).dot(free_)) * angle_;
}

double BeamElement::own_compliance(double p) const {
  if (!hinge_) return whole_compliance(p);
  const double by_angle = opened(p);
  return whole_compliance(p) + by_angle * by_angle / against_;
}

BeamMatrix BeamElement::whole_stiffness() const {
  const double l = length_, near = (4.0 + shear_) * l * l, far = (2.0 - shear_) * l * l;
  BeamMatrix k;
  k << 12.0, 6.0 * l, -12.0, 6.0 * l,   //
      6.0 * l, near, -6.0 * l, far,     //
      -12.0, -6.0 * l, 12.0, -6.0 * l,  //
      6.0 * l, far, -6.0 * l, near;
  return beam_.bending_stiffness / (l * l * l * (1.0 + shear_)) * k;
}

BeamVector BeamElement::whole_deflection(double p) const {
  const double p2 = p * p, p3 = p2 * p, s = shear_;
  return BeamVector(2.0 * p3 - 3.0 * p2 - s * p + 1.0 + s, length_ * (p3 - (2.0 + 0.5 * s) * p2 + (1.0 + 0.5 * s) * p),
                    -2.0 * p3 + 3.0 * p2 + s * p, length_ * (p3 - (1.0 - 0.5 * s) * p2 - 0.5 * s * p)) /
         (1.0 + s);
}

BeamVector BeamElement::whole_rotation(double p) const {
  const double p2 = p * p, s = shear_;
  return BeamVector(6.0 * (p2 - p) / length_, 3.0 * p2 - (4.0 + s) * p + 1.0 + s, -6.0 * (p2 - p) / length_,
                    3.0 * p2 - (2.0 - s) * p) /
         (1.0 + s);
}

template <class Visit>
void BeamElement::integrate(Visit&& visit) const {
  // Gauss' four points.
  constexpr std::array<double, 4> kPlaces{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                          0.8611363115940526};
  constexpr std::array<double, 4> kWeights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                           0.3478548451374538};
  const double kink = hinge_ ? hinge_->part : 1.0;
  for (const auto& [from, to] : {std::pair{0.0, kink}, {kink, 1.0}})
    for (std::size_t i = 0; i < kPlaces.size(); ++i)
      visit(from + 0.5 * (to - from) * (1.0 + kPlaces[i]), 0.5 * (to - from) * length_ * kWeights[i]);
}

BeamMatrix BeamElement::mass() const {
  BeamMatrix m = BeamMatrix::Zero();
  integrate([&](double part, double weight) {
    const BeamVector w = deflection(part), turn = rotation(part);
    m += weight * (beam_.mass * w * w.transpose() + beam_.rotary_inertia * turn * turn.transpose());
  });
  return m;
}

Eigen::Matrix<double, 4, 2> BeamElement::moments() const {
  Eigen::Matrix<double, 4, 2> sum = Eigen::Matrix<double, 4, 2>::Zero();
  integrate(
      [&](double part, double weight) { sum += weight * deflection(part) * Eigen::RowVector2d(1.0 - part, part); });
  return sum;
}

double BeamElement::whole_compliance(double part) const {
  if (!(part > 0.0 && part < 1.0)) return 0.0;
  const BeamMatrix before = BeamElement(beam_, part * length_).stiffness(),
                   after = BeamElement(beam_, (1.0 - part) * length_).stiffness();
  const Eigen::Matrix2d k = before.bottomRightCorner<2, 2>() + after.topLeftCorner<2, 2>();
  return k(1, 1) / k.determinant();
}

double pinned_pinned_frequency(const RailBeam& beam, double span) {
  const double k2 = kPi * kPi / (span * span), bending = beam.bending_stiffness * k2, shear = beam.shear_stiffness;
  // (shear k2 - m w2)(shear + bending - J w2) = shear2 k2 for w2, the square of the angular frequency.
  const double a = beam.mass * beam.rotary_inertia,
               b = beam.mass * (shear + bending) + beam.rotary_inertia * shear * k2, c = shear * k2 * bending;
  return std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c))) / (2.0 * kPi);
}

}  // namespace treadmark::vehicle
