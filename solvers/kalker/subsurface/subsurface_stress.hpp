// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/kalker/subsurface/stress_state.hpp"

namespace treadmark::kalker {

struct ContactSolution;

/// Tractions on body 1 [Pa], uniform on each element of a grid of centres [m]; outside they are zero.
struct SurfaceTractions {
  Grid2 grid;
  std::span<const double> pressure;                ///< size grid.size()
  std::span<const double> traction_x, traction_y;  ///< size grid.size(), or empty: none
};

/// The tractions of a solution, which must outlive them.
SurfaceTractions surface_tractions(const Grid2& grid, const ContactSolution& solution);

/// Stresses at points [m] in the axes of the patch (x, y in the contact plane, z into body 1): z >= 0 lies in body 1,
/// z < 0 in body 2, each a half-space with its own constants under the tractions that act on it (Kalker 1990, ch. 5).
///
/// At the surface, z = 0, results are limits from within body 1 in the interior of elements. On a border between
/// elements, where tractions jump, bounded quantities are the mean over the sides; stresses that are infinite there
/// (they grow like the logarithm of the distance) are those at 1e-10 of an element's size.
///
/// One result a point, in their order. Cost: points times elements with tractions. Uses all threads; results do not
/// depend on their number. Errors: Error(configuration) for fields that do not match the grid, values that are not
/// finite, and elastic constants without meaning.
std::vector<SubsurfacePoint> subsurface_stress(const SurfaceTractions& tractions, const Material& material,
                                               std::span<const Vec3> points);

/// The same below all element centres at every depth z [m] (negative: body 2), by Fourier transforms: result
/// ix + nx (iy + ny iz). Agrees with the sum at points to rounding, 1e-10 of the largest value.
std::vector<SubsurfacePoint> subsurface_stress_on_grid(const SurfaceTractions& tractions, const Material& material,
                                                       std::span<const double> depths);

/// All points (x, y, z) of three lists of coordinates, x running fastest, then y.
std::vector<Vec3> block_of_points(std::span<const double> x, std::span<const double> y, std::span<const double> z);

}  // namespace treadmark::kalker
