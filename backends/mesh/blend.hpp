// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>

#include "treadmark/backends/mesh/jets.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::mesh {

/// Where the foot of corner k lies on the edge opposite to it: 0 at corner k+1, 1 at corner k+2.
inline std::array<double, 3> edge_feet(const std::array<Vec3, 3>& corners) {
  std::array<double, 3> feet;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& from = corners[(k + 1) % 3];
    const Vec3 edge = corners[(k + 2) % 3] - from;
    feet[k] = edge.dot(corners[k] - from) / edge.squaredNorm();
  }
  return feet;
}

/// Weights of the three corners at barycentric coordinates b >= 0: not negative, of sum 1, one at its corner and zero
/// on the opposite edge together with their gradients. On an edge they depend on the place along it only, and so do
/// their gradients, because the place is that of the foot of the perpendicular: the blend of two triangles in one plane
/// is C1 across their edge. Each edge blends its two corners by a cubic step of the foot; the three edges are blended
/// by (b_i b_j)^2, which on an edge leaves that edge alone (the idea of Nielson 1979, side-vertex interpolation). T:
/// double, Jet1 or Jet2.
template <class T>
std::array<T, 3> blend_weights(const std::array<T, 3>& b, const std::array<double, 3>& feet) {
  const T product[3] = {b[1] * b[2], b[2] * b[0], b[0] * b[1]};
  const T square[3] = {product[0] * product[0], product[1] * product[1], product[2] * product[2]};
  const T sum = square[0] + square[1] + square[2];
  std::array<T, 3> w{T(0.0), T(0.0), T(0.0)};
  if (!(value_of(sum) > 1e-200)) {  // a corner
    std::size_t corner = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (value_of(b[k]) > value_of(b[corner])) corner = k;
    w[corner] = T(1.0);
    return w;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    T s = b[j] + b[k] * T(feet[k]);
    if (value_of(s) <= 0.0) s = T(0.0);
    if (value_of(s) >= 1.0) s = T(1.0);
    const T step = s * s * (T(3.0) - T(2.0) * s), beta = square[k] / sum;
    w[i] = w[i] + beta * (T(1.0) - step);
    w[j] = w[j] + beta * step;
  }
  return w;
}

}  // namespace treadmark::mesh
