// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>

#include "treadmark/core/lanes4.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::spline {

/// A homogeneous point (x w, y w, z w, w).
struct Quad {
  lanes::Pair xy{0.0, 0.0}, zw{0.0, 0.0};

  Quad() = default;
  Quad(double x, double y, double z, double w) : xy{x, y}, zw{z, w} {}
  Quad(const lanes::Pair& first, const lanes::Pair& second) : xy(first), zw(second) {}

  double x() const { return xy[0]; }
  double y() const { return xy[1]; }
  double z() const { return zw[0]; }
  double w() const { return zw[1]; }
  friend Quad operator+(const Quad& a, const Quad& b) { return {a.xy + b.xy, a.zw + b.zw}; }
  friend Quad operator-(const Quad& a, const Quad& b) { return {a.xy - b.xy, a.zw - b.zw}; }
  friend Quad operator*(double f, const Quad& a) {
    const lanes::Pair both{f, f};
    return {both * a.xy, both * a.zw};
  }
};

/// A rational bicubic Bezier patch, b[i][j] in homogeneous coordinates, i along u, j along v; weights are positive, so
/// that the patch lies in the convex hull of its projected points (Farin 2002).
struct BezierPatch {
  Quad b[4][4];
  bool rational = true;  ///< false: all weights are 1

  Vec3 point(int i, int j) const {
    const Vec3 p(b[i][j].x(), b[i][j].y(), b[i][j].z());
    return rational ? Vec3(p / b[i][j].w()) : p;
  }

  /// The part u0..u1 x v0..v1 of the unit square, in exact arithmetic the same surface.
  BezierPatch part(double u0, double u1, double v0, double v1) const;
  /// Halves of u or of v, the lower one first.
  std::array<BezierPatch, 2> halves(bool of_u) const {
    if (of_u) return {part(0.0, 0.5, 0.0, 1.0), part(0.5, 1.0, 0.0, 1.0)};
    return {part(0.0, 1.0, 0.0, 0.5), part(0.0, 1.0, 0.5, 1.0)};
  }
};

/// Coefficients of s^i t^j, s = u - 1/2, t = v - 1/2: evaluated faster, and as well conditioned for so low a degree.
struct PowerPatch {
  Quad c[4][4];

  explicit PowerPatch(const BezierPatch& bezier);
  PowerPatch() = default;

  struct Jet {
    Quad value, by_s, by_t;
  };
  Jet jet(double s, double t) const {
    Quad value[4], slope[4];
    for (int i = 0; i < 4; ++i) {
      const Quad* k = c[i];
      value[i] = k[0] + t * (k[1] + t * (k[2] + t * k[3]));
      slope[i] = k[1] + t * (2.0 * k[2] + (3.0 * t) * k[3]);
    }
    return {value[0] + s * (value[1] + s * (value[2] + s * value[3])),
            value[1] + s * (2.0 * value[2] + (3.0 * s) * value[3]),
            slope[0] + s * (slope[1] + s * (slope[2] + s * slope[3]))};
  }

  struct Bend {
    Quad by_ss, by_st, by_tt;
  };
  Bend bend(double s, double t) const;
};

namespace detail {
// Centred power coefficients of one cubic.
inline std::array<Quad, 4> centred_powers(const Quad& b0, const Quad& b1, const Quad& b2, const Quad& b3) {
  const Quad outer = b0 + b3, inner = b1 + b2;
  return {0.125 * (outer + 3.0 * inner), 0.75 * ((b3 - b0) + (b2 - b1)), 1.5 * (outer - inner),
          (b3 - b0) - 3.0 * (b2 - b1)};
}
inline std::array<Quad, 4> cubic_part(const Quad& b0, const Quad& b1, const Quad& b2, const Quad& b3, double from,
                                      double to) {
  // Blossoms (Ramshaw 1987): the point i of the part takes i times "to" and 3 - i times "from".
  const auto blossom = [&](double x, double y, double z) {
    const auto mix = [](double t, const Quad& a, const Quad& b) { return (1.0 - t) * a + t * b; };
    const Quad c0 = mix(x, b0, b1), c1 = mix(x, b1, b2), c2 = mix(x, b2, b3);
    return mix(z, mix(y, c0, c1), mix(y, c1, c2));
  };
  return {blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)};
}
}  // namespace detail

inline BezierPatch BezierPatch::part(double u0, double u1, double v0, double v1) const {
  BezierPatch out;
  out.rational = rational;
  for (int j = 0; j < 4; ++j) {
    const auto line = detail::cubic_part(b[0][j], b[1][j], b[2][j], b[3][j], u0, u1);
    for (std::size_t i = 0; i < 4; ++i) out.b[i][j] = line[i];
  }
  for (auto& row : out.b) {
    const auto line = detail::cubic_part(row[0], row[1], row[2], row[3], v0, v1);
    std::copy(line.begin(), line.end(), row);
  }
  return out;
}

inline PowerPatch::PowerPatch(const BezierPatch& p) {
  for (int j = 0; j < 4; ++j) {
    const auto line = detail::centred_powers(p.b[0][j], p.b[1][j], p.b[2][j], p.b[3][j]);
    for (std::size_t i = 0; i < 4; ++i) c[i][j] = line[i];
  }
  for (auto& row : c) {
    const auto line = detail::centred_powers(row[0], row[1], row[2], row[3]);
    std::copy(line.begin(), line.end(), row);
  }
}

inline PowerPatch::Bend PowerPatch::bend(double s, double t) const {
  Quad value[4], slope[4], second[4];
  for (int i = 0; i < 4; ++i) {
    const Quad* k = c[i];
    value[i] = k[0] + t * (k[1] + t * (k[2] + t * k[3]));
    slope[i] = k[1] + t * (2.0 * k[2] + (3.0 * t) * k[3]);
    second[i] = 2.0 * k[2] + (6.0 * t) * k[3];
  }
  return {2.0 * value[2] + (6.0 * s) * value[3], slope[1] + s * (2.0 * slope[2] + (3.0 * s) * slope[3]),
          second[0] + s * (second[1] + s * (second[2] + s * second[3]))};
}

}  // namespace treadmark::spline
