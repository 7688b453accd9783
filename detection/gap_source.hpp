// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "treadmark/detection/contact_program/search_mesh.hpp"
#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// Bounds of both bodies over a rectangle: every gap over it lies in [low, high] where there is one [m].
/// empty: nowhere do both surfaces exist.
struct GapBounds {
  double low = 0.0, high = 0.0;
  bool empty = true;
  HeightBounds rail, wheel;
};

/// Where the gaps on a grid come from: the two surfaces, or what WheelFacets makes of them.
class GapSource {
 public:
  GapSource(const BodyPair& bodies, const Grid2& grid_T, const std::optional<WheelFacets>& facets);

  /// Conservative bounds over the rectangle that the points of a box span.
  GapBounds bounds(const IndexBox& box) const;
  /// The same for boxes of one size in nx columns and ny rows side by side, row by row, with one query of each body.
  std::vector<GapBounds> bounds(const IndexBox& first, int nx, int ny) const;
  /// A second look at the least gap over a box, in a plane that leans as the rail does, so that slopes that both bodies
  /// have do not count; worth it for small boxes. bounds: of the box.
  double least_close(const IndexBox& box, const GapBounds& bounds) const;

  /// Fills a tile. Not thread-safe where the wheel has facets.
  void fill(GapField::Tile& tile) { fill(std::span<GapField::Tile* const>(std::vector<GapField::Tile*>{&tile})); }
  /// Fills tiles, with one query of each surface for every rectangle of whole tiles they make. In parallel if it pays.
  void fill(std::span<GapField::Tile* const> tiles);

 private:
  struct Patch;
  void fill_patch(const Patch& patch);

  BodyPair bodies_;
  Pose X_RT_, X_WT_;
  Grid2 grid_;
  std::vector<double> lean_;  ///< slope of the rail in the middle of the grid, every few rows
  std::optional<FacetWheel> facets_;
};

}  // namespace treadmark::detection
