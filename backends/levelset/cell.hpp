// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "treadmark/core/pose.hpp"

namespace treadmark::levelset {

/// A cell is the cube of edge 1 about a node. In it the distance is a triquadratic B-spline of the 27 coefficients
/// about the node, [9 i + 3 j + k]; xi is the place from the node, from -1/2 to 1/2 along each axis. All in voxels.
using Coefficients = std::array<double, 27>;

/// Value and derivatives by xi.
struct CellJet {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();
  Mat3 hessian = Mat3::Zero();
};

namespace cell {

/// The three quadratic B-splines at a place, or one of their derivatives.
inline std::array<double, 3> weights(double x, int derivative) {
  if (derivative == 2) return {1.0, -2.0, 1.0};
  if (derivative == 1) return {x - 0.5, -2.0 * x, x + 0.5};
  return {0.5 * (0.5 - x) * (0.5 - x), 0.75 - x * x, 0.5 * (0.5 + x) * (0.5 + x)};
}

inline double sum(const Coefficients& c, const std::array<double, 3>& x, const std::array<double, 3>& y,
                  const std::array<double, 3>& z) {
  double all = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    double plane = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double* row = c.data() + 9 * i + 3 * j;
      plane += y[j] * (row[0] * z[0] + row[1] * z[1] + row[2] * z[2]);
    }
    all += x[i] * plane;
  }
  return all;
}

/// Coefficients of the same function in Bernstein's basis on the cell, whose hull holds every value.
inline Coefficients bernstein(Coefficients c) {
  for (const std::size_t step : {std::size_t{9}, std::size_t{3}, std::size_t{1}})
    for (std::size_t line = 0; line < 9; ++line) {
      const std::size_t at = step == 9 ? line : step == 3 ? 9 * (line / 3) + line % 3 : 3 * line;
      const double middle = c[at + step];
      c[at] = 0.5 * (c[at] + middle);
      c[at + 2 * step] = 0.5 * (c[at + 2 * step] + middle);
    }
  return c;
}

}  // namespace cell

inline double cell_value(const Coefficients& c, const Vec3& xi) {
  return cell::sum(c, cell::weights(xi.x(), 0), cell::weights(xi.y(), 0), cell::weights(xi.z(), 0));
}

inline Vec3 cell_gradient(const Coefficients& c, const Vec3& xi) {
  const auto x = cell::weights(xi.x(), 0), y = cell::weights(xi.y(), 0), z = cell::weights(xi.z(), 0);
  return {cell::sum(c, cell::weights(xi.x(), 1), y, z), cell::sum(c, x, cell::weights(xi.y(), 1), z),
          cell::sum(c, x, y, cell::weights(xi.z(), 1))};
}

inline CellJet cell_jet(const Coefficients& c, const Vec3& xi) {
  std::array<std::array<double, 3>, 3> w[3];
  for (int axis = 0; axis < 3; ++axis)
    for (int d = 0; d < 3; ++d) w[axis][static_cast<std::size_t>(d)] = cell::weights(xi[axis], d);
  CellJet jet;
  jet.value = cell::sum(c, w[0][0], w[1][0], w[2][0]);
  for (int a = 0; a < 3; ++a) {
    std::array<std::size_t, 3> order{};
    ++order[static_cast<std::size_t>(a)];
    jet.gradient[a] = cell::sum(c, w[0][order[0]], w[1][order[1]], w[2][order[2]]);
    for (int b = a; b < 3; ++b) {
      std::array<std::size_t, 3> both = order;
      ++both[static_cast<std::size_t>(b)];
      jet.hessian(a, b) = jet.hessian(b, a) = cell::sum(c, w[0][both[0]], w[1][both[1]], w[2][both[2]]);
    }
  }
  return jet;
}

/// Bounds of all values in the cell.
inline std::pair<double, double> cell_range(const Coefficients& c) {
  const Coefficients b = cell::bernstein(c);
  const auto [low, high] = std::minmax_element(b.begin(), b.end());
  return {*low, *high};
}

/// The function along a straight line through the cell, in Bernstein's basis of degree 6 over the piece of the line.
using LinePolynomial = std::array<double, 7>;

