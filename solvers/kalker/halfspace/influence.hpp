// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

namespace treadmark::kalker {

/// nn: normal displacement by pressure; xx, yy: tangential displacement by traction in the same direction;
/// xy (= yx): in the other direction.
enum class Component { nn, xx, yy, xy };

/// Influence coefficient C [m] of a rectangle dx by dy [m] under uniform traction: displacement difference
/// u = (1/G) C p of the pair of half-spaces at (X, Y) [m] relative to the centre of the loaded rectangle
/// (Boussinesq-Cerruti potentials integrated over the rectangle, Kalker 1990). G and poisson are the combined
/// constants of treadmark::combine. Accurate relative to the coefficient itself to about 5e-16 times the distance in
/// elements, but no better than 1e-15.
double influence(Component component, double X, double Y, double dx, double dy, double poisson);

/// The four coefficients at once, bit by bit the same values.
struct UncoupledCoefficients {
  double nn = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
};
UncoupledCoefficients influence(double X, double Y, double dx, double dy, double poisson);

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

/// All components at whole element offsets >= 0, kept for reuse as they are asked for. Not thread-safe.
class UncoupledTable {
 public:
  UncoupledTable(double dx, double dy, double poisson) : dx_(dx), dy_(dy), poisson_(poisson) {}

  bool is_for(double dx, double dy, double poisson) const { return dx_ == dx && dy_ == dy && poisson_ == poisson; }
  /// Makes offsets 0 <= ix < nx, 0 <= iy < ny available; what is known already is kept.
  void grow(int nx, int ny);
  const UncoupledCoefficients& at(int ix, int iy) const {
    return values_[static_cast<std::size_t>(ix) + static_cast<std::size_t>(nx_) * static_cast<std::size_t>(iy)];
  }

 private:
  double dx_, dy_, poisson_;
  int nx_ = 0, ny_ = 0;
  std::vector<UncoupledCoefficients> values_;
};

}  // namespace treadmark::kalker
