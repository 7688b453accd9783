// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

namespace treadmark::kalker {

/// Pressures on a contact area that stays as it is.
struct PressureOnArea {
  AlignedVector<double> q;  ///< 0 outside the area
  double shift = 0.0;       ///< c
  int iterations = 0;       ///< two products each
  double residual = 0.0;    ///< relative to that of the start
  bool converged = false;
};

/// A q = f - c where inside is 1, q = 0 elsewhere: without a sum of q c = 0, else c is what gives q that sum. By
/// conjugate gradients to a relative accuracy eps; f is 0 outside. Fields of the operator's box; operators whose
/// coefficients are symmetric.
PressureOnArea pressure_on_area(const NormalOperator& op, const AlignedVector<double>& inside,
                                const AlignedVector<double>& f, std::optional<double> sum, double eps);

}  // namespace treadmark::kalker
