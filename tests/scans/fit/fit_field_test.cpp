// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/fit_field.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/scans/support/simple_cloud.hpp"

namespace treadmark::scans {
namespace {

using tests::kWheelRadius;

constexpr double kCloudNoise = 30e-6;

struct Fitted {
  Projection projection;
  LocalNoise noise;
  FitResult fit;
};

std::shared_ptr<const Surface> wheel_with_flat() {
  return create_surface({Body::wheel,
                         kWheelRadius,
                         StandardProfile{"S1002"},
                         {.flats = {{.length = 0.16, .depth = 1.4e-3, .theta_center = 0.7}}}});
}

Fitted fitted(const Surface& wheel, int stations, double noise_in, double outliers, const FitSettings& settings = {}) {
  const auto cloud =
      tests::simple_cloud(wheel, Body::wheel, -kPi, kPi, -60e-3, 60e-3, stations, 200, noise_in, outliers, Pose{}, 1);
  auto nominal = tests::nominal_points("S1002", Body::wheel);
  std::erase_if(nominal, [](const Vec2& p) { return p.x() < -60e-3 || p.x() > 60e-3; });
  for (Vec2& p : nominal) p.y() += kWheelRadius;
  Projection projection = project(cloud.points_S, {}, Pose{}, Section(nominal), {Body::wheel, kWheelRadius});
  const LocalNoise noise = find_noise(projection.points, projection.band, {});
  FitResult fit = fit_field(projection.points, projection.band, noise, settings);
  return {std::move(projection), noise, std::move(fit)};
}

struct TrueError {
  double rms, in_flat, most;
};
/// Distance of the fitted surface from the formula at random places.
TrueError true_error(const Surface& wheel, const Fitted& f) {
  double sum = 0.0, most = 0.0, count = 0.0, flat = 0.0, flats = 0.0;
  Random random(7);
  for (int k = 0; k < 8000; ++k) {
    const double a = f.projection.band.length() * random.uniform(),
                 s = f.projection.band.section.length() * (0.02 + 0.96 * random.uniform());
    const double u = (f.projection.band.a_min + a) / kWheelRadius;
    const auto at = f.projection.band.section.at(s);
    const Vec2 p = at.position + f.fit.field.value(a, s) * at.normal;
    std::vector<double> y{p.x()}, h(1), slope(1);
    HeightsOut heights;
    heights.z = h;
    heights.dzdy = slope;
    section_heights(wheel, Body::wheel, u, y, heights);
    const double error = (p.y() - h[0]) / std::hypot(1.0, slope[0]);
    sum += error * error;
    count += 1.0;
    most = std::max(most, std::fabs(error));
    if (std::fabs(u - 0.7) < 0.2) {
      flat += error * error;
      flats += 1.0;
    }
  }
  return {std::sqrt(sum / count), std::sqrt(flat / flats), most};
}

TEST(FitField, NoisyFlatOnAWheelIsFoundFarBelowTheNoise) {
  const auto wheel = wheel_with_flat();
  const Fitted f = fitted(*wheel, 2500, kCloudNoise, 0.01);
  EXPECT_TRUE(f.projection.band.closed);
  EXPECT_NEAR(f.noise.typical, kCloudNoise, 0.05 * kCloudNoise);
  // points held out do not know the fit: their scatter is the noise, and outliers that are left raise it a little
  EXPECT_NEAR(f.fit.held_out_rms, kCloudNoise, 0.05 * kCloudNoise);
  EXPECT_NEAR(static_cast<double>(f.fit.held_out) / static_cast<double>(f.fit.held_out + f.fit.used), 0.02, 0.002);
  const TrueError error = true_error(*wheel, f);
  EXPECT_LT(error.rms, 0.1 * kCloudNoise);
  EXPECT_LT(error.in_flat, 0.15 * kCloudNoise);
  EXPECT_LT(error.most, 1.5 * kCloudNoise);
}

TEST(FitField, PureNoiseCallsForNothingFine) {
  const auto round = create_surface({Body::wheel, kWheelRadius, StandardProfile{"S1002"}, {}});
  const Fitted f = fitted(*round, 1500, kCloudNoise, 0.0);
  std::size_t fine = 0;
  for (std::size_t k = 1; k < f.fit.levels.size(); ++k) fine += f.fit.levels[k].used;
  EXPECT_LT(fine, 150u) << "of hundreds of thousands of functions";
  EXPECT_LT(true_error(*round, f).rms, 0.04 * kCloudNoise);
}

TEST(FitField, WithoutNoiseThePointsAreMet) {
  const auto wheel = wheel_with_flat();
  const Fitted f = fitted(*wheel, 2500, 0.0, 0.0);
  EXPECT_LT(f.fit.residual_rms, 0.3e-6);
  EXPECT_LT(true_error(*wheel, f).rms, 1e-6);
}

TEST(FitField, TheSameForAnyNumberOfThreads) {
  const auto wheel = wheel_with_flat();
  std::vector<double> values;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const Fitted f = fitted(*wheel, 500, kCloudNoise, 0.01);
    values.push_back(f.fit.field.value(1.234, 0.05));
    values.push_back(f.fit.residual_rms);
  }
  EXPECT_EQ(values[0], values[2]);
  EXPECT_EQ(values[1], values[3]);
}

}  // namespace
}  // namespace treadmark::scans
