// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

namespace treadmark::io {

/// A set of cells of a regular grid, row-major.
struct CellMask {
  int nx = 0, ny = 0;
  std::vector<char> inside;

  bool at(int ix, int iy) const {
    return ix >= 0 && iy >= 0 && ix < nx && iy < ny &&
           inside[static_cast<std::size_t>(ix) + static_cast<std::size_t>(nx) * static_cast<std::size_t>(iy)] != 0;
  }
};

/// Boundary of the set as SVG path data in cell units (cell ix, iy spans [ix, ix+1] x [iy, iy+1]); holes run the other
/// way round, so that both fill rules agree. Empty for an empty set. Thread-safe.
std::string outline_path(const CellMask& mask);

}  // namespace treadmark::io
