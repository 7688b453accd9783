// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/pictures/picture_patch.hpp"

namespace treadmark::io {

/// Pieces of SVG pictures. All functions are thread-safe.

/// Text for the inside of an element: markup escaped; control characters and bytes that are not UTF-8 become blanks
/// and question marks.
std::string xml_text(std::string_view words);

/// A text element; anchor is "start", "middle" or "end", more are further attributes with a leading blank.
std::string svg_text(double x, double y, std::string_view words, const char* anchor = "middle", const char* more = "");

/// Three significant digits or all before the point.
std::string three_digits(double value);

/// Round step of an axis with at most six intervals; length > 0.
double tick_step(double length);

/// Opens a picture on white paper: the svg element, then the rules of a style sheet. Close with "</svg>\n".
std::string svg_head(double width, double height, int font_size, std::string_view style);

/// Rules for the panels of pressure maps.
inline constexpr std::string_view kPanelStyle =
    ".title{font-size:12px;font-weight:bold}.tick{fill:none;stroke:#666666;stroke-width:.7}"
    ".contact{fill:none;stroke:#1a1a2e;stroke-width:1.2}.adhesion{fill:none;stroke:#ffffff;stroke-width:1.2}";

/// Frame, ticks and their numbers [mm] of a panel whose upper left corner is the origin; the numbers of y may be left
/// out where the panel beside it has the same. Thread-safe.
std::string draw_panel_axes(const PanelScale& panel, bool numbers_of_y = true);

/// "125 kN, 1320 MPa": sum of the normal forces and largest pressure of a case. Thread-safe.
std::string force_and_pressure(const CaseResult& result);

/// The colours of pressure from 0 to top_pressure [Pa] as an upright bar with its upper left corner at the origin,
/// numbers in MPa to the right. Thread-safe.
std::string draw_pressure_bar(double top_pressure, double height);
inline constexpr double kPressureBarWidth = 14.0;  // [px]

}  // namespace treadmark::io
