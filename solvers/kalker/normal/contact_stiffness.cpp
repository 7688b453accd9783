// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/contact_stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "treadmark/core/cancellation.hpp"

namespace treadmark::kalker {

namespace {

constexpr int kMostIterations = 200;
constexpr double kNothingLeft = 1e-14;  ///< of the right-hand side, where rounding alone is left

double stiffness_dot(const AlignedVector<double>& a, const AlignedVector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

}  // namespace

PressureOnArea pressure_on_area(const NormalOperator& op, const AlignedVector<double>& inside,
                                const AlignedVector<double>& f, std::optional<double> sum, double eps) {
  const std::size_t n = inside.size();
  const double count = std::accumulate(inside.begin(), inside.end(), 0.0);
  PressureOnArea out;
  AlignedVector<double>& q = out.q;
  q.assign(n, 0.0);
  AlignedVector<double> r(f), z(n), v(n, 0.0), image(n);
  const auto cut_to_area = [&](AlignedVector<double>& field) {
    for (std::size_t i = 0; i < n; ++i) field[i] *= inside[i];
  };
  const auto remove_mean = [&](AlignedVector<double>& field) {
    if (!sum) return 0.0;
    const double mean = std::accumulate(field.begin(), field.end(), 0.0) / count;
    for (std::size_t i = 0; i < n; ++i) field[i] -= mean * inside[i];
    return mean;
  };
  double size = stiffness_dot(r, r);
  if (sum && *sum != 0.0) {
    for (std::size_t i = 0; i < n; ++i) q[i] = *sum / count * inside[i];
    op.displacement(q, image);
    cut_to_area(image);
    size += stiffness_dot(image, image);
    for (std::size_t i = 0; i < n; ++i) r[i] -= image[i];
  }
  out.shift = remove_mean(r);
  if (stiffness_dot(r, r) <= kNothingLeft * kNothingLeft * size) {
    out.converged = true;
    return out;
  }
  double old = 0.0, first = 0.0;
  for (;; ++out.iterations) {
    check_cancelled();
    op.precondition(r, z);
    cut_to_area(z);
    remove_mean(z);
    const double now = stiffness_dot(r, z);
    if (out.iterations == 0) first = now;
    out.residual = std::sqrt(std::max(now, 0.0) / first);
    out.converged = std::abs(now) <= eps * eps * first;
    if (out.converged || out.iterations == kMostIterations) return out;
    const double beta = out.iterations > 0 ? now / old : 0.0;
    for (std::size_t i = 0; i < n; ++i) v[i] = z[i] + beta * v[i];
    op.displacement(v, image);
    cut_to_area(image);
    const double step = now / stiffness_dot(v, image);
    out.shift -= step * remove_mean(image);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] += step * v[i];
      r[i] -= step * image[i];
    }
    old = now;
  }
}

}  // namespace treadmark::kalker
