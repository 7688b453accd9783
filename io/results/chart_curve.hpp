// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace treadmark::io {

/// Point in a picture (x, y) [px].
using Pixel = std::array<double, 2>;

/// What is left of a line when each column of pixels keeps its first, lowest, highest and last point, in their order:
/// drawn with pixels it looks the same (M4 aggregation, Jugel et al. 2014). Thread-safe.
std::vector<Pixel> thin_curve(std::span<const Pixel> line);

/// SVG path data of a line, to 0.01 px. Thread-safe.
std::string curve_path(std::span<const Pixel> line);

}  // namespace treadmark::io
