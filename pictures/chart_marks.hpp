// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io {

/// Point in a picture (x, y) [px].
using Pixel = std::array<double, 2>;

/// What is left of a line when each column of pixels keeps its first, lowest, highest and last point, in their order:
/// drawn with pixels it looks the same (M4 aggregation, Jugel et al. 2014). Thread-safe.
std::vector<Pixel> thin_curve(std::span<const Pixel> line);

/// SVG path data of a line, to 0.01 px. Thread-safe.
std::string curve_path(std::span<const Pixel> line);

/// Looks of the series of a chart: the colours of Okabe and Ito (2008), which colour-blind readers tell apart, without
/// yellow (too light for paper), and a shape for each. Styles repeat after 56.
std::string_view chart_colour(int style);

/// SVG path data of the marker at (x, y); every shape has the area of a circle of this radius [px].
std::string chart_marker_path(int style, double x, double y, double radius);

/// Corners of the shape around the origin, for the same area.
std::vector<std::array<double, 2>> chart_marker_corners(int style, double radius);

}  // namespace treadmark::io
