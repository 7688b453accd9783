// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/error_sources.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/scans/fit/half_fits.hpp"

namespace treadmark::scans {
namespace {

constexpr double kScatter = 10e-6;

/// Cells of 1 mm with some points each, and the residuals of these.
struct Sheet {
  BandPoints points;
  LocalNoise noise;
  std::vector<float> residual;

  Sheet(std::size_t rows, std::size_t columns, std::size_t of_cell, double shared, std::size_t side) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    points.rows = rows, points.columns = columns;
    points.cell_a = points.cell_s = 1e-3;
    noise.tile_rows = (rows + 15) / 16, noise.tile_columns = (columns + 15) / 16;
    noise.sigma.assign(noise.tile_rows * noise.tile_columns, static_cast<float>(kScatter));
    std::vector<double> blocks(rows * columns);
    for (double& block : blocks) block = shared * normal(random);
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t column = 0; column < columns; ++column) {
        points.begin.push_back(static_cast<std::uint32_t>(residual.size()));
        for (std::size_t k = 0; k < of_cell; ++k)
          residual.push_back(
              static_cast<float>(kScatter * normal(random) + blocks[row / side * columns + column / side]));
      }
    points.begin.push_back(static_cast<std::uint32_t>(residual.size()));
    points.d.assign(residual.size(), 0.0F);
    points.state.assign(residual.size(), PointState::used);
    points.index.resize(residual.size());
    std::iota(points.index.begin(), points.index.end(), std::uint32_t{0});
  }
};

TEST(SharedScatter, IsNoneWhereEveryPointScattersByItself) {
  const Sheet sheet(300, 120, 2, 0.0, 1);
  const SharedScatter found = shared_scatter(sheet.points, sheet.noise, sheet.residual);
  EXPECT_EQ(found.ratio, 1.0);
  EXPECT_EQ(found.length, 0.0);
}

TEST(SharedScatter, IsNoneWherePointsScatterByTheirOwnNoise) {
  constexpr float kNoisier = 4.0F;
  Sheet sheet(300, 120, 2, 0.0, 1);
  sheet.noise.factor.assign(sheet.residual.size(), 1.0F);
  for (std::size_t i = 0; i < sheet.residual.size(); i += 3)
    sheet.residual[i] *= kNoisier, sheet.noise.factor[i] = kNoisier;
  EXPECT_EQ(shared_scatter(sheet.points, sheet.noise, sheet.residual).ratio, 1.0);
  sheet.noise.factor = {};
  EXPECT_GT(shared_scatter(sheet.points, sheet.noise, sheet.residual).ratio, 2.0) << "what it would be taken for";
}

/// The variance of the mean of a block of 4 by 4 cells, 32 points, is the shared one and a 32nd of their scatter's.
TEST(SharedScatter, IsThatOfMeansOfManyPoints) {
  constexpr double kShared = 5e-6;
  const Sheet sheet(400, 120, 2, kShared, 4);
  const SharedScatter found = shared_scatter(sheet.points, sheet.noise, sheet.residual);
  const double expected = 1.0 + 32.0 * std::pow(kShared / kScatter, 2);
  EXPECT_NEAR(found.ratio, expected, 0.25 * expected);
  EXPECT_GE(found.length, 3e-3);
  EXPECT_LE(found.length, 9e-3);
}

/// A flat head with waves along it, of which two places have no points.
class ErrorFieldsOfWaves : public ::testing::Test {
 protected:
  static constexpr double kWave = 40e-3, kAmplitude = 20e-6, kHole = 20e-3, kLength = 0.4, kWidth = 60e-3;

  ErrorFieldsOfWaves() {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<Vec3> cloud;
    for (double x = 0.0; x < kLength; x += 0.8e-3)
      for (double y = -0.5 * kWidth; y < 0.5 * kWidth; y += 0.8e-3)
        cloud.emplace_back(x, y, -kAmplitude * std::sin(2.0 * kPi * x / kWave) - 5e-6 * normal(random));
    const Section flat(std::vector<Vec2>{{-40e-3, 0.0}, {-20e-3, 0.0}, {0.0, 0.0}, {20e-3, 0.0}, {40e-3, 0.0}});
    projection = project(cloud, {}, Pose{}, flat, {Body::rail, 1.0, 8e-3, 1e-3});
    noise = find_noise(projection.points, projection.band, {});
    fit = std::make_unique<FitResult>(fit_field(projection.points, projection.band, noise, {}));
    fitted = std::make_unique<FittedBand>(FittedBand{projection.band, fit->field, 15e-3, 65e-3, 0.0});
  }

