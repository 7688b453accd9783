// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/backends/offset/coefficients.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::offset {

namespace {

/// Voxels of the turn if the map covers it, 0 if it is a patch.
int voxels_of_turn(const OffsetMap& map, int& columns) {
  constexpr double kTurn = 2.0 * std::numbers::pi, kExact = 1e-6;  // [voxels]
  const double voxels = kTurn / map.grid.dx, whole = std::round(voxels);
  const bool divides = std::fabs(voxels - whole) <= kExact * std::max(1.0, 1e-3 * whole);
  if (map.grid.nx < voxels - 0.5) {
    if (map.grid.nx + 2 * kSpread + 4 > voxels)
      throw Error(
          ErrorKind::input_data,
          fmt::format("the offset map {} leaves a gap of less than {} steps in the turn", map.name, 2 * kSpread + 4),
          {}, "cover the whole turn, or less of it");
    return 0;
  }
  if (!divides)
    throw Error(ErrorKind::input_data,
                fmt::format("the steps of the offset map {} do not divide the turn: {:.6f} of them", map.name, voxels));
  if (map.grid.nx > to_whole<int>(whole) + 1)
    throw Error(ErrorKind::input_data, fmt::format("the offset map {} covers more than one turn", map.name));
  columns = to_whole<int>(whole);  // a last column that repeats the first is left out
  return columns;
}

}  // namespace

OffsetSample offsets_from_map(const OffsetMap& map, Body body, double tolerance) {
  constexpr double kAbsurd = 1.0;  // [m]
  const Grid2& g = map.grid;
  if (!(tolerance >= 0.0) || !std::isfinite(tolerance))
    throw Error(ErrorKind::configuration, "the tolerance of offsets must not be negative");
  if (g.nx < 2 || g.ny < 2 || !(g.dx > 0.0) || !(g.dy > 0.0) || !std::isfinite(g.dx + g.dy + g.x0 + g.y0))
    throw Error(ErrorKind::input_data,
                fmt::format("the offset map {} needs two points and positive steps along both axes", map.name));
  if (g.dx < kLeastStep || g.dy < kLeastStep)
    throw Error(ErrorKind::input_data,
                fmt::format("the steps of the offset map {} are below {} m", map.name, kLeastStep));
  if (map.offset.size() != g.size())
    throw Error(ErrorKind::input_data,
                fmt::format("the offset map {} has {} values, its grid {}", map.name, map.offset.size(), g.size()));
  for (const float v : map.offset)
    if (std::isinf(v) || std::fabs(v) > kAbsurd)
      throw Error(ErrorKind::input_data, fmt::format("the offset map {} has an offset of {} m", map.name, v), {},
                  "offsets are in metres");

  const auto offsets = std::make_shared<SparseOffsets>();
  SheetFrame& frame = offsets->frame;
  int columns = g.nx;
  frame.body = body;
  frame.u0 = g.x0, frame.y0 = g.y0, frame.du = g.dx, frame.dy = g.dy;
  if (body == Body::wheel) frame.turn = voxels_of_turn(map, columns);
  if (frame.turn > 0) frame.du = 2.0 * std::numbers::pi / frame.turn;
  frame.last = columns - 1;
  offsets->tolerance = tolerance;

  OffsetSample result;
  result.nodes = static_cast<std::size_t>(columns) * static_cast<std::size_t>(g.ny);
  for (int bi = 0; bi * kBlockI < columns; ++bi)
    for (int bj = 0; bj * kBlockJ < g.ny; ++bj) {
      Block block{};
      for (int i = bi * kBlockI; i < std::min(columns, (bi + 1) * kBlockI); ++i)
        for (int j = bj * kBlockJ; j < std::min(g.ny, (bj + 1) * kBlockJ); ++j) {
          const float v = map.offset[g.index(i, j)];
          if (std::isnan(v)) continue;
          block[static_cast<std::size_t>(((i & 7) << 6) | (j & 63))] = v;
          result.max_offset = std::max(result.max_offset, static_cast<double>(std::fabs(v)));
        }
      result.active += offsets->grid.insert({bi, bj}, block, static_cast<float>(tolerance));
    }
  result.offsets = offsets;
  return result;
}

}  // namespace treadmark::offset
