// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include "treadmark/model/contact/friction.hpp"
#include "treadmark/model/contact/material.hpp"

namespace treadmark {
namespace {

constexpr double kMaterialRounding = 1e-15;

FrictionLaw law(FrictionLaw::Kind kind) {
  FrictionLaw f;
  f.kind = kind;
  f.kinetic = 0.2;
  f.amplitude_1 = 0.1;
  f.amplitude_2 = 0.05;
  f.half_velocity_1 = 2.0;
  f.half_velocity_2 = 0.5;
  return f;
}

TEST(FrictionLaw, CoulombDoesNotDependOnSlip) {
  FrictionLaw f;
  f.kinetic = 0.35;
  EXPECT_EQ(f.at(0.0), 0.35);
  EXPECT_EQ(f.at(7.0), 0.35);
  EXPECT_EQ(f.static_friction(), 0.35);
}

TEST(FrictionLaw, StartsAtTheStaticValue) {
  for (const auto kind : {FrictionLaw::Kind::linear, FrictionLaw::Kind::rational, FrictionLaw::Kind::exponential}) {
    EXPECT_NEAR(law(kind).at(0.0), 0.35, kMaterialRounding);
    EXPECT_NEAR(law(kind).static_friction(), 0.35, kMaterialRounding);
  }
}

TEST(FrictionLaw, HalvesEachAmplitudeAtItsHalfVelocity) {
  for (const auto kind : {FrictionLaw::Kind::linear, FrictionLaw::Kind::rational, FrictionLaw::Kind::exponential}) {
    FrictionLaw first = law(kind), second = law(kind);
    first.amplitude_2 = 0.0;
    second.amplitude_1 = 0.0;
    EXPECT_NEAR(first.at(2.0), 0.2 + 0.05, kMaterialRounding);
    EXPECT_NEAR(second.at(0.5), 0.2 + 0.025, kMaterialRounding);
  }
}

TEST(FrictionLaw, HasItsShape) {
  // by hand at w = 1: linear 0.2 + 0.1 (1 - 1/4) + 0.05 max(0, 1 - 1); rational 0.2 + 0.1/1.5 + 0.05/5;
  // exponential 0.2 + 0.1 2^-0.5 + 0.05 2^-2
  EXPECT_NEAR(law(FrictionLaw::Kind::linear).at(1.0), 0.275, kMaterialRounding);
  EXPECT_NEAR(law(FrictionLaw::Kind::rational).at(1.0), 0.2 + 0.2 / 3.0 + 0.01, kMaterialRounding);
  EXPECT_NEAR(law(FrictionLaw::Kind::exponential).at(1.0), 0.2 + 0.07071067811865475 + 0.0125, kMaterialRounding);
  // linear stops falling at twice the half velocity
  EXPECT_NEAR(law(FrictionLaw::Kind::linear).at(4.0), 0.2, kMaterialRounding);
  EXPECT_NEAR(law(FrictionLaw::Kind::linear).at(9.0), 0.2, kMaterialRounding);
}

TEST(CombinedMaterial, OfEqualBodiesIsTheirMaterial) {
  const CombinedMaterial c = combine({82e9, 82e9, 0.28, 0.28, 0.0});
  EXPECT_NEAR(c.shear_modulus, 82e9, 1e-3);
  EXPECT_NEAR(c.poisson, 0.28, kMaterialRounding);
  EXPECT_EQ(c.difference, 0.0);
}

TEST(CombinedMaterial, OfAluminiumAndSteelAgreesWithBentallAndJohnson) {
  // aluminium rail 23 GPa, 0.31 on steel wheel 82 GPa, 0.28 (Bentall and Johnson 1967): printed digits
  const CombinedMaterial c = combine({23e9, 82e9, 0.31, 0.28, 0.0});
  EXPECT_NEAR(c.shear_modulus, 35924e6, 0.5e6);
  EXPECT_NEAR(c.poisson, 0.3034, 0.5e-4);
  EXPECT_NEAR(c.difference, 0.100, 0.5e-3);
}

TEST(CombinedMaterial, DifferenceChangesSignWithTheBodies) {
  const CombinedMaterial a = combine({23e9, 82e9, 0.31, 0.28, 0.0}), b = combine({82e9, 23e9, 0.28, 0.31, 0.0});
  EXPECT_NEAR(a.difference, -b.difference, kMaterialRounding);
  EXPECT_GT(a.difference, 0.0);  // the rail is the softer body
}

TEST(CombinedMaterial, ReachesOneHalfAgainstARigidBody) {
  // G = 0.5, nu = 0 pressed by a rigid body: the greatest difference there is
  EXPECT_NEAR(combine({0.5, 1e12, 0.0, 0.0, 0.0}).difference, 0.5, 1e-11);
}

}  // namespace
}  // namespace treadmark
