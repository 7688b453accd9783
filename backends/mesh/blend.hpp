// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>

#include "treadmark/core/pose.hpp"

namespace treadmark::mesh {

/// A value with its first derivatives by x and y.
struct Jet1 {
  double v = 0.0, x = 0.0, y = 0.0;
  Jet1() = default;
  Jet1(double value) : v(value) {}
  Jet1(double value, double dx, double dy) : v(value), x(dx), y(dy) {}

  friend Jet1 operator+(const Jet1& a, const Jet1& b) { return {a.v + b.v, a.x + b.x, a.y + b.y}; }
  friend Jet1 operator-(const Jet1& a, const Jet1& b) { return {a.v - b.v, a.x - b.x, a.y - b.y}; }
  friend Jet1 operator*(const Jet1& a, const Jet1& b) {
    return {a.v * b.v, a.x * b.v + a.v * b.x, a.y * b.v + a.v * b.y};
  }
  friend Jet1 operator/(const Jet1& a, const Jet1& b) {
    const double q = a.v / b.v;
    return {q, (a.x - q * b.x) / b.v, (a.y - q * b.y) / b.v};
  }
};

/// A value with its first and second derivatives by x and y.
struct Jet2 {
  double v = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  Jet2() = default;
  Jet2(double value) : v(value) {}
  Jet2(double value, double dx, double dy) : v(value), x(dx), y(dy) {}
  Jet2(double value, double dx, double dy, double dxx, double dxy, double dyy)
      : v(value), x(dx), y(dy), xx(dxx), xy(dxy), yy(dyy) {}

  friend Jet2 operator+(const Jet2& a, const Jet2& b) {
    return {a.v + b.v, a.x + b.x, a.y + b.y, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend Jet2 operator-(const Jet2& a, const Jet2& b) {
    return {a.v - b.v, a.x - b.x, a.y - b.y, a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
  }
  friend Jet2 operator*(const Jet2& a, const Jet2& b) {
    return {a.v * b.v,
            a.x * b.v + a.v * b.x,
            a.y * b.v + a.v * b.y,
            a.xx * b.v + 2.0 * a.x * b.x + a.v * b.xx,
            a.xy * b.v + a.x * b.y + a.y * b.x + a.v * b.xy,
            a.yy * b.v + 2.0 * a.y * b.y + a.v * b.yy};
  }
  friend Jet2 operator/(const Jet2& a, const Jet2& b) {
    // from a = q b, differentiated once and twice
    const double q = a.v / b.v, qx = (a.x - q * b.x) / b.v, qy = (a.y - q * b.y) / b.v;
    return {q,
            qx,
            qy,
            (a.xx - 2.0 * qx * b.x - q * b.xx) / b.v,
            (a.xy - qx * b.y - qy * b.x - q * b.xy) / b.v,
            (a.yy - 2.0 * qy * b.y - q * b.yy) / b.v};
  }
};

inline double value_of(double a) { return a; }
inline double value_of(const Jet1& a) { return a.v; }
inline double value_of(const Jet2& a) { return a.v; }

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
