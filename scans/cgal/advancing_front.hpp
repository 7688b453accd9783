// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Triangles of an orientable surface through points about one unit of length apart, grown triangle by triangle, the
/// most plausible one first (Cohen-Steiner and Da 2004); none with an edge longer than longest_edge. Ordered by their
/// vertices; which side is out is left to chance for every connected part.
std::vector<std::array<std::uint32_t, 3>> advance_front(std::span<const Vec3> points, double longest_edge);

}  // namespace treadmark::scans
