// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/outline.hpp"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <iterator>

namespace treadmark::io {
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

/// One closed loop from a point, removing its edges. A left turn comes first where two loops touch at a corner.
void append_loop(BoundaryEdges& edges, int start_x, int start_y, std::string& path) {
  int x = start_x, y = start_y, direction = 0;
  while (!edges.has(x, y, direction)) ++direction;
  fmt::format_to(std::back_inserter(path), "M{} {}", x, y);
  for (int length = 0;;) {
    edges.remove(x, y, direction);
    x += kStepX[static_cast<std::size_t>(direction)];
    y += kStepY[static_cast<std::size_t>(direction)];
    ++length;
    int next = -1;
    for (const int turn : {1, 0, 3})
      if (next < 0 && edges.has(x, y, (direction + turn) % 4)) next = (direction + turn) % 4;
    if (next == direction) continue;
    if (next < 0) break;  // back at the start: "z" draws the last run
    const int sign = direction < 2 ? 1 : -1;
    fmt::format_to(std::back_inserter(path), "{}{}", direction % 2 == 0 ? 'h' : 'v', sign * length);
    direction = next;
    length = 0;
  }
  path += 'z';
}

}  // namespace

std::string outline_path(const CellMask& mask) {
  BoundaryEdges edges(mask);
  std::string path;
  for (int y = 0; y <= mask.ny; ++y)
    for (int x = 0; x <= mask.nx; ++x)
      while (edges.has_any(x, y)) append_loop(edges, x, y, path);
  return path;
}

}  // namespace treadmark::io
