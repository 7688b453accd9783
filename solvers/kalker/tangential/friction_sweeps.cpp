// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/friction_sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "treadmark/core/cancellation.hpp"

namespace treadmark::kalker {

namespace {

constexpr int kElementIterations = 60;
constexpr double kElementAccuracy = 1e-14;

}  // namespace

std::array<double, 2> element_traction(std::array<double, 2> k, std::array<double, 2> c, double bound) {
  const auto at = [&](double m) { return std::array<double, 2>{-c[0] / (k[0] + m), -c[1] / (k[1] + m)}; };
  const auto size = [](const std::array<double, 2>& q) { return std::hypot(q[0], q[1]); };
  if (!(bound > 0.0)) return {0.0, 0.0};
  std::array<double, 2> q = at(0.0);
  if (size(q) <= bound) return q;
  // (K + m) q = -c with |q| = bound: Newton on 1/|q| - 1/bound, nearly linear in m and monotone from the left.
  double m = std::max(0.0, std::hypot(c[0], c[1]) / bound - std::max(k[0], k[1]));
  for (int iteration = 0; iteration < kElementIterations; ++iteration) {
    q = at(m);
    const double s = size(q);
    if (std::abs(s - bound) <= kElementAccuracy * bound) break;
    const double derivative = -(q[0] * q[0] / (k[0] + m) + q[1] * q[1] / (k[1] + m)) / s;  // of |q|
    m = std::max(0.0, m - (s - bound) * s / (bound * derivative));
  }
  const double s = size(q);
  return {q[0] * bound / s, q[1] * bound / s};
}

FrictionSweeps::FrictionSweeps(const PatchOperator& matrix)
    : compliance_(matrix.compliance()),
      patch_(matrix.patch()),
      rows_(matrix.rows()),
      rolling_(patch_.transport != Transport::none),
      width_(patch_.box_nx + 2) {
  nodes_x_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(patch_.box_ny));
  nodes_y_.resize(nodes_x_.size());
  const int nx = patch_.box_nx, ny = patch_.box_ny;
  if (rows_) {
    table_.resize(static_cast<std::size_t>(ny) * static_cast<std::size_t>(2 * nx + 1));
    return;
  }
  for (int diy = 1 - ny; diy < ny; ++diy)
    for (int dix = nx; dix >= -nx; --dix) table_.push_back(compliance_.at(dix, diy));
}

void FrictionSweeps::turn_row(int observed) {
  if (!rows_ || turned_row_ == observed) return;
  turned_row_ = observed;
  std::size_t k = 0;
  for (int jy = 0; jy < patch_.box_ny; ++jy)
    for (int dix = patch_.box_nx; dix >= -patch_.box_nx; --dix) table_[k++] = compliance_.at(dix, jy, observed, *rows_);
}

const Compliance::Entry* FrictionSweeps::coefficients(int ix, int iy, int jy) const {
  const int row = rows_ ? jy : iy - jy + patch_.box_ny - 1;
  return &table_[static_cast<std::size_t>(row * (2 * patch_.box_nx + 1) + patch_.box_nx - ix - 1)];
}

int FrictionSweeps::run(const FrictionProblem& problem, std::span<double> p, double eps, int count) {
  const std::size_t n = problem.bound.size();
  const int nx = patch_.box_nx, ny = patch_.box_ny;
  const int behind = patch_.transport == Transport::backward ? 1 : -1;  // step in x
  const auto node = [&](std::size_t i) {
    const auto cell = static_cast<int>(patch_.cell[i]);
    return static_cast<std::size_t>(cell / nx * width_ + cell % nx + 1);
  };
  const auto add = [&](std::size_t at, double x, double y) {
    nodes_x_[at] += x;
    nodes_y_[at] += y;
  };
  std::fill(nodes_x_.begin(), nodes_x_.end(), 0.0);
  std::fill(nodes_y_.begin(), nodes_y_.end(), 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    add(node(i), p[i], p[n + i]);
    if (rolling_) add(node(i) + static_cast<std::size_t>(behind), -p[i], -p[n + i]);
  }

  constexpr std::size_t kProducts = std::size_t{1} << 20;  // between two check points: about a millisecond
  const auto products = static_cast<std::size_t>(ny) * static_cast<std::size_t>(width_);
  std::size_t since = kProducts;
  int sweeps = 0;
  for (; sweeps < count;) {
    ++sweeps;
    double change = 0.0, total = 0.0;
    for (std::size_t i = n; i-- > 0;) {
      if ((since += products) > kProducts) {
        since = 0;
        check_cancelled();
      }
      // Slip of this element by all others and itself.
      double sx = problem.rigid_slip[i], sy = problem.rigid_slip[n + i];
      const int cell = static_cast<int>(patch_.cell[i]), ix = cell % nx, iy = cell / nx;
      turn_row(iy);
      for (int jy = 0; jy < ny; ++jy) {
        const Compliance::Entry* b = coefficients(ix, iy, jy);
        const std::size_t first = static_cast<std::size_t>(jy * width_);
        // Source columns -1 to nx, offsets ix + 1 down to ix - nx.
        for (int jx = -1; jx <= nx; ++jx, ++b) {
          const double x = nodes_x_[first + static_cast<std::size_t>(jx + 1)];
          const double y = nodes_y_[first + static_cast<std::size_t>(jx + 1)];
          sx += b->xx * x + b->xy * y;
          sy += b->yx * x + b->yy * y;
        }
      }
      // Elements that move with this one: those behind it in adhesion, i.e. strictly inside their bounds.
      std::size_t last = i;
      int distance = 1;
      if (rolling_)
        while (last + 1 < n && patch_.ahead[last + 1] == static_cast<int>(last) &&
               std::hypot(p[last + 1], p[n + last + 1]) < problem.bound[last + 1] * (1.0 - 1e-12)) {
          ++last;
          ++distance;
        }
      const Compliance::Entry own = compliance_.at(0, 0);
      std::array<double, 2> k{own.xx, own.yy};
      if (rolling_) {
        const Compliance::Entry other = compliance_.at(-behind * distance, 0);
        k[0] -= other.xx;
        k[1] -= other.yy;
      }
      const std::array<double, 2> q = element_traction(k, {sx - k[0] * p[i], sy - k[1] * p[n + i]}, problem.bound[i]);
      const double ax = q[0] - p[i], ay = q[1] - p[n + i];
      add(node(i), ax, ay);
      if (rolling_) add(node(last) + static_cast<std::size_t>(behind), -ax, -ay);
      for (std::size_t j = i; j <= last; ++j) {
        p[j] += ax;
        p[n + j] += ay;
        change += ax * ax + ay * ay;
      }
    }
    for (std::size_t k = 0; k < 2 * n; ++k) total += p[k] * p[k];
    if (!(std::sqrt(change) > eps * std::sqrt(total))) break;  // also where they are no numbers
  }
  return sweeps;
}

}  // namespace treadmark::kalker
