// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/force_balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

struct Outcome {
  ForceBalance::State state;
  double z;
  int evaluations;
};

Outcome iterate(ForceBalance::Target target, double z_touch, double guess, const std::function<double(double)>& force) {
  ForceBalance balance(target, 1e-6, guess);
  double z = balance.first(z_touch);
  auto state = ForceBalance::State::search;
  int n = 0;
  while (state == ForceBalance::State::search && n < 100) {
    ++n;
    state = balance.add(z, force(z), std::max(0.0, z_touch - z));
    if (state == ForceBalance::State::search) z = balance.next();
  }
  return {state, state == ForceBalance::State::found ? balance.next() : z, n};
}

Outcome iterate(double target, double z_touch, double guess, const std::function<double(double)>& force) {
  return iterate(ForceBalance::Target{.level = target}, z_touch, guess, force);
}

TEST(ForceBalance, HertzianContactTakesFewSteps) {
  const double stiffness = 9e10;
  const auto force = [&](double z) { return stiffness * std::pow(std::max(0.0, z - 3e-4), 1.5); };
  for (const double guess : {9e9, 9e10, 4e11}) {
    const Outcome o = iterate(1.25e5, 3e-4, guess, force);
    EXPECT_EQ(o.state, ForceBalance::State::found);
    EXPECT_NEAR(force(o.z), 1.25e5, 1e-6 * 1.25e5);
    EXPECT_LE(o.evaluations, 8) << guess;
  }
}

TEST(ForceBalance, GoodGuessTakesFourSteps) {
  // Stiffer with depth than a Hertzian contact: a secant through touching misses the slope by some per cent.
  const auto force = [](double z) { return 9e10 * std::pow(std::max(0.0, z), 1.5) * (1.0 + 1e3 * z); };
  for (const double guess : {9e10, 10.5e10}) {
    const Outcome o = iterate(1.25e5, 0.0, guess, force);
    EXPECT_EQ(o.state, ForceBalance::State::found);
    EXPECT_NEAR(force(o.z), 1.25e5, 1e-6 * 1.25e5);
    EXPECT_LE(o.evaluations, 4) << guess;
  }
}

TEST(ForceBalance, SlopeFromABalanceBeforeSparesSteps) {
  // The same contact a little deeper in the rail, whose stiffness and slope a balance before told.
  const auto force = [](double z) { return 9e10 * std::pow(std::max(0.0, z), 1.5) * (1.0 + 1e3 * z); };
  constexpr double kTarget = 1.25e5;
  const auto continued = [&](double target, double stiffness, double end_slope) {
    ForceBalance balance({.level = target}, 1e-5, stiffness, end_slope);
    double z = balance.first(0.0);
    int n = 1;
    while (balance.add(z, force(z), 0.0) == ForceBalance::State::search && n < 20) z = balance.next(), ++n;
    EXPECT_NEAR(force(z), target, 1e-5 * target);
    return std::tuple(n, target / std::pow(z, 1.5), balance.end_slope(z));
  };
  const auto [first, stiffness, end_slope] = continued(kTarget, 9e10, 0.0);
  // phi = (9e10)^(2/3) z (1 + 1e3 z)^(2/3) by hand.
  const double z = std::pow(kTarget / stiffness, 2.0 / 3.0);
  EXPECT_NEAR(end_slope, 1.0 + 2.0 / 3.0 * 1e3 * z / (1.0 + 1e3 * z), 0.01);
  EXPECT_EQ(std::get<0>(continued(1.005 * kTarget, 1.003 * stiffness, end_slope)), 2);
  EXPECT_GT(std::get<0>(continued(1.005 * kTarget, 1.003 * stiffness, 0.0)), 2);
  for (const double wrong : {0.1, 0.8, 3.0}) EXPECT_LE(std::get<0>(continued(kTarget, 1.01 * stiffness, wrong)), 4);
  // Nothing was told of a balance that was met at once.
  EXPECT_EQ(std::get<2>(continued(kTarget, stiffness, 0.9)), 0.9);
}

