// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/results/picture_patch.hpp"

namespace treadmark::io {

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
