// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

struct SampledProfile;
struct ProfileLines;

/// Undeformed distances are to be found with a mesh of the wheel and sections of the rail (Conventions::contact).
struct DistanceMesh {
  double nominal_radius = 0.0;  ///< of the wheel [m]
  bool rail_sections = true;    ///< false for rollers, whose one profile is only bent
};

/// Two surfaces placed in one common frame T (for a wheelset on track: the track frame). The surfaces must outlive
/// this.
struct BodyPair {
  const Surface* rail = nullptr;   ///< body 1, facing up
  const Surface* wheel = nullptr;  ///< body 2, facing down
  Pose X_TR;                       ///< rail frame in T
  Pose X_TW;                       ///< wheel surface frame (origin on the axle, pitched with the wheel) in T
  std::optional<DistanceMesh> distance_mesh = std::nullopt;  ///< empty: distances between the surfaces themselves
  std::shared_ptr<const SampledProfile> wheel_profile =
      nullptr;  ///< whole_profile() of the wheel, made once for many searches; null: made when needed
  std::shared_ptr<const ProfileLines> wheel_lines = nullptr;  ///< profile_lines() of a round wheel, likewise
};

/// Points [ix, ix + nx) x [iy, iy + ny) of a grid.
struct IndexBox {
  int ix = 0, iy = 0, nx = 0, ny = 0;
  std::size_t size() const { return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny); }
};

/// The part of a grid that a box of its points makes.
Grid2 part_of(const Grid2& grid, const IndexBox& box);

/// The gap between the bodies over a grid seen along z of the common frame T, kept in tiles of which only some may be
/// known. gap = z_rail - z_wheel [m]; negative = interpenetration; NaN where a surface is missing and where nothing is
/// known. Reading is thread-safe; different tiles may be filled by different threads.
class GapField {
 public:
  struct Tile {
    IndexBox box;
    std::span<double> rail_z, gap, rail_slope;               ///< [m], [m], dz/dy in T [-]; row by row
    double least = std::numeric_limits<double>::infinity();  ///< gap of the tile

    std::size_t index(int ix, int iy) const {
      return static_cast<std::size_t>(iy - box.iy) * static_cast<std::size_t>(box.nx) +
             static_cast<std::size_t>(ix - box.ix);
    }
    void close();  ///< after filling: finds the least gap

   private:
    friend class GapField;
    explicit Tile(const IndexBox& points);
    std::unique_ptr<double[]> numbers_;  // not set yet: a tile is about to be filled
  };

  /// Nothing known yet; tiles of 2^log_x times 2^log_y points.
  GapField(const Grid2& grid, int log_x, int log_y);
  /// One tile: everything.
  explicit GapField(const Grid2& grid) : GapField(grid, kWhole, kWhole) {}

  const Grid2& grid() const { return grid_; }
  int tiles_x() const { return tiles_x_; }
  int tiles_y() const { return tiles_y_; }
  IndexBox tile_box(int tx, int ty) const;
  bool known(int tx, int ty) const { return tiles_[tile_index(tx, ty)] != nullptr; }
  /// A new tile of the right size, to be filled.
  Tile& add_tile(int tx, int ty);
  /// In order of their places.
  const std::vector<std::unique_ptr<Tile>>& tiles() const { return tiles_; }

  /// A point is at tile (ix >> log_x, iy >> log_y).
  int log_x() const { return log_x_; }
  int log_y() const { return log_y_; }
  const Tile* tile_of(int ix, int iy) const { return tiles_[tile_index(ix >> log_x_, iy >> log_y_)].get(); }

  double gap(int ix, int iy) const { return value(&Tile::gap, ix, iy); }
  double rail_z(int ix, int iy) const { return value(&Tile::rail_z, ix, iy); }
  double rail_slope(int ix, int iy) const { return value(&Tile::rail_slope, ix, iy); }

 private:
  static constexpr int kWhole = 30;

  std::size_t tile_index(int tx, int ty) const {
    return static_cast<std::size_t>(ty) * static_cast<std::size_t>(tiles_x_) + static_cast<std::size_t>(tx);
  }
  double value(std::span<double> Tile::*array, int ix, int iy) const {
    const Tile* tile = tile_of(ix, iy);
    return tile ? (tile->*array)[tile->index(ix, iy)] : std::numeric_limits<double>::quiet_NaN();
  }

  Grid2 grid_;
  int log_x_, log_y_, tiles_x_, tiles_y_;
  std::vector<std::unique_ptr<Tile>> tiles_;
};

/// The gap at every point of a grid, both surfaces as they are.
GapField gap_field(const BodyPair& bodies, const Grid2& grid_T);

}  // namespace treadmark::detection
