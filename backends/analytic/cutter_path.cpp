// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/cutter_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace treadmark::analytic {

namespace {

/// Slopes at the points of the natural cubic spline: the tridiagonal system of continuous second derivatives.
std::vector<double> natural_slopes(const std::vector<double>& x, const std::vector<double>& v) {
  const std::size_t n = x.size();
  std::vector<double> diagonal(n), upper(n), right(n);
  const auto chord = [&](std::size_t i) { return (v[i + 1] - v[i]) / (x[i + 1] - x[i]); };
  diagonal[0] = 2.0;
  upper[0] = 1.0;
  right[0] = 3.0 * chord(0);
  for (std::size_t i = 1; i < n; ++i) {
    double lower = 1.0, middle = 2.0, value = 3.0 * chord(i - 1);
    if (i + 1 < n) {
      const double before = 1.0 / (x[i] - x[i - 1]), after = 1.0 / (x[i + 1] - x[i]);
      lower = before;
      middle = 2.0 * (before + after);
      upper[i] = after;
      value = 3.0 * (chord(i - 1) * before + chord(i) * after);
    }
    const double factor = lower / diagonal[i - 1];
    diagonal[i] = middle - factor * upper[i - 1];
    right[i] = value - factor * right[i - 1];
  }
  std::vector<double> slopes(n);
  for (std::size_t i = n; i-- > 0;) slopes[i] = (right[i] - (i + 1 < n ? upper[i] * slopes[i + 1] : 0.0)) / diagonal[i];
  return slopes;
}

}  // namespace

CutterPath CutterPath::natural_spline(std::vector<double> x, const Values& values) {
  Values slopes;
  for (std::size_t k = 0; k < values.size(); ++k) slopes[k] = natural_slopes(x, values[k]);
  return hermite(std::move(x), values, slopes);
}

CutterPath CutterPath::hermite(std::vector<double> x, const Values& values, const Values& slopes) {
  CutterPath path;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double d = x[i + 1] - x[i];
    Piece piece;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      const double v = values[k][i], m = slopes[k][i], chord = (values[k][i + 1] - v) / d, n = slopes[k][i + 1];
      piece[k] = {v, m, (3.0 * chord - 2.0 * m - n) / d, (m + n - 2.0 * chord) / (d * d)};
    }
    path.pieces_.push_back(piece);
  }
  path.x_ = std::move(x);
  return path;
}

CutterPath::Range CutterPath::range(Coordinate which, double a, double b) const {
  a = std::clamp(a, x_min(), x_max());
  b = std::clamp(b, x_min(), x_max());
  Range all{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t i = find(a, 0); i < pieces_.size() && x_[i] <= b; ++i) {
    const double from = std::max(a, x_[i]), to = std::min(b, x_[i + 1]);
    const auto include = [&](double x) {
      const Jet p = at(which, x, i);
      all.low = std::min(all.low, p.h);
      all.high = std::max(all.high, p.h);
      all.steepest = std::max(all.steepest, std::fabs(p.dh));
    };
    include(from);
    include(to);
    // extremes inside: of the value where the slope is 0, of the slope where it turns
    const Cubic& p = pieces_[i][which];
    const auto inside = [&](double t) {
      if (x_[i] + t > from && x_[i] + t < to) include(x_[i] + t);
    };
    if (p[3] != 0.0) inside(-p[2] / (3.0 * p[3]));
    const double root = p[2] * p[2] - 3.0 * p[3] * p[1];
    if (root < 0.0) continue;
    const double q = -(p[2] + std::copysign(std::sqrt(root), p[2]));  // 3 p3 t^2 + 2 p2 t + p1 = 0
    if (p[3] != 0.0) inside(q / (3.0 * p[3]));
    if (q != 0.0) inside(p[1] / q);
  }
  return all;
}

}  // namespace treadmark::analytic
