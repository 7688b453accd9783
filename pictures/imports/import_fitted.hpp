// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/pictures/imports/import_map.hpp"

namespace treadmark::io {

/// Outlines of the holes and, numbered and with their depths, rectangles of the damage on the fitted map. A mark that
/// crosses the seam of a whole wheel is drawn at both ends.
std::string draw_marks(const ImportReport& report, const MapPanel& panel);

/// A line each for the largest damage, their numbers as on the map; bottom becomes where the next panel may begin.
std::string draw_damage_table(const ImportReport& report, double x, double y, double& bottom);

}  // namespace treadmark::io