TEST(ForceBalance, SecondContactThatOpensOnTheWay) {
  const auto force = [](double z) {
    return 8e10 * std::pow(std::max(0.0, z), 1.5) + 2e11 * std::pow(std::max(0.0, z - 9e-5), 1.5);
  };
  const Outcome o = iterate(1.5e5, 0.0, 8e10, force);
  EXPECT_EQ(o.state, ForceBalance::State::found);
  EXPECT_NEAR(force(o.z), 1.5e5, 0.15);
}

TEST(ForceBalance, SaysWhenTheForceJumpsOverTheTarget) {
  const auto force = [](double z) { return z > 1e-4 ? 2e5 : 5e4; };
  EXPECT_EQ(iterate(1.25e5, 0.0, 8e10, force).state, ForceBalance::State::no_balance);
}

// Where a contact carries a load is chosen, and the spring unloaded so far below that it takes the same there.
TEST(ForceBalance, SpringsOfAnyStiffnessMeetTheContact) {
  constexpr double kTouching = 3e-4, kStiffness = 9e10, kEps = 1e-6;
  const auto force = [](double z) {
    const double depth = std::max(0.0, z - kTouching);
    return kStiffness * std::pow(depth, 1.5) * (1.0 + 1e3 * depth);
  };
  for (double spring = 1e5; spring < 2e13; spring *= 10.0)
    for (const double depth : {1e-6, 2e-5, 1e-4, 2e-4})
      for (const double guess : {0.3, 1.0, 3.0}) {
        SCOPED_TRACE(::testing::Message() << "spring " << spring << ", depth " << depth << ", guess " << guess);
        const double load = force(kTouching + depth);
        const ForceBalance::Target target{load + spring * (kTouching + depth), spring};
        const Outcome o = iterate(target, kTouching, guess * kStiffness, force);
        EXPECT_EQ(o.state, ForceBalance::State::found);
        EXPECT_NEAR(o.z, kTouching + depth, 5.0 * kEps * depth);
        EXPECT_NEAR(target.at(o.z), load, 5.0 * kEps * load);
        EXPECT_LE(o.evaluations, 7);
      }
}

TEST(ForceBalance, ASpringThatBearsNothingNeedsNoContact) {
  // What touches lies between elements and carries nothing: down to where the spring is unloaded.
  constexpr double kUnloaded = 1e-6;
  const Outcome o = iterate({.level = 1e9 * kUnloaded, .spring = 1e9}, 0.0, 9e10, [](double) { return 0.0; });
  EXPECT_EQ(o.state, ForceBalance::State::found);
  EXPECT_NEAR(o.z, kUnloaded, 1e-12);
}

TEST(ForceBalance, SaysWhenTheForceJumpsOverTheSpring) {
  const auto force = [](double z) { return z > 1e-4 ? 2e5 : z > 0.0 ? 5e4 : 0.0; };
  for (const double spring : {1e6, 1e9, 1e13}) {
    const ForceBalance::Target target{.level = 1.25e5 + 1e-4 * spring, .spring = spring};
    EXPECT_EQ(iterate(target, 0.0, 8e10, force).state, ForceBalance::State::no_balance) << spring;
  }
}

TEST(ForceBalance, RefusesAContactThatDoesNotStiffen) {
  for (const double stiffness : {0.0, -1e10, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(ForceBalance({.level = 1e5}, 1e-6, stiffness), Error) << stiffness;
}

TEST(ForceBalance, ComesBackFromLostContact) {
  const auto force = [](double z) { return 5e10 * std::pow(std::max(0.0, z - 1e-3), 1.5); };
  // The touching position given is 0.2 mm too high: the first try has no contact at all.
  ForceBalance balance({.level = 1e5}, 1e-6, 1e11);
  double z = balance.first(8e-4);
  auto state = ForceBalance::State::search;
  for (int i = 0; i < 50 && state == ForceBalance::State::search; ++i) {
    state = balance.add(z, force(z), std::max(0.0, 1e-3 - z));
    if (state == ForceBalance::State::search) z = balance.next();
  }
  EXPECT_EQ(state, ForceBalance::State::found);
}

}  // namespace
}  // namespace treadmark::wheelrail
