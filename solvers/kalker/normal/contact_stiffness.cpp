// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/contact_stiffness.hpp"

#include <cmath>
#include <numeric>

namespace treadmark::kalker {

namespace {

constexpr int kMostIterations = 200;

double stiffness_dot(const AlignedVector<double>& a, const AlignedVector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

AlignedVector<double> pressure_of_unit_approach(const NormalOperator& op, const AlignedVector<double>& inside,
                                                double eps) {
  const std::size_t n = inside.size();
  AlignedVector<double> q(n, 0.0), r(inside), z(n), v(n, 0.0), image(n);
  double old = 0.0, first = 0.0;
  for (int k = 0; k < kMostIterations; ++k) {
    op.precondition(r, z);
    for (std::size_t i = 0; i < n; ++i) z[i] *= inside[i];
    const double now = stiffness_dot(r, z);
    if (k == 0) first = now;
    if (!(now > eps * eps * first)) break;
    const double beta = k > 0 ? now / old : 0.0;
    for (std::size_t i = 0; i < n; ++i) v[i] = z[i] + beta * v[i];
    op.displacement(v, image);
    for (std::size_t i = 0; i < n; ++i) image[i] *= inside[i];
    const double step = now / stiffness_dot(v, image);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] += step * v[i];
      r[i] -= step * image[i];
    }
    old = now;
  }
  return q;
}

}  // namespace treadmark::kalker
