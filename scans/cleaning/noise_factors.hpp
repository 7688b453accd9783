// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/scans/cleaning/local_noise.hpp"

namespace treadmark::scans {

/// Something that points may scatter by, as their pass or their angle to the beam: a class of each point of the cloud.
using NoiseProperty = std::vector<std::uint16_t>;

/// How much more the points of a class scatter than usual ones at their place.
struct NoiseClass {
  std::size_t property = 0;  ///< number in the list
  std::uint16_t number = 0;  ///< of the class
  std::size_t points = 0;
  double factor = 1.0;
};

/// Tells the noise of classes of points apart from that of places: a point's standard deviation is that of its tile
/// times a factor for each of its properties, found by medians of residuals in turn (median polish; Tukey 1977). Only
/// properties count whose classes surely differ by a seventh or more; without any nothing changes. Sets noise.factor
/// and noise.sigma, and gives back points that are no outliers by the noise of their own class. noise: of find_noise
/// with residuals. Deterministic.
std::vector<NoiseClass> find_noise_factors(BandPoints& points, std::span<const NoiseProperty> properties,
                                           const NoiseSettings& settings, LocalNoise& noise);

}  // namespace treadmark::scans
