// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/creep_law.hpp"

#include <cmath>

#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

namespace treadmark::vehicle {
namespace {

/// Share of the linear force that is transmitted, and the derivative of the transmitted by the linear force.
struct Limited {
  double share = 1.0, derivative = 1.0;
};
Limited limit(double linear_force, double bound) {
  if (!(bound > 0.0)) return {0.0, 0.0};
  const double u = linear_force / bound;
  if (u >= 3.0) return {1.0 / u, 0.0};
  return {1.0 - u / 3.0 + u * u / 27.0, (1.0 - u / 3.0) * (1.0 - u / 3.0)};
}

/// Share of the linear theory's lateral force of spin that is left where the contact slides: there the slips that spin
/// brings ahead of and behind its pole cancel out. A curve through solutions of the full theory for steep flange
/// contacts (S1002 on 60E1).
double spin_left(double linear_force, double bound) {
  constexpr double kHalved = 4.0;  // linear force over the friction bound
  if (!(bound > 0.0)) return 0.0;
  const double u = linear_force / (kHalved * bound);
  return 1.0 / (1.0 + u * u * u);
}

}  // namespace

CreepForce creep_force(const CreepContact& contact, const CombinedMaterial& material,
                       const wheelrail::ContactKinematics& k) {
  CreepForce out;
  if (!(k.velocity > 0.0)) return out;
  const kalker::KalkerCoefficients c = kalker::kalker_coefficients(contact.a, contact.b, material.poisson);
  const double size_squared = contact.a * contact.b, size = std::sqrt(size_squared);
  const double by_xi = material.shear_modulus * size_squared * c.c11,
               by_eta = material.shear_modulus * size_squared * c.c22;
  // Backwards is forwards turned about n: creepages change sign, spin does not.
  double by_phi = std::copysign(material.shear_modulus * size_squared * size * c.c23, std::cos(k.chi));
  by_phi *= spin_left(Vec2(by_xi * k.xi, by_eta * k.eta + by_phi * k.phi).norm(), contact.friction_bound);
  const Vec2 linear(-by_xi * k.xi, -by_eta * k.eta - by_phi * k.phi);
  const double magnitude = linear.norm();
  const Limited limited = limit(magnitude, contact.friction_bound);

  out.force = limited.share * linear;
  out.moment = limited.share * by_phi * k.eta;
  out.power = limited.share * k.velocity * (by_xi * k.xi * k.xi + by_eta * k.eta * k.eta);
  const Vec2 direction = magnitude > 0.0 ? Vec2(linear / magnitude) : Vec2::Zero();
  // Along the force its magnitude changes, across it its direction.
  const Vec2 along = direction.cwiseAbs2();
  const Vec2 slope = limited.derivative * along + limited.share * (Vec2::Ones() - along);
  out.damping = slope.cwiseProduct(Vec2(by_xi, by_eta)) / k.velocity;
  return out;
}

}  // namespace treadmark::vehicle
