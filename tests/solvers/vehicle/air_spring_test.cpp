// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/solvers/vehicle/force_elements.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kBellows = 0.03, kReservoir = 0.02, kArea = 0.25, kAtRest = 5e5;  // [m3], [m2], [Pa]

ForceElements air(double exponent, double resistance, double reservoir = kReservoir) {
  ForceElements e;
  e.columns.resize(1);
  e.air_springs.push_back({"air", 0, kArea, kBellows, reservoir, exponent, resistance, kAtRest,
                           exponent * kAtRest * kArea * kArea / (kBellows + reservoir)});
  return e;
}

Vector one(double value) { return Vector::Constant(1, value); }

/// Of the gas at this volume, beyond what it bears at rest.
double by_gas_law(double volume, double compression, double exponent) {
  return kArea * kAtRest * (std::pow(volume / (volume - kArea * compression), exponent) - 1.0);
}

TEST(AirSpring, BearsByTheGasLawSlowlyAndFast) {
  constexpr double kFast = 1e-9;  // in which nothing flows [s]
  for (const double n : {1.0, 1.4}) {
    const ForceElements e = air(n, 1e8), without = air(n, 0.0, 0.0);
    const double linear = e.air_springs[0].linear;
    for (const double c : {-0.06, -0.01, 0.0, 0.002, 0.05}) {
      const auto force = [&](const ForceElements& of, double duration) {
        const ElementResponse r = respond(of, one(c), one(0.0), of.fresh_memory(), duration);
        return r.force[0] + of.air_springs[0].linear * c;
      };
      EXPECT_NEAR(force(e, kInfinity), by_gas_law(kBellows + kReservoir, c, n), 1e-6) << n << ' ' << c;
      EXPECT_NEAR(force(e, kFast), by_gas_law(kBellows, c, n), 1e-2) << n << ' ' << c;
      EXPECT_NEAR(force(without, 1.0), by_gas_law(kBellows, c, n), 1e-6) << n << ' ' << c;
    }
    const ElementResponse still = respond(e, one(0.0), one(0.0), e.fresh_memory());
    EXPECT_NEAR(still.stiffness(0, 0), 0.0, 1e-9 * linear);  // the linear spring is all of it
    EXPECT_NEAR(still.memory[e.memory_of_air(0) + 1], kAtRest, 1e-6);
    // nothing is left of its volume
    EXPECT_TRUE(std::isnan(respond(e, one(0.3), one(0.0), e.fresh_memory(), 1.0).force[0]));
    EXPECT_TRUE(std::isnan(respond(without, one(0.13), one(0.0), without.fresh_memory(), 1.0).force[0]));
  }
}

TEST(AirSpring, TangentsAreDerivatives) {
  constexpr double h = 1e-8;
  for (const double c : {-0.02, 0.001, 0.04})
    for (const double duration : {1e-3, 0.1, kInfinity})
      for (const double gone : {-0.0015, 0.003}) {  // there is flow: about none, differences see its square
        const ForceElements e = air(1.4, 1e8);
        Vector memory = e.fresh_memory();
        memory[e.memory_of_air(0)] = gone;
        const auto force = [&](double at) { return respond(e, one(at), one(0.0), memory, duration).force[0]; };
        const double slope = (force(c + h) - force(c - h)) / (2.0 * h);
        EXPECT_NEAR(respond(e, one(c), one(0.0), memory, duration).stiffness(0, 0), slope,
                    1e-4 * std::abs(slope) + 10.0)
            << c << ' ' << duration << ' ' << gone;
      }
}

/// Of one period of a sine, after a first one.
struct Loop {
  double work = 0.0, by_orifice = 0.0, stored = 0.0;  ///< [J]
};
Loop loop_of(const ForceElements& e, double amplitude, double omega) {
  constexpr int kSteps = 20000;
  const double step = 2.0 * std::numbers::pi / omega / kSteps, linear = e.air_springs[0].linear;
  Loop loop;
  const Eigen::Index place = e.memory_of_air(0);
  Vector memory = e.fresh_memory();
  double before = 0.0, at = 0.0;
  for (int i = 1; i <= 2 * kSteps; ++i) {
    const double c = amplitude * std::sin(omega * step * i);
    const ElementResponse r = respond(e, one(c), one(0.0), memory, step);
    const double force = r.force[0] + linear * c, flow = (r.memory[place] - memory[place]) / step;
    if (i > kSteps) {
      loop.work += 0.5 * (force + before) * (c - at);
      loop.by_orifice += e.air_springs[0].resistance * std::abs(flow * flow * flow) * step;
    }
    before = force, at = c, memory = r.memory;
    if (i % kSteps == 0) loop.stored = e.energy(one(c), memory) - loop.stored;
  }
  return loop;
}

/// Where the orifice takes little of the pressure, the share b of the volume's change flows through it: it takes
/// R |q'|^3, 8/3 R (b A a)^3 w^2 a period.
TEST(AirSpring, SmallLoopsHaveTheAreaInClosedForm) {
  constexpr double kAmplitude = 2e-3, kResistance = 2e8, kShare = kReservoir / (kBellows + kReservoir);
  for (const double omega : {1.5, 3.0}) {
    const Loop loop = loop_of(air(1.4, kResistance), kAmplitude, omega);
    const double area = 8.0 / 3.0 * kResistance * std::pow(kShare * kArea * kAmplitude, 3.0) * omega * omega;
    EXPECT_NEAR(loop.work / area, 1.0, 0.02) << omega;
    EXPECT_NEAR(loop.by_orifice / area, 1.0, 0.02) << omega;
  }
}

/// Of any size: what goes into a loop is what the orifice takes and the gas keeps.
TEST(AirSpring, LoopsLoseWhatTheOrificeTakes) {
  const ForceElements e = air(1.3, 3e9);
  const Loop loop = loop_of(e, 0.03, 6.0);
  EXPECT_GT(loop.work, 10.0);
  EXPECT_NEAR((loop.by_orifice + loop.stored) / loop.work, 1.0, 0.01);
}

/// The energy's derivative by the compression is the force while nothing flows, that by what has flown the difference
/// of pressures.
TEST(AirSpring, ItsEnergyIsAPotential) {
  const ForceElements e = air(1.4, 1e8);
  constexpr double kFast = 1e-9, h = 1e-6;
  Vector memory = e.fresh_memory();
  memory[e.memory_of_air(0)] = 0.004;
  const auto energy = [&](double c, double gone) {
    Vector at = memory;
    at[e.memory_of_air(0)] = gone;
    return e.energy(one(c), at);
  };
  for (const double c : {-0.02, 0.03}) {
    EXPECT_NEAR((energy(c + h, 0.004) - energy(c - h, 0.004)) / (2.0 * h),
                respond(e, one(c), one(0.0), memory, kFast).force[0], 0.1);
    const double left = kAtRest * std::pow(kBellows / (kBellows - kArea * c + 0.004), 1.4),
                 right = kAtRest * std::pow(kReservoir / (kReservoir - 0.004), 1.4);
    EXPECT_NEAR((energy(c, 0.004 + h) - energy(c, 0.004 - h)) / (2.0 * h), right - left, 1.0);
  }
}

}  // namespace
}  // namespace treadmark::vehicle
