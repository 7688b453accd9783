// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Small pieces of the scanned surface: a cube's points, with the plane through them and their neighbours.
struct SurfaceElements {
  std::vector<Vec3> position;  ///< means of the points of a cube
  std::vector<Vec3> normal;    ///< unit, either way
  std::vector<float> weight;   ///< in (0, 1]: how flat the surroundings are
  double size = 0.0;           ///< of the cubes
  Vec3 centre = Vec3::Zero();  ///< middle of the points
  double radius = 0.0;         ///< half of their extent, outliers apart
  double flat_part = 0.0;      ///< part of the points that lie in flat surroundings
  double spacing = 0.0;        ///< of points, were they evenly spread over the elements
};

/// Any unit. Cubes are as small as the data let planes be seen. keep: flags or empty. Deterministic.
/// Errors: Error(input_data) for fewer than 100 points, or all at one place.
SurfaceElements look_for_elements(std::span<const Vec3> points, std::span<const std::uint8_t> keep = {});

/// Errors: Error(input_data) if the points nowhere form a surface.
void require_surface(const SurfaceElements& elements);

/// Both.
SurfaceElements find_elements(std::span<const Vec3> points, std::span<const std::uint8_t> keep = {});

}  // namespace treadmark::scans
