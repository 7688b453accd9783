// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/import/layout_line.hpp"
#include "treadmark/scans/line/rail_line.hpp"

namespace treadmark::app {

/// How the line of a rail lies on that of a layout, which knows nothing of the scan's frame.
struct LayoutMatch {
  double at = 0.0;                  ///< place of the rail's beginning on the layout [m]; of straights and circles any
  bool reversed = false;            ///< the rail runs against the layout
  double largest = 0.0, rms = 0.0;  ///< distances across, after the rigid motion that makes their squares least [m]
};

/// Lays a line on a layout by a rigid motion (Umeyama 1991), at the place and in the way where they fit best.
/// The rail's head stays above: where that motion would turn it over, chords and heads lie on each other instead.
/// beside: of the rail from the layout's line, to the right [m]. Errors: Error(configuration) for a layout that is
/// shorter than the rail.
LayoutMatch match_layout(const LayoutLine& layout, double beside, const scans::RailLine& rail);

}  // namespace treadmark::app
