// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/backends/offset/block_directory.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"

namespace treadmark::offset {

/// Ranges and Lipschitz constants of a B-spline over rectangles of (u, y), from its coefficients: values are convex
/// combinations of them, slopes of their differences. Cells of 8 x 8 voxels and halved resolutions above, only where
/// there is something.
class RangePyramid {
 public:
  /// blocks: where those of coefficients lie; kept.
  RangePyramid(const SheetGrid& coefficients, const BlockDirectory& blocks, const SheetFrame& frame, int degree);

  displacement::OffsetRange range(const Rectangle& uy) const;
  std::size_t memory_bytes() const;

 private:
  struct Cell {
    std::int32_t ci, cj;
    float low, high, step_u, step_y;  ///< greatest differences of neighbours
  };
  struct Box {
    double i_low, i_high, j_low, j_high;  ///< in voxels
  };
  Cell summary(std::int32_t ci, std::int32_t cj, int i_count, int j_count, int i_first, int j_first) const;
  void include(const Box& box, Cell& sum) const;
  void include_level(const Box& box, std::size_t level, Cell& sum) const;

  const BlockDirectory& blocks_;
  SheetFrame frame_;
  int before_, behind_;  ///< coefficients a point between voxels 0 and 1 depends on: [-before, behind]
  std::vector<std::vector<Cell>> levels_;
};

}  // namespace treadmark::offset
