// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

#include "treadmark/solvers/kalker/subsurface/half_space_field.hpp"
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::kalker {

/// A corner that elements share, with the signed sum of their tractions (by SurfaceLoad): a sum over elements of double
/// differences over corners is a sum over corners of potentials times weights, at a quarter of the cost.
struct LoadedCorner {
  double x = 0.0, y = 0.0;                     ///< [m]
  std::array<double, kSurfaceLoads> weight{};  ///< [Pa]
};

/// The corners whose weights are not all zero, row by row.
std::vector<LoadedCorner> loaded_corners(const SurfaceTractions& tractions);

/// Traction i of a load [Pa]; 0 where there is none.
double traction(const SurfaceTractions& tractions, SurfaceLoad load, std::size_t i);

/// Throws Error(configuration) unless the grid has elements and fields match it and are finite.
void check_tractions(const SurfaceTractions& tractions);

/// Distance [m] below which two points count as one.
double least_distance(const Grid2& grid);

}  // namespace treadmark::kalker
