// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <random>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/influence_operator.hpp"

namespace treadmark::kalker::testing {

/// Tractions [Pa] or displacements [m] of the elements of a box.
inline constexpr double kDx = 0.5e-3, kDy = 0.8e-3, kShearModulus = 8e10;  ///< [m], [m], [Pa]

/// Elements along and across, and from their centres to where displacements are asked for [m].
struct Box {
  int nx, ny;
  double shift_x = 0.0, shift_y = 0.0;
  double difference = 0.12;  ///< K
};

struct Fields {
  explicit Fields(std::size_t size) : x(size), y(size), n(size) {}
  std::vector<double> x, y, n;
};

inline Fields random_tractions(std::size_t size) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-1e9, 1e9);
  Fields p(size);
  for (auto* field : {&p.x, &p.y, &p.n})
    for (double& value : *field) value = uniform(generator);
  return p;
}

/// Displacements by one coefficient after the other; block(i, j): of element i by element j.
template <class Block>
Fields direct_sum(const Fields& p, double shear_modulus, Block&& block) {
  Fields u(p.x.size());
  for (std::size_t i = 0; i < u.x.size(); ++i)
    for (std::size_t j = 0; j < u.x.size(); ++j) {
      const InfluenceBlock b = block(static_cast<int>(i), static_cast<int>(j));
      u.x[i] += (b.xx * p.x[j] + b.xy * p.y[j] + b.xn * p.n[j]) / shear_modulus;
      u.y[i] += (b.yx * p.x[j] + b.yy * p.y[j] + b.yn * p.n[j]) / shear_modulus;
      u.n[i] += (b.nx * p.x[j] + b.ny * p.y[j] + b.nn * p.n[j]) / shear_modulus;
    }
  return u;
}

/// The same by all products of an operator.
inline Fields by_operator(InfluenceOperator& op, const Fields& p, const RowInclination* rows = nullptr) {
  Fields t(p.x.size()), n(p.x.size());
  op.tangential_by_tangential(p.x, p.y, t.x, t.y, rows);
  op.normal_by_tangential(p.x, p.y, t.n, rows);
  op.tangential_by_normal(p.n, n.x, n.y, rows);
  op.normal_by_normal(p.n, n.n, rows);
  for (std::size_t i = 0; i < t.x.size(); ++i) {
    t.x[i] += n.x[i];
    t.y[i] += n.y[i];
    t.n[i] += n.n[i];
  }
  return t;
}

}  // namespace treadmark::kalker::testing
