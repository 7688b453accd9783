// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>

#include "treadmark/io/imports/import_colours.hpp"
#include "treadmark/io/imports/import_plot.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/imports/png.hpp"

namespace treadmark::io {

/// A map whose sizes fit its values and whose ends can be drawn.
bool is_drawable(const BandMap& map);

/// Least and greatest value, and those that a part of all values lies outside of on each side; nothing without values.
struct MapExtent {
  double least = 0.0, greatest = 0.0, low = 0.0, high = 0.0;
};
std::optional<MapExtent> map_extent(const BandMap& map, double outside);

/// Symmetric about 0; as wide as the greatest value, or where few values are far larger than all others, as these.
MapColours diverging_colours(const BandMap& map);
/// From 0 to the greatest value, limited in the same manner; factor: from SI to the unit.
MapColours sequential_colours(const BandMap& map, const std::string& unit, double factor,
                              Palette palette = Palette::sequential);

/// How much of a pixel must be known for it to have a colour.
enum class PixelRule {
  any,   ///< some: maps of points
  half,  ///< half of it: maps of the surface
};

/// Picture of a map: a to the right, s upwards, averaged where the map is finer than the picture; what is not known is
/// transparent. The index of a colour is its map_step, the last colour is the transparent one.
PaletteImage map_image(const BandMap& map, const MapColours& colours, PixelRule rule, std::size_t most_columns,
                       std::size_t most_rows);

/// A map in a picture, between kPlotLeft and kPlotLeft + kPlotWidth.
struct MapPanel {
  PlotFrame frame;       ///< a and s [mm]
  double stretch = 1.0;  ///< scale of s over that of a
  double bottom = 0.0;   ///< where the next panel may begin [px]
};

/// Place of a map below y. Its heading is at y, degrees of a wheel above the frame, mm below.
MapPanel place_map(const ImportReport& report, const BandMap& map, double y);
/// The map, its axes, and its colours as an upright bar to the right. A map that cannot be drawn says so.
std::string draw_map(const ImportReport& report, const BandMap& map, const MapColours& colours, const MapPanel& panel,
                     const std::string& title, PixelRule rule);

}  // namespace treadmark::io
