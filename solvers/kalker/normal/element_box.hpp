// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <climits>

#include "treadmark/core/grid.hpp"

namespace treadmark::kalker {

/// A rectangle of elements of a grid: columns x0 .. x1-1, rows y0 .. y1-1.
struct ElementBox {
  int x0 = INT_MAX, y0 = INT_MAX, x1 = INT_MIN, y1 = INT_MIN;

  bool empty() const { return x1 <= x0 || y1 <= y0; }
  int nx() const { return x1 - x0; }
  int ny() const { return y1 - y0; }
  std::size_t size() const { return static_cast<std::size_t>(nx()) * static_cast<std::size_t>(ny()); }
  bool contains(const ElementBox& other) const {
    return other.empty() || (x0 <= other.x0 && y0 <= other.y0 && other.x1 <= x1 && other.y1 <= y1);
  }
  void include(int ix, int iy) {
    x0 = std::min(x0, ix);
    y0 = std::min(y0, iy);
    x1 = std::max(x1, ix + 1);
    y1 = std::max(y1, iy + 1);
  }
  void include(const ElementBox& other) {
    if (other.empty()) return;
    include(other.x0, other.y0);
    include(other.x1 - 1, other.y1 - 1);
  }
  friend bool operator==(const ElementBox&, const ElementBox&) = default;
};

}  // namespace treadmark::kalker
