// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "treadmark/core/error.hpp"
#include "treadmark/report/pictures/outline.hpp"

namespace treadmark::pictures {
namespace {

/// Side of cells from point (ix, iy) to the next one in x or y.
using Side = std::size_t;

class Sides {
 public:
  Sides(const Grid2& grid, std::span<const double> values, double level)
      : grid_(grid), values_(values), level_(level) {}

  bool above(int ix, int iy) const { return value(ix, iy) >= level_; }
  double value(int ix, int iy) const { return values_[grid_.index(ix, iy)]; }
  Side along_x(int ix, int iy) const { return 2 * grid_.index(ix, iy); }
  Side along_y(int ix, int iy) const { return 2 * grid_.index(ix, iy) + 1; }

  /// Where the level is reached on a side.
  std::array<double, 2> point(Side side) const {
    const int from = static_cast<int>(side / 2), ix = from % grid_.nx, iy = from / grid_.nx;
    const bool y = side % 2 != 0;
    const double first = value(ix, iy), second = y ? value(ix, iy + 1) : value(ix + 1, iy);
    const double part = (level_ - first) / (second - first);
    return {grid_.x(ix) + (y ? 0.0 : part * grid_.dx), grid_.y(iy) + (y ? part * grid_.dy : 0.0)};
  }

  /// Adds the pieces of a line in a cell, each from side to side.
  void pieces(int ix, int iy, std::vector<std::array<Side, 2>>& out) const {
    const double sum = value(ix, iy) + value(ix + 1, iy) + value(ix + 1, iy + 1) + value(ix, iy + 1);
    if (!std::isfinite(sum)) return;
    // Corners counterclockwise from the lower left; side k runs from corner k to the next.
    const std::array<bool, 4> high{above(ix, iy), above(ix + 1, iy), above(ix + 1, iy + 1), above(ix, iy + 1)};
    const std::array<Side, 4> sides{along_x(ix, iy), along_y(ix + 1, iy), along_x(ix, iy + 1), along_y(ix, iy)};
    std::vector<Side> crossed;
    for (std::size_t k = 0; k < 4; ++k)
      if (high[k] != high[(k + 1) % 4]) crossed.push_back(sides[k]);
    if (crossed.size() == 2) out.push_back({crossed[0], crossed[1]});
    if (crossed.size() != 4) return;
    if ((sum >= 4.0 * level_) == high[0]) {  // corners 0 and 2 belong together: lines around 1 and 3
      out.push_back({crossed[0], crossed[1]});
      out.push_back({crossed[2], crossed[3]});
    } else {
      out.push_back({crossed[3], crossed[0]});
      out.push_back({crossed[1], crossed[2]});
    }
  }

 private:
  const Grid2& grid_;
  std::span<const double> values_;
  double level_;
};

/// Pieces joined at common sides: each side belongs to at most two.
class Joiner {
 public:
  explicit Joiner(const std::vector<std::array<Side, 2>>& pieces) {
    for (const auto& [a, b] : pieces) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
  }

  /// Open lines from their ends, then closed ones.
  std::vector<std::vector<Side>> lines() {
    std::vector<std::vector<Side>> out;
    for (const std::size_t degree : {1u, 2u})
      for (auto& [side, others] : neighbours_)
        while (others.size() == degree) out.push_back(follow(side));
    return out;
  }

 private:
  std::vector<Side> follow(Side side) {
    std::vector<Side> line{side};
    while (!neighbours_[side].empty()) {
      const Side next = neighbours_[side].back();
      neighbours_[side].pop_back();
      std::erase(neighbours_[next], side);
      line.push_back(next);
      side = next;
    }
    return line;
  }

  std::map<Side, std::vector<Side>> neighbours_;  // in order: the same lines in every run
};

}  // namespace

std::vector<ContourLine> contour_lines(const Grid2& grid, std::span<const double> values, double level) {
  if (values.size() != grid.size())
    throw Error(ErrorKind::configuration, fmt::format("{} values on a grid of {} points", values.size(), grid.size()));
  const Sides sides(grid, values, level);
  std::vector<std::array<Side, 2>> pieces;
  for (int iy = 0; iy + 1 < grid.ny; ++iy)
    for (int ix = 0; ix + 1 < grid.nx; ++ix) sides.pieces(ix, iy, pieces);
  std::vector<ContourLine> out;
  for (const auto& line : Joiner(pieces).lines()) {
    out.emplace_back();
    for (const Side side : line) out.back().push_back(sides.point(side));
  }
  return out;
}

}  // namespace treadmark::pictures
