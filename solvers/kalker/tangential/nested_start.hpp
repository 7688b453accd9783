// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/solvers/kalker/tangential/friction_solve.hpp"
#include "treadmark/solvers/kalker/tangential/patch_solver.hpp"

namespace treadmark::kalker {

/// Start values from the same problem on elements of twice the size, solved roughly and in the same manner.
/// key: coefficients of the patch; bound: friction bound per element [Pa]; known_slip: slip distance per step without
/// tractions [m]. Returns tractions within the bound, which are zero where the patch is too small for this to pay.
Field2 nested_start(const Patch& patch, const ComplianceKey& key, std::span<const double> bound,
                    const Field2& known_slip, ComplianceCache& cache);

}  // namespace treadmark::kalker
