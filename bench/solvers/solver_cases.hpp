// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/tangential/compliance.hpp"
#include "treadmark/solvers/kalker/tangential/patch.hpp"

namespace treadmark::bench {

struct CreepageRegime {
  std::string name;
  kalker::Creepage creepage;
};
/// Little slip; slip in part of the contact; slip nearly everywhere.
const std::vector<CreepageRegime>& creepage_regimes();

/// Hertzian contact of 8 mm x 4 mm under 82 kN in steady rolling, on n x n elements over 1.1 times the ellipse.
/// Neither copied nor moved: the problem refers to the gap.
struct HertzCase {
  HertzCase(int n, const kalker::Creepage& creepage);
  HertzCase(const HertzCase&) = delete;
  HertzCase& operator=(const HertzCase&) = delete;

  kalker::HertzShape shape;
  std::vector<double> gap;
  kalker::ContactProblem problem;

  /// Tangential force over the friction bound.
  double saturation(const kalker::ContactSolution& solution) const;
};

/// The matrix of steady rolling on a solved contact area, for whoever wants to multiply by it himself.
struct RollingMatrix {
  RollingMatrix(const kalker::ContactProblem& problem, const kalker::ContactSolution& normal);
  RollingMatrix(const RollingMatrix&) = delete;
  RollingMatrix& operator=(const RollingMatrix&) = delete;

  kalker::Patch patch;
  kalker::Compliance compliance;
  kalker::PatchOperator product;
};

}  // namespace treadmark::bench
