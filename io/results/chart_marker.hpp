// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io {

/// Looks of the series of a chart: the colours of Okabe and Ito (2008), which colour-blind readers tell apart, without
/// yellow (too light for paper), and a shape for each. Styles repeat after 56.
std::string_view chart_colour(int style);

/// SVG path data of the marker at (x, y); every shape has the area of a circle of this radius [px].
std::string chart_marker_path(int style, double x, double y, double radius);

/// Corners of the shape around the origin, for the same area.
std::vector<std::array<double, 2>> chart_marker_corners(int style, double radius);

}  // namespace treadmark::io
