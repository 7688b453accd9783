// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/damage/cell_shares.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::damage {
namespace {

/// Share of a box [-a, a] that moved by [-b, b] which lies below t: two even distributions one after the other.
double below(double t, double a, double b) {
  const double half = std::max(a, b), other = std::min(a, b);
  if (t <= -(half + other)) return 0.0;
  if (t >= half + other) return 1.0;
  if (other < 1e-9 * half) return std::clamp(0.5 * (t + half) / half, 0.0, 1.0);
  const auto square = [](double x) { return x > 0.0 ? x * x : 0.0; };
  return (square(t + half + other) - square(t + half - other) - square(t - half + other) + square(t - half - other)) /
         (8.0 * half * other);
}

}  // namespace

Shares shares_of(double middle, double a, double b, double x0, double d) {
  Shares shares;
  const double first_edge = x0 - 0.5 * d;
  const int first = static_cast<int>(std::floor((middle - a - b - first_edge) / d)),
            last = static_cast<int>(std::floor((middle + a + b - first_edge) / d));
  double before = 0.0;
  for (int k = first; k <= last; ++k) {
    const double upto = k == last ? 1.0 : below(first_edge + (k + 1) * d - middle, a, b);
    if (upto > before) shares.emplace_back(k, upto - before);
    before = upto;
  }
  return shares;
}

int wrapped(const SurfaceCells& cells, int i) {
  if (!cells.closed()) return i;
  const int k = i % cells.nu;
  return k < 0 ? k + cells.nu : k;
}

bool exists(const SurfaceCells& cells, int j) {
  return j >= 0 && j < cells.ny && std::isfinite(cells.radius[static_cast<std::size_t>(j)]);
}

Shares rows_between(const SurfaceCells& cells, double y_low, double y_high) {
  const double half = 0.5 * (y_high - y_low);
  Shares rows = shares_of(0.5 * (y_low + y_high), std::max(half, 1e-12), 0.0, cells.y0, cells.dy);
  double there = 0.0;
  std::erase_if(rows, [&](const auto& row) { return !exists(cells, row.first); });
  for (const auto& row : rows) there += row.second;
  for (auto& row : rows) row.second /= there;
  return rows;
}

Shares columns_under(const SurfaceCells& cells, double u, double length, const Stretch& stretch, double radius) {
  if (cells.uniform()) return {{0, 1.0}};
  const double half = 0.5 * length / radius, moved = 0.5 * (stretch.end - stretch.begin);
  Shares shares = shares_of(u + 0.5 * (stretch.begin + stretch.end) - stretch.middle, half, std::max(moved, 0.0),
                            cells.u0, cells.du);
  for (auto& share : shares) share.first = wrapped(cells, share.first);
  return shares;
}

}  // namespace treadmark::damage
