// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::vehicle {

/// Weights of four nodes and their derivatives by t, between the second and the third one (Catmull and Rom 1974).
struct Weights {
  std::array<double, 4> value{}, slope{};
};
inline Weights weights_at(double t) {
  const double s = t * t;
  return {{0.5 * t * (2.0 * t - s - 1.0), 1.0 + 0.5 * s * (3.0 * t - 5.0), 0.5 * t * (1.0 + 4.0 * t - 3.0 * s),
           0.5 * s * (t - 1.0)},
          {2.0 * t - 1.5 * s - 0.5, 4.5 * s - 5.0 * t, 0.5 + 4.0 * t - 4.5 * s, 1.5 * s - t}};
}

/// Cell of a coordinate in units of nodes, and how far in it.
inline std::pair<int, double> cell_of(double position, int first, int last) {
  const int cell = std::clamp(to_whole<int>(std::floor(position)), first, last);
  return {cell, position - cell};
}

/// Weights of the nodes from `first` on, of those from 0 to `last`; a single node has all of it.
struct NodeWeights : Weights {
  int first = 0, count = 1;
};
/// At a place in units of nodes. Beyond the ends stand nodes on the parabola through the last three, or, of even
/// functions, the mirror image of those behind 0. Parabolas are exact. Slopes are by the place. last: 0, 2 or more; of
/// even functions any.
inline NodeWeights node_weights(double place, int last, bool even) {
  NodeWeights out;
  if (last == 0) {
    out.value[0] = 1.0;
    return out;
  }
  const auto [cell, t] = cell_of(place, 0, last - 1);
  out.first = std::max(cell - 1, 0);
  out.count = std::min(cell + 2, last) - out.first + 1;
  const auto add = [&](const auto& self, int node, double value, double slope) -> void {
    if (node < 0 && even) node = -node;
    if (node >= 0 && node <= last) {
      const auto i = static_cast<std::size_t>(node - out.first);
      out.value[i] += value, out.slope[i] += slope;
      return;
    }
    const int inwards = node < 0 ? 1 : -1;
    self(self, node + inwards, 3.0 * value, 3.0 * slope);
    self(self, node + 2 * inwards, -3.0 * value, -3.0 * slope);
    self(self, node + 3 * inwards, value, slope);
  };
  const Weights w = weights_at(t);
  for (int i = 0; i < 4; ++i)
    add(add, cell - 1 + i, w.value[static_cast<std::size_t>(i)], w.slope[static_cast<std::size_t>(i)]);
  return out;
}

}  // namespace treadmark::vehicle