  SurfaceErrors told(const Coverage& coverage) const {
    const std::vector<double> stations = error_stations(projection.band, {}, coverage.holes);
    SurfaceErrors errors = half_fit_errors(*fitted, projection.points, noise, {}, nullptr, stations, 0.0);
    add_error_sources({*fitted, projection.points, noise, *fit, coverage, {}},
                      shared_scatter(projection.points, noise, fit->residual), stations, errors);
    return errors;
  }

  Projection projection;
  LocalNoise noise;
  std::unique_ptr<FitResult> fit;
  std::unique_ptr<FittedBand> fitted;
};

TEST_F(ErrorFieldsOfWaves, NothingIsMadeUp) {
  const SurfaceErrors errors = told({});
  EXPECT_TRUE(errors.fields.empty());
  EXPECT_LT(size_of(errors).rms, 5e-6);
}

/// Half a hole away along it the waves are off their mean by all of their amplitude, across not at all.
TEST_F(ErrorFieldsOfWaves, HolesAreAsUncertainAsTheSurfaceVaries) {
  Coverage coverage;
  coverage.holes = {{0.21, 40e-3, kHole, 3e-4, true}, {0.3, 40e-3, kHole, 3e-4, false}};
  const SurfaceErrors errors = told(coverage);
  ASSERT_EQ(errors.fields.size(), 1u);
  EXPECT_EQ(errors.fields[0].source, ErrorSource::holes);
  EXPECT_DOUBLE_EQ(errors.fields[0].length, 0.5 * kHole);
  double largest = 0.0;
  for (std::size_t k = 0; k < errors.u.size(); ++k) {
    const double here = *std::max_element(errors.fields[0].sigma[k].begin(), errors.fields[0].sigma[k].end());
    if (std::abs(errors.u[k] - projection.band.a_min - 0.21) > 0.5 * kHole + 1e-3) {
      EXPECT_EQ(here, 0.0) << k;
    }
    largest = std::max(largest, here);
  }
  EXPECT_GT(largest, 0.4 * kAmplitude);
  EXPECT_LT(largest, 1.1 * kAmplitude);
}

TEST_F(ErrorFieldsOfWaves, ResidualsThatStayAreWhatSmoothingLeftOut) {
  constexpr double kLeft = 3e-6, kFrom = 24e-3, kTo = 28e-3;
  const BandPoints& points = projection.points;
  for (std::size_t row = 0; row < points.rows; ++row)
    for (std::size_t column = 0; column < points.columns; ++column) {
      const double s = points.cell_s * (static_cast<double>(column) + 0.5);
      if (s < kFrom || s >= kTo) continue;
      const std::size_t cell = row * points.columns + column;
      for (std::size_t i = points.begin[cell]; i < points.begin[cell + 1]; ++i)
        fit->residual[i] += static_cast<float>(kLeft);
    }
  const SurfaceErrors errors = told({});
  ASSERT_EQ(errors.fields.size(), 1u);
  EXPECT_EQ(errors.fields[0].source, ErrorSource::smoothing);
  const std::vector<double>& sigma = errors.fields[0].at(5);
  const double largest = *std::max_element(sigma.begin(), sigma.end());
  EXPECT_GT(largest, 0.4 * kLeft) << "at least half of a strip";
  EXPECT_LT(largest, 1.2 * kLeft);
  constexpr double kStrip = 5e-3;
  const double step = 50e-3 / static_cast<double>(sigma.size() - 1);
  for (std::size_t i = 0; i < sigma.size(); ++i)
    if (const double s = 15e-3 + step * static_cast<double>(i); s < kFrom - kStrip || s > kTo + kStrip) {
      EXPECT_EQ(sigma[i], 0.0) << s;
    }
}

}  // namespace
}  // namespace treadmark::scans
