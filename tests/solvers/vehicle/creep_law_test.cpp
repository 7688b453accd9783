// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/creep_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

namespace treadmark::vehicle {
namespace {

const CreepContact kContact{6e-3, 4e-3, 0.3 * 8e4};
const CombinedMaterial kSteel = combine({});

wheelrail::ContactKinematics creepage(double xi, double eta, double phi, double chi = 0.0) {
  return {xi, eta, phi, 20.0, chi};
}

TEST(CreepLaw, VanishingCreepageIsLinearTheory) {
  const kalker::KalkerCoefficients c = kalker::kalker_coefficients(kContact.a, kContact.b, kSteel.poisson);
  const double g = kSteel.shear_modulus, area = kContact.a * kContact.b;
  const CreepForce f = creep_force(kContact, kSteel, creepage(2e-7, -3e-7, 4e-5));
  EXPECT_NEAR(f.force.x(), -g * area * c.c11 * 2e-7, 1e-3 * std::abs(f.force.x()));
  EXPECT_NEAR(f.force.y(), -g * area * (-3e-7 * c.c22 + 4e-5 * c.c23 * std::sqrt(area)), 1e-3 * std::abs(f.force.y()));
}

TEST(CreepLaw, LargeCreepageSlidesAgainstTheFriction) {
  const CreepForce f = creep_force(kContact, kSteel, creepage(0.03, 0.04, 0.0));
  EXPECT_NEAR(f.force.norm(), kContact.friction_bound, 1e-12 * kContact.friction_bound);
  EXPECT_LT(f.force.x(), 0.0);
  EXPECT_LT(f.force.y(), 0.0);
  EXPECT_EQ(creep_force({kContact.a, kContact.b, 0.0}, kSteel, creepage(0.03, 0.04, 0.1)).force.norm(), 0.0);
  EXPECT_EQ(creep_force(kContact, kSteel, {0.01, 0.0, 0.0, 0.0, 0.0}).force.norm(), 0.0);
}

TEST(CreepLaw, PowerIsThatOfTheForcesAndNeverNegative) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const double scale = std::pow(10.0, -4.0 + i % 4), spin = std::pow(10.0, -2.0 + i % 5);
    const auto k =
        creepage(scale * normal(random), scale * normal(random), spin * normal(random), i % 2 ? std::numbers::pi : 0.0);
    const CreepForce f = creep_force(kContact, kSteel, k);
    const double power = -k.velocity * (f.force.x() * k.xi + f.force.y() * k.eta + f.moment * k.phi);
    const double size =
        k.velocity * (std::abs(f.force.x() * k.xi) + std::abs(f.force.y() * k.eta) + std::abs(f.moment * k.phi));
    ASSERT_GE(f.power, 0.0);
    ASSERT_NEAR(f.power, power, 1e-12 * size);
    ASSERT_LE(f.force.norm(), kContact.friction_bound * (1.0 + 1e-12));
    ASSERT_GE(f.damping.minCoeff(), 0.0);
  }
}

TEST(CreepLaw, BackwardIsForwardTurnedAboutTheNormal) {
  const CreepForce f = creep_force(kContact, kSteel, creepage(1e-3, -4e-4, 0.3));
  const CreepForce b = creep_force(kContact, kSteel, creepage(-1e-3, 4e-4, 0.3, std::numbers::pi));
  EXPECT_EQ(b.force, -f.force);
  EXPECT_EQ(b.moment, f.moment);
}

TEST(CreepLaw, DampingIsTheDerivativeByVelocity) {
  const double h = 1e-9;
  for (const double size : {1e-5, 3e-4, 1e-3, 4e-3}) {
    const double xi = 0.8 * size, eta = -size;
    const CreepForce f = creep_force(kContact, kSteel, creepage(xi, eta, 0.0));
    const auto at = [&](double dx, double ds) {
      return creep_force(kContact, kSteel, creepage(xi + dx, eta + ds, 0.0)).force;
    };
    const double scale = creep_force(kContact, kSteel, creepage(0.0, 0.0, 0.0)).damping.x();
    EXPECT_NEAR(f.damping.x(), -(at(h, 0.0) - at(-h, 0.0)).x() / (2.0 * h * 20.0), 1e-6 * scale);
    EXPECT_NEAR(f.damping.y(), -(at(0.0, h) - at(0.0, -h)).y() / (2.0 * h * 20.0), 1e-6 * scale);
  }
}

}  // namespace
}  // namespace treadmark::vehicle
