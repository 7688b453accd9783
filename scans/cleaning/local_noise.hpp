// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "treadmark/scans/cleaning/band_points.hpp"

namespace treadmark::scans {

struct NoiseSettings {
  double outlier_factor =
      4.5;  ///< points farther from their surroundings than this many standard deviations are outliers; 0 = none are
  double least_outlier =
      10e-6;                    ///< nothing nearer to its surroundings is an outlier, however little noise there is [m]
  double least_noise = 0.1e-6;  ///< standard deviations below count as this [m]
  double most_flagged = 0.2;  ///< where more of the surroundings would be outliers they are an edge or a step, and stay
  int window = 0;             ///< as LocalNoise::window; 0: by the density of the points
  double typical = 0.0;       ///< as LocalNoise::typical [m]; 0: by the points
  bool residuals = false;     ///< fill LocalNoise::residual
};

/// Scatter of the points about smooth local surfaces, and the points that stand out of it.
struct LocalNoise {
  std::size_t tile_rows = 0, tile_columns = 0;  ///< tiles of kTileCells x kTileCells cells
  std::vector<float> sigma;                     ///< of a tile: robust standard deviation [m]
  double typical = 0.0;                         ///< median over the points [m]
  std::size_t outliers = 0, spared = 0;         ///< spared: left in because their surroundings are an edge
  std::size_t isolated = 0;                     ///< points with hardly any others around them: outliers too
  int window = 1;                               ///< surroundings are this many cells to each side
  std::vector<float> residual;  ///< if asked for: of each point from its surroundings without it [m]; NaN: isolated
  std::vector<float> factor;    ///< of each point of the cloud, times sigma (noise_factors.hpp); empty: 1

  static constexpr std::size_t kTileCells = 16;
  double at(std::size_t row, std::size_t column) const {
    return sigma[(row / kTileCells) * tile_columns + column / kTileCells];
  }
  double factor_of(std::uint32_t index) const { return factor.empty() ? 1.0 : static_cast<double>(factor[index]); }
};

/// Fits a quadratic to the surroundings of every cell (iteratively reweighted: absolute values, then Tukey's biweight)
/// and marks outliers in points.state. Deterministic, parallel.
LocalNoise find_noise(BandPoints& points, const Band& band, const NoiseSettings& settings);

}  // namespace treadmark::scans
