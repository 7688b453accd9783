// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/sampling/region.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/surface_difference.hpp"

namespace treadmark::sampling {

struct DifferenceSettings {
  Region region;
  double spacing = 0.37e-3;  ///< between compared points across [m]; should not divide the spacing of the data
  std::size_t most_stations = 400;
  double margin = 1e-3;  ///< kept from the lateral ends [m] of y
};

/// Distance of a candidate from a reference along the reference's normals, seen in the natural view. Parallel,
/// deterministic. Errors: those of sampling the reference.
SurfaceDifference difference(const Surface& reference, const Surface& candidate, Body body, double nominal_radius,
                             const DifferenceSettings& settings);

}  // namespace treadmark::sampling