inline LinePolynomial along_line(const Coefficients& c, const Vec3& from, const Vec3& to) {
  // products of polynomials in Bernstein's basis times its binomials are those of their coefficients (Farin 2002)
  std::array<std::array<double, 3>, 3> w[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double a = from[axis], b = to[axis];
    w[axis][0] = {0.5 * (0.5 - a) * (0.5 - a), (0.5 - a) * (0.5 - b), 0.5 * (0.5 - b) * (0.5 - b)};
    w[axis][1] = {0.75 - a * a, 1.5 - 2.0 * a * b, 0.75 - b * b};
    w[axis][2] = {0.5 * (0.5 + a) * (0.5 + a), (0.5 + a) * (0.5 + b), 0.5 * (0.5 + b) * (0.5 + b)};
  }
  LinePolynomial all{};
  for (std::size_t i = 0; i < 3; ++i) {
    std::array<double, 5> plane{};
    for (std::size_t j = 0; j < 3; ++j) {
      const double* row = c.data() + 9 * i + 3 * j;
      std::array<double, 3> line;
      for (std::size_t m = 0; m < 3; ++m) line[m] = row[0] * w[2][0][m] + row[1] * w[2][1][m] + row[2] * w[2][2][m];
      for (std::size_t m = 0; m < 3; ++m)
        for (std::size_t n = 0; n < 3; ++n) plane[m + n] += line[m] * w[1][j][n];
    }
    for (std::size_t m = 0; m < 5; ++m)
      for (std::size_t n = 0; n < 3; ++n) all[m + n] += plane[m] * w[0][i][n];
  }
  constexpr std::array<double, 7> kBinomials{1.0, 6.0, 15.0, 20.0, 15.0, 6.0, 1.0};
  for (std::size_t m = 0; m < all.size(); ++m) all[m] /= kBinomials[m];
  return all;
}

namespace cell {

/// Value and derivative by s in [0, 1], by de Casteljau.
inline std::pair<double, double> evaluated(LinePolynomial b, double s) {
  for (std::size_t n = 6; n > 1; --n)
    for (std::size_t k = 0; k < n; ++k) b[k] += s * (b[k + 1] - b[k]);
  return {b[0] + s * (b[1] - b[0]), 6.0 * (b[1] - b[0])};
}

/// The two halves.
inline std::pair<LinePolynomial, LinePolynomial> halves(LinePolynomial b) {
  LinePolynomial left{}, right{};
  for (std::size_t n = 0; n < 7; ++n) {
    left[n] = b[0];
    right[6 - n] = b[6 - n];
    for (std::size_t k = 0; k + n < 6; ++k) b[k] = 0.5 * (b[k] + b[k + 1]);
  }
  return {left, right};
}

inline int sign_changes(const LinePolynomial& b) {
  int changes = 0;
  double last = 0.0;
  for (const double v : b) {
    if (v == 0.0) continue;
    if (last != 0.0 && (v > 0.0) != (last > 0.0)) ++changes;
    last = v;
  }
  return changes;
}

/// The one root between ends of different signs: Newton's steps, halved where they leave what holds the root.
inline double root(const LinePolynomial& b) {
  constexpr int kMost = 100;
  const bool falls = b[0] > 0.0;
  double low = 0.0, high = 1.0, s = b[0] / (b[0] - b[6]);
  for (int i = 0; i < kMost; ++i) {
    const auto [value, slope] = evaluated(b, s);
    if (value == 0.0) break;
    ((value > 0.0) == falls ? low : high) = s;
    double next = s - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == s || std::fabs(next - s) < 1e-16) break;
    s = next;
  }
  return s;
}

}  // namespace cell

/// Visits the places s in [0, 1] where the function changes its sign, in their order, until each(s, falling) says true.
/// Sign changes of the coefficients count roots from above (Descartes); where they leave a doubt the piece is halved,
/// so that none is passed over. What ends within kTouch of zero crosses there: neighbouring pieces that meet at a root
/// both have it, however their rounding differs.
template <class Each>
bool each_crossing(LinePolynomial b, const Each& each) {
  constexpr double kTouch = 1e-12, kShortest = 1e-9;
  if (std::fabs(b[0]) <= kTouch) b[0] = b[1] > 0.0 ? -kTouch : kTouch;
  if (std::fabs(b[6]) <= kTouch) b[6] = b[5] > 0.0 ? -kTouch : kTouch;
  const auto search = [&each](const auto& self, const LinePolynomial& piece, double from, double length) -> bool {
    const int changes = cell::sign_changes(piece);
    if (changes == 0) return false;
    if (changes == 1 && piece[0] != 0.0 && piece[6] != 0.0)
      return each(from + length * cell::root(piece), piece[0] > 0.0);
    if (length < kShortest) {
      if ((piece[0] > 0.0) == (piece[6] > 0.0)) return false;
      return each(from + 0.5 * length, piece[0] > 0.0);
    }
    auto [left, right] = cell::halves(piece);
    // a root in the middle itself belongs to the left half
    if (left[6] == 0.0) left[6] = right[0] = left[0] > 0.0 ? -1e-300 : 1e-300;
    return self(self, left, from, 0.5 * length) || self(self, right, from + 0.5 * length, 0.5 * length);
  };
  return search(search, b, 0.0, 1.0);
}

}  // namespace treadmark::levelset
