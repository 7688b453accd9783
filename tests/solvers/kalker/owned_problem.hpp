// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"

namespace treadmark::kalker::testing {

inline const CombinedMaterial kSteel = combine(Material{});

/// A contact problem that owns its gap.
struct OwnedProblem {
  ContactProblem problem;
  std::vector<double> gap;

  OwnedProblem() = default;
  OwnedProblem(const Grid2& grid, std::vector<double> h) : gap(std::move(h)) {
    problem.grid = grid;
    problem.gap = gap;
  }
  OwnedProblem(const OwnedProblem& other) : problem(other.problem), gap(other.gap) { problem.gap = gap; }
  OwnedProblem& operator=(const OwnedProblem&) = delete;
};

/// The frictionless problem of a Hertzian contact with prescribed force.
inline OwnedProblem hertzian(const HertzShape& shape, const Grid2& grid) {
  OwnedProblem owned(grid, hertz_gap(shape, grid));
  owned.problem.normal_force = shape.force;
  return owned;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) out = std::max(out, std::abs(a[i] - b[i]));
  return out;
}

}  // namespace treadmark::kalker::testing
