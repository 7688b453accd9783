// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/solvers/kalker/halfspace/influence.hpp"

namespace treadmark::kalker {

/// Influence coefficients at whole element offsets, kept for reuse: one quarter of the plane, from which the others
/// follow by symmetry (xy is odd in both directions). Not thread-safe while it grows.
class InfluenceTable {
 public:
  InfluenceTable(Component component, double dx, double dy, double poisson);

  /// Makes offsets |dix| < nx, |diy| < ny available; what is known already is kept.
  void grow(int nx, int ny);
  /// C [m] at an available offset (observation minus source).
  double operator()(int dix, int diy) const {
    const int ix = dix < 0 ? -dix : dix, iy = diy < 0 ? -diy : diy;
    const double value =
        values_[static_cast<std::size_t>(ix) + static_cast<std::size_t>(nx_) * static_cast<std::size_t>(iy)];
    return odd_ && (dix < 0) != (diy < 0) ? -value : value;
  }

  double dx() const { return dx_; }
  double dy() const { return dy_; }
  double poisson() const { return poisson_; }
  int nx() const { return nx_; }
  int ny() const { return ny_; }

 private:
  Component component_;
  double dx_, dy_, poisson_;
  bool odd_;
  int nx_ = 0, ny_ = 0;
  std::vector<double> values_;
};

}  // namespace treadmark::kalker
