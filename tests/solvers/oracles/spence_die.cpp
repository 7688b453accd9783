// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "spence_die.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

namespace treadmark::kalker::testing {
namespace {

// As the load grows, all states are similar, so that the increments are those of a flat die of radius a = 1 (Spence
// 1968): u_r = 0 for r < c, q = mu p for c < r < 1, u_z constant. With the Hankel transforms of the tractions written
// as p^ = int_0^1 g cos(s t) dt, q^ = int_0^1 h sin(s t) dt, Abel's inversion of the displacements turns this into
//   g - (beta/pi) PV int_-1^1 h/(t - x) dt = 1 for x < 1,   h + (beta/pi) PV int_-1^1 g/(t - x) dt = 0 for x < c,
// g even and h odd; for x > c both follow from the pressure:
//   g = (2/pi) int_x^1 r p/sqrt(r^2 - x^2) dr,   h = mu (2/pi) x int_x^1 p/sqrt(r^2 - x^2) dr.
// Finite shear at r = c asks for a continuous h: this determines mu.

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// n elements from `from` to `to`, finer towards both ends by powers.
void append_graded(std::vector<double>& edges, double from, double to, int n, double power_from, double power_to) {
  for (int i = 1; i <= n; ++i) {
    const double s = static_cast<double>(i) / n, rise = std::pow(s, power_from);
    edges.push_back(from + (to - from) * rise / (rise + std::pow(1.0 - s, power_to)));
  }
}

class Die {
 public:
  Die(double k, double beta, int n) : n_(n), edges_{0.0} {
    append_graded(edges_, 0.0, k, n, 1.0, 2.0);
    append_graded(edges_, k, 1.0, n, 2.0, 4.0);
    const int count = 2 * n;
    odd_.resize(count, count);
    even_.resize(count, count);
    normal_.resize(n, n);
    shear_.resize(n, n);
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) fill(i, j, beta / std::numbers::pi);
  }

  /// h just outside c less h just inside.
  double jump(double friction) {
    solve(friction);
    return h_(n_) - h_(n_ - 1);
  }

  SpenceCompression compression(double friction) {
    solve(friction);
    // Ring by ring: u_z outside of the die is (2/pi) int g/sqrt(r^2 - t^2) dt; a surface point comes into contact when
    // all the increments before have left it at the height of the sphere.
    double stiffness = 0.0, outside = 0.0;
    for (int i = 0; i < 2 * n_; ++i) {
      const double t = middle(i), w = edges_[static_cast<std::size_t>(i) + 1] - edges_[static_cast<std::size_t>(i)];
      const double reach =
          t < 1e-2 ? 1.0 / 3.0 + 0.1 * t * t : 0.5 * (std::asin(t) - t * std::sqrt(1.0 - t * t)) / (t * t * t);
      stiffness += w * g_(i);
      outside += w * g_(i) * reach * 2.0 / std::numbers::pi;
    }
    const double approach = 0.5 / (1.0 - 2.0 * outside);  // times a^2/R; Hertz: 1
    return {friction, stiffness / std::sqrt(approach), 1.0 / std::sqrt(approach)};
  }

 private:
  double middle(int i) const {
    return 0.5 * (edges_[static_cast<std::size_t>(i)] + edges_[static_cast<std::size_t>(i) + 1]);
  }

  void fill(int i, int j, double factor) {
    const double x = middle(i), l = edges_[static_cast<std::size_t>(j)], r = edges_[static_cast<std::size_t>(j) + 1];
    const double near = std::log(std::abs((r - x) / (l - x))), far = std::log((r + x) / (l + x));
    odd_(i, j) = factor * (near + far);
    even_(i, j) = factor * (near - far);
    if (i < n_ || j < n_) return;
    const auto root = [&](double e) { return std::sqrt(std::max(0.0, e * e - x * x)); };
    const auto arc = [&](double e) { return std::acosh(std::max(1.0, e / x)); };
    normal_(i - n_, j - n_) = 2.0 / std::numbers::pi * (root(r) - root(l));
    shear_(i - n_, j - n_) = 2.0 / std::numbers::pi * x * (arc(r) - arc(l));
  }

  /// Unknowns: g and h inside c, the pressure outside.
  void solve(double friction) {
    const int n = n_;
    const Matrix slip = friction * shear_, one = Matrix::Identity(n, n);
    Matrix m = Matrix::Zero(3 * n, 3 * n);
    m.block(0, 0, n, n) = one;
    m.block(n, 2 * n, n, n) = normal_;
    m.block(0, n, 2 * n, n) -= odd_.leftCols(n);
    m.block(0, 2 * n, 2 * n, n) -= odd_.rightCols(n) * slip;
    m.block(2 * n, n, n, n) = one;
    m.block(2 * n, 0, n, n) = even_.topLeftCorner(n, n);
    m.block(2 * n, 2 * n, n, n) += even_.topRightCorner(n, n) * normal_;
    Vector right = Vector::Zero(3 * n);
    right.head(2 * n).setOnes();
    const Vector v = m.partialPivLu().solve(right), p = v.tail(n);
    g_.resize(2 * n);
    h_.resize(2 * n);
    g_ << v.head(n), normal_ * p;
    h_ << v.segment(n, n), slip * p;
  }

  int n_;
  std::vector<double> edges_;
  Matrix odd_, even_, normal_, shear_;
  Vector g_, h_;
};

}  // namespace

namespace {

SpenceCompression without_extrapolation(double k, double beta, int n) {
  Die die(k, beta, n);
  double low = 0.0, high = 5.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (die.jump(middle) < 0.0 ? low : high) = middle;
  }
  return die.compression(0.5 * (low + high));
}

}  // namespace

SpenceCompression spence_compression(double k, double beta, int n) {
  // Constant elements collocated at their middles are of first order.
  const SpenceCompression coarse = without_extrapolation(k, beta, n / 2), fine = without_extrapolation(k, beta, n);
  return {2.0 * fine.friction - coarse.friction, 2.0 * fine.force_ratio - coarse.force_ratio,
          2.0 * fine.radius_ratio - coarse.radius_ratio};
}

}  // namespace treadmark::kalker::testing
