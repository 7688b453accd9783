// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// About `most` of the points, evenly spread over the surface: parts that were scanned more densely, as a damage often
/// is, do not count more, and lone points not at all. cube: size of the cubes in which points are evened out, some ten
/// points wide. keep: flags or empty. Deterministic.
std::vector<Vec3> even_sample(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const Vec3& centre,
                              double cube, std::size_t most);

}  // namespace treadmark::scans
