// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "treadmark/backends/displacement/band_kernel.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::displacement {

/// Natural coordinates (see NaturalPoint) of points of a row y = const of a plane, many at a time.
class NaturalRow {
 public:
  NaturalRow(Body body, const Pose& X_SP) : wheel_(body == Body::wheel), X_(X_SP) {}

  /// A point in whose neighbourhood most others lie: there it is fast.
  void look_near(const Vec3& q_S) {
    theta_ = std::atan2(q_S.x(), q_S.z());
    sin_ = std::sin(theta_), cos_ = std::cos(theta_);
  }

  std::vector<double> u, y;             ///< natural coordinates
  std::vector<double> sin, cos, per_r;  ///< of a wheel's theta; 1/r

  void resize(std::size_t n) {
    for (auto* one : {&u, &y, &sin, &cos, &per_r}) one->resize(n);
  }

  /// For points (x[i], y_P, t[i]), i < n.
  void find(double y_P, const double* x, const double* t, std::size_t n) {
    const Mat3& R = X_.rotation;
    const Vec3 o = X_.origin + R.col(1) * y_P;
    const double yx = R(1, 0), yt = R(1, 2), oy = o.y();
    for (std::size_t i = 0; i < n; ++i) y[i] = oy + yx * x[i] + yt * t[i];
    const double xx = R(0, 0), xt = R(0, 2), ox = o.x();
    if (!wheel_) {
      for (std::size_t i = 0; i < n; ++i) u[i] = ox + xx * x[i] + xt * t[i];
      return;
    }
    const BandTurn turn{ox, xx, xt, o.z(), R(2, 0), R(2, 2), theta_, sin_, cos_};
    if (kernel_.turn(turn, n, x, t, u.data(), sin.data(), cos.data(), per_r.data())) return;
    for (std::size_t i = 0; i < n; ++i) u[i] = std::atan2(sin[i], cos[i]);
  }

 private:
  bool wheel_;
  const Pose& X_;
  const BandKernel& kernel_ = fastest_kernel<BandKernel>();
  double theta_ = 0.0, sin_ = 0.0, cos_ = 1.0;
};

}  // namespace treadmark::displacement
