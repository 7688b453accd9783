// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/outline.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>

namespace treadmark::pictures {
namespace {

// Directions counterclockwise: +x, +y, -x, -y.
constexpr std::array<int, 4> kStepX{1, 0, -1, 0};
constexpr std::array<int, 4> kStepY{0, 1, 0, -1};

/// The edges between inside and outside, each directed so that the inside lies to its left, by their first point.
class BoundaryEdges {
 public:
  explicit BoundaryEdges(const CellMask& mask)
      : width_(static_cast<std::size_t>(mask.nx) + 1), out_(width_ * (static_cast<std::size_t>(mask.ny) + 1), 0) {
    for (int iy = 0; iy < mask.ny; ++iy)
      for (int ix = 0; ix < mask.nx; ++ix) {
        if (!mask.at(ix, iy)) continue;
        if (!mask.at(ix, iy - 1)) add(ix, iy, 0);
        if (!mask.at(ix + 1, iy)) add(ix + 1, iy, 1);
        if (!mask.at(ix, iy + 1)) add(ix + 1, iy + 1, 2);
        if (!mask.at(ix - 1, iy)) add(ix, iy + 1, 3);
      }
  }

  bool has(int x, int y, int direction) const { return (out_[index(x, y)] >> direction & 1) != 0; }
  bool has_any(int x, int y) const { return out_[index(x, y)] != 0; }
  void remove(int x, int y, int direction) { out_[index(x, y)] &= static_cast<unsigned char>(~(1 << direction)); }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(x) + width_ * static_cast<std::size_t>(y); }
  void add(int x, int y, int direction) { out_[index(x, y)] |= static_cast<unsigned char>(1 << direction); }

  std::size_t width_;
  std::vector<unsigned char> out_;
};

/// A loop from its lowest, leftmost corner, removing its edges. A left turn comes first where two loops touch at a
/// corner.
Loop take_loop(BoundaryEdges& edges, int x, int y) {
  Loop loop{{x, y}};
  int direction = 0;
  while (!edges.has(x, y, direction)) ++direction;
  while (true) {
    edges.remove(x, y, direction);
    x += kStepX[static_cast<std::size_t>(direction)];
    y += kStepY[static_cast<std::size_t>(direction)];
    int next = -1;
    for (const int turn : {1, 0, 3})
      if (next < 0 && edges.has(x, y, (direction + turn) % 4)) next = (direction + turn) % 4;
    if (next < 0) return loop;  // back at the start
    if (next != direction) loop.push_back({x, y});
    direction = next;
  }
}

}  // namespace

std::vector<Loop> outline(const CellMask& mask) {
  BoundaryEdges edges(mask);
  std::vector<Loop> loops;
  for (int y = 0; y <= mask.ny; ++y)
    for (int x = 0; x <= mask.nx; ++x)
      while (edges.has_any(x, y)) loops.push_back(take_loop(edges, x, y));
  return loops;
}

std::string path_in_cells(const std::vector<Loop>& loops) {
  std::string path;
  const auto out = std::back_inserter(path);
  for (const Loop& loop : loops) {
    fmt::format_to(out, "M{} {}", loop[0][0], loop[0][1]);
    for (std::size_t i = 1; i < loop.size(); ++i) {
      const int right = loop[i][0] - loop[i - 1][0], up = loop[i][1] - loop[i - 1][1];
      fmt::format_to(out, "{}{}", right != 0 ? 'h' : 'v', right != 0 ? right : up);
    }
    path += 'z';
  }
  return path;
}

std::string path_at(const std::vector<Loop>& loops, double x0, double y0, double step_x, double step_y) {
  std::string path;
  const auto out = std::back_inserter(path);
  for (const Loop& loop : loops) {
    fmt::format_to(out, "M{:.1f} {:.1f}", x0 + loop[0][0] * step_x, y0 + loop[0][1] * step_y);
    for (std::size_t i = 1; i < loop.size(); ++i) {
      if (loop[i][0] != loop[i - 1][0])
        fmt::format_to(out, "H{:.1f}", x0 + loop[i][0] * step_x);
      else
        fmt::format_to(out, "V{:.1f}", y0 + loop[i][1] * step_y);
    }
    path += 'z';
  }
  return path;
}

}  // namespace treadmark::pictures
