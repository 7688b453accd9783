// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/scans/cleaning/coverage.hpp"
#include "treadmark/scans/cleaning/local_noise.hpp"
#include "treadmark/scans/fit/fit_field.hpp"

namespace treadmark::app {

/// Intervals [from, to) of a band.
struct TileRange {
  std::size_t from = 0, to = 0;
  std::size_t count() const { return to - from; }
};

/// How the tiles of a long rail are imported: what all share, so that they agree where they meet. A tile is fitted with
/// the points of its window, which reaches farther on both sides; of the fit counts what lies in the tile.
struct TilePlan {
  scans::ProjectSettings project;  ///< of all
  scans::Section section;
  scans::BandIntervals band;  ///< all of it
  std::size_t rows = 0;       ///< cells along all of it
  std::size_t halvings = 0;   ///< of an interval down to cells
  std::size_t length = 1;     ///< of a tile, in intervals
  std::size_t overlap = 0;    ///< to both sides, in intervals
  scans::NoiseSettings noise;
  scans::CoverageSettings coverage;
  scans::Coverage usual;  ///< gaps, limit and width
  scans::FitSettings fit;
  double spacing = 0.0, tolerance = 0.0;  ///< of slices, see scans::slice_stations [m]
  double damage_threshold = 0.0;          ///< [m]
  std::vector<double> error_stations;     ///< from the beginning of the band [m]
  std::optional<std::array<scans::Section, 2>> halves;
  std::size_t map_intervals = 1;  ///< in a row of the maps; a divisor of length

  std::size_t tiles() const { return (band.count + length - 1) / length; }
  TileRange own(std::size_t tile) const { return {tile * length, std::min(band.count, (tile + 1) * length)}; }
  TileRange window(std::size_t tile) const {
    const TileRange mine = own(tile);
    return {mine.from - std::min(mine.from, overlap), std::min(band.count, mine.to + overlap)};
  }
  /// Distance of the beginning of an interval from that of the band [m].
  double along(std::size_t interval) const { return band.step * static_cast<double>(interval); }
};

/// Points of a window in the surface's frame [m], with their numbers among all.
struct TilePoints {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> numbers;
};

/// What is kept of a tile. Places along count from the beginning of the band [m].
struct FittedTile {
  std::vector<double> along, y, z;  ///< of its slices; their points one slice after the other
  /// Places of the fitted surface to hold a written one against: along, y, z, tilt of the section [rad].
  std::vector<double> checks;
  std::vector<double> damage;            ///< along, s, length, width, depth, volume of each
  std::vector<double> holes;             ///< along, s, diameter, area, filled of each
  std::vector<std::uint8_t> open;        ///< intervals in which a hole stays open
  double open_area = 0.0;                ///< of open holes in it [m^2]
  std::vector<double> error_at, errors;  ///< stations; their curves one after the other
  std::vector<double> error_y, error_z;  ///< places of these
  std::size_t used = 0, held_out = 0, outliers = 0, duplicates = 0;
  double square_used = 0.0, square_held_out = 0.0, variance_held_out = 0.0, largest = 0.0;  ///< of residuals [m]
  std::vector<std::uint64_t> histogram;  ///< of residuals from -6 to 6 times the typical noise
  std::size_t columns = 0;
  /// Rows of points, removed ones, the deviation of greatest size, mean residual, noise.
  std::array<std::vector<float>, 5> maps;
  int sweeps = 0;            ///< as FitResult::sweeps
  double noise = 0.0;        ///< typical of the window [m]
  int noise_window = 0;      ///< as LocalNoise::window
  scans::Coverage coverage;  ///< gaps, limit and width of the window; not stored

  /// Calls visit(member) for all that is stored, in one order.
  template <class Tile, class Visit>
  static void each(Tile& t, const Visit& visit) {
    visit(t.along), visit(t.y), visit(t.z), visit(t.checks), visit(t.damage), visit(t.holes), visit(t.open),
        visit(t.open_area);
    visit(t.error_at), visit(t.errors), visit(t.error_y), visit(t.error_z);
    visit(t.used), visit(t.held_out), visit(t.outliers), visit(t.duplicates);
    visit(t.square_used), visit(t.square_held_out), visit(t.variance_held_out), visit(t.largest);
    visit(t.histogram), visit(t.columns);
    for (auto& map : t.maps) visit(map);
  }
};

/// Fits a tile. As a trial it does not know what the plan has of the usual (noise, coverage, sweeps of the fit), and
/// tells them instead of slices. Parallel inside; the same for any number of threads. Errors: those of fit_field.
FittedTile fit_tile(const TilePlan& plan, std::size_t tile, const TilePoints& points, bool trial = false);

}  // namespace treadmark::app
