// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/grid.hpp"

namespace treadmark {

[[noreturn]] inline void refuse_saved_state(const char* what) {
  throw Error(ErrorKind::input_data, std::string("a saved state is damaged: ") + what, {}, "start anew");
}

inline void write(const Grid2& grid, ByteWriter& out) {
  for (const double value : {grid.x0, grid.y0, grid.dx, grid.dy}) out.put(value);
  for (const int value : {grid.nx, grid.ny}) out.put(value);
}

/// Errors: Error(input_data) for numbers that are not finite, or steps and counts that no grid has. A grid without
/// points may have any steps.
inline Grid2 read_grid(ByteReader& in) {
  Grid2 grid;
  for (double* value : {&grid.x0, &grid.y0, &grid.dx, &grid.dy}) {
    in.get(*value);
    if (!std::isfinite(*value)) refuse_saved_state("a grid is not finite");
  }
  for (int* value : {&grid.nx, &grid.ny}) in.get(*value);
  const bool none = grid.nx == 0 && grid.ny == 0;
  if (!none && (grid.nx < 1 || grid.ny < 1 || !(grid.dx > 0.0) || !(grid.dy > 0.0)))
    refuse_saved_state("a grid has no elements");
  return grid;
}

/// Values on a grid: one for each point, or none where that is allowed.
/// Errors: Error(input_data) for another number of values or one that is not a number.
inline void read_field(ByteReader& in, const Grid2& grid, bool may_be_empty, std::vector<double>& field) {
  in.get(field);
  if (field.size() != grid.size() && !(may_be_empty && field.empty()))
    refuse_saved_state("a field does not fit its grid");
  for (const double value : field)
    if (std::isnan(value)) refuse_saved_state("a field holds what is not a number");
}

}  // namespace treadmark
