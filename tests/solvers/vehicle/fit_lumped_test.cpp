// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/fit_lumped.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "beam_on_bed.hpp"
#include "small_vehicles.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/support/counting_token.hpp"

namespace treadmark::vehicle {
namespace {

using Complex = std::complex<double>;

std::vector<double> frequencies(int count) {
  std::vector<double> f;
  for (int i = 0; i < count; ++i) f.push_back(10.0 * std::pow(150.0, i / (count - 1.0)));
  return f;
}

std::vector<Complex> on_bed(const std::vector<double>& frequency) {
  const FlexibleTrack track = zhai_track();
  std::vector<Complex> h;
  for (const double f : frequency) {
    const double w = 2.0 * kPi * f;
    h.push_back(infinite_beam(track.rail, bed_stiffness(track.seats[0], 0.545, w), w));
  }
  return h;
}

TEST(LumpedReceptance, IsThatOfAMassOnASpring) {
  const std::vector<LumpedLayer> one{{200.0, 6e7, 5e4}};
  for (const double f : {1.0, 30.0, 87.0, 400.0}) {
    const double w = 2.0 * kPi * f;
    EXPECT_LT(std::abs(receptance(one, f) * Complex(6e7 - 200.0 * w * w, 5e4 * w) - 1.0), 1e-13);
  }
}

/// Against the matrices of the simulation, with a rail on a sleeper.
TEST(LumpedReceptance, IsThatOfTheSimulatedTrack) {
  TrackModel track = rails_on_springs(60.0, 1e8, 2e4);
  for (const char* side : {"left", "right"}) {
    const double y = side[0] == 'l' ? -0.75 : 0.75;
    track.bodies.push_back(body(std::string(side) + "_sleeper", 120.0, {1, 1, 1}, {0, y, 0.3}, kVertical));
    for (SpringSpec& s : track.springs)
      if (s.body_a == std::string(side) + "_rail") s.body_b = std::string(side) + "_sleeper";
    track.springs.push_back(
        spring(std::string(side) + "_sleeper", kGround, {0, y, 0.4}, {0, 0, 3e8, 0, 0, 0}, {0, 0, 1e5, 0, 0, 0}));
  }
  const Multibody s = assemble(wheel_on_mass(1000.0, 5000.0, 1e6, 1e4), track, 20.0, kGravity);
  const std::vector<LumpedLayer> layers{{60.0, 1e8, 2e4}, {120.0, 3e8, 1e5}};
  const int z = s.rails[0].coordinate[1];
  for (const double f : {5.0, 60.0, 250.0, 900.0}) {
    const double w = 2.0 * kPi * f;
    Eigen::MatrixXcd dynamic = s.stiffness.cast<Complex>() + Complex(0.0, w) * s.damping.cast<Complex>();
    dynamic.diagonal() -= (w * w * s.mass).cast<Complex>();
    const Complex h = dynamic.inverse()(z, z);
    EXPECT_LT(std::abs(receptance(layers, f) / h - 1.0), 1e-10) << f;
  }
}

TEST(FitLumped, FindsLayersAgain) {
  const std::vector<LumpedLayer> layers{{30.0, 2e8, 1.5e5}, {300.0, 3e8, 1e5}};
  const std::vector<double> f = frequencies(40);
  std::vector<Complex> h;
  for (const double one : f) h.push_back(receptance(layers, one));
  const LumpedFit fit = fit_lumped(f, h, 2);
  EXPECT_EQ(fit.report.status, Status::ok);
  ASSERT_EQ(fit.layers.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(fit.layers[i].mass / layers[i].mass, 1.0, 1e-4);
    EXPECT_NEAR(fit.layers[i].stiffness / layers[i].stiffness, 1.0, 1e-4);
    EXPECT_NEAR(fit.layers[i].damping / layers[i].damping, 1.0, 1e-4);
  }
  EXPECT_LT(fit.error.rms, 1e-6);
}

/// Fits to the closed form of Zhai's track on a bed, 10 to 1500 Hz, which another program made. Sixty frequencies, even
/// in the logarithm; its own were others, hence the share by which numbers may differ.
TEST(FitLumped, AgreesWithFitsOfAnotherProgram) {
  constexpr double kOtherFrequencies = 0.025;
  const std::vector<double> f = frequencies(60);
  const std::vector<Complex> h = on_bed(f);
  const LumpedFit two = fit_lumped(f, h, 2), three = fit_lumped(f, h, 3);
  const auto near = [&](const LumpedLayer& found, const LumpedLayer& other) {
    EXPECT_NEAR(found.mass / other.mass, 1.0, kOtherFrequencies);
    EXPECT_NEAR(found.stiffness / other.stiffness, 1.0, kOtherFrequencies);
    EXPECT_NEAR(found.damping / other.damping, 1.0, kOtherFrequencies);
  };
  near(two.layers[0], {7.863, 191.5e6, 191.9e3});
  near(two.layers[1], {286.6, 267.2e6, 155.8e3});
  EXPECT_NEAR(two.error.rms, 0.09, 0.005);
  // The lightest mass is hardly felt: 0.65 kg there.
  near(three.layers[1], {83.67, 304.3e6, 211.6e3});
  near(three.layers[2], {305.9, 363.9e6, 206.9e3});
  EXPECT_NEAR(three.error.rms, 0.016, 0.0005);
  // Masses and springs that keep stiffness and frequency at rest are no fit.
  const std::vector<LumpedLayer> by_rest{{83.263, 1.63761e8, 1.88955e5}, {316.185, 3.47047e8, 1.4814e5}};
  EXPECT_NEAR(receptance_error(by_rest, f, h).rms, 0.73, 0.005);
}

TEST(FitLumped, NoMassVanishes) {
  std::vector<double> f;
  for (int i = 0; i < 60; ++i) f.push_back(10.0 + 1490.0 * i / 59.0);
  const std::vector<LumpedLayer> layers = fit_lumped(f, on_bed(f), 3).layers;
  ASSERT_EQ(layers.size(), 3u);
  for (const LumpedLayer& layer : layers) {
    EXPECT_GT(layer.mass, 0.01);
    EXPECT_GT(layer.stiffness, 1e6);
    EXPECT_GT(layer.damping, 1e3);
  }
}

TEST(FitLumped, RefusesWhatCannotBeFitted) {
  const std::vector<double> f = frequencies(20);
  std::vector<Complex> h = on_bed(f);
  EXPECT_THROW(fit_lumped(f, h, 0), Error);
  EXPECT_THROW(fit_lumped(f, h, 4), Error);
  EXPECT_THROW(fit_lumped(std::span(f).first(2), std::span<const Complex>(h).first(2), 2), Error);
  EXPECT_THROW(fit_lumped(f, std::span<const Complex>(h).first(19), 2), Error);
  h[3] = 0.0;
  EXPECT_THROW(fit_lumped(f, h, 2), Error);
}

TEST(FitLumped, AsksInEveryIterationWhetherItIsToEnd) {
  const std::vector<double> f = frequencies(20);
  const std::vector<Complex> h = on_bed(f);
  const testing::CountingToken never;
  {
    const CancellationScope scope(&never);
    fit_lumped(f, h, 2);
  }
  EXPECT_GT(never.passed(), 100);
  const testing::CountingToken soon(50);
  const CancellationScope scope(&soon);
  EXPECT_THROW(fit_lumped(f, h, 2), Cancelled);
  EXPECT_EQ(soon.passed(), 50);
}

}  // namespace
}  // namespace treadmark::vehicle
