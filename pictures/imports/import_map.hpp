// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/pictures/imports/import_plot.hpp"
#include "treadmark/pictures/imports/png.hpp"

namespace treadmark::io {

/// Rows of colours. Their order survives for colour-blind readers: lightness grows or falls evenly.
enum class Palette {
  sequential,  ///< as colour(): dark violet to yellow
  diverging,   ///< dark blue, white in the middle, orange to dark brown
  from_white,  ///< the upper half of the diverging one, for what is rare
};

/// What the colours of a map mean. Values beyond the ends have the colours of the ends.
struct MapColours {
  double low = 0.0, high = 1.0;  ///< [shown unit]
  Palette palette = Palette::sequential;
  bool below = false, above = false;  ///< values lie beyond the ends
  std::string unit;                   ///< the shown one
  double factor = 1.0;                ///< from SI to the shown unit
};

/// Colour at 0 (low) .. 1 (high): red, green, blue, opaque.
std::array<std::uint8_t, 4> map_colour(double part, Palette palette);

/// Smallest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below a value > 0; 1 for others.
double round_limit(double value);

/// Steps of colour in a map; step 0 .. kMapColours - 1 of a value in the shown unit.
inline constexpr std::size_t kMapColours = 64;
std::size_t map_step(double value, const MapColours& colours);

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
