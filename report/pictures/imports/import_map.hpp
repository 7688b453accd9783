// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/report/pictures/imports/import_picture.hpp"

namespace treadmark::pictures {

/// Smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below a value > 0; 1 for others.
double round_limit(double value);

/// Not empty, of ordinary size, and long enough for its ends to be told apart.
bool is_usable(const AxisRange& range);

/// A map whose sizes fit its values and whose ends can be drawn.
bool is_drawable(const io::BandMap& map);

/// Least and greatest value, and those that a part of all values lies outside of on each side; nothing without values.
struct MapExtent {
  double least = 0.0, greatest = 0.0, low = 0.0, high = 0.0;
};
std::optional<MapExtent> map_extent(const io::BandMap& map, double outside);

/// Symmetric about 0; as wide as the greatest value, or where few values are far larger than all others, as these.
ColourScale diverging_colours(const io::BandMap& map);
/// From 0 to the greatest value, limited in the same manner; factor: from SI to the unit.
ColourScale sequential_colours(const io::BandMap& map, const std::string& unit, double factor,
                               Palette palette = Palette::sequential);

/// a to the right and s upwards.
Raster raster_of(const io::BandMap& map);

/// A map over a and s [mm] with degrees of a wheel above. One that cannot be drawn says so.
ImportPanel map_panel(const io::ImportReport& report, const io::BandMap& map, const ColourScale& colours,
                      const std::string& title, PixelRule rule);

}  // namespace treadmark::pictures
