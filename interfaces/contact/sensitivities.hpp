// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>

#include "treadmark/interfaces/contact/problem.hpp"

namespace treadmark::contact {

/// Rows F_n, F_x / (mu F_n), F_y / (mu F_n), M_n; columns approach, xi, eta, phi; in the caller's units.
using SensitivityMatrix = std::array<std::array<double, 4>, 4>;

/// Of a patch of the last solution: 0 where they were not asked for. with_moment: also the row of M_n, by central
/// differences: six further solutions of steady rolling on the patch as it is; 0 for a curved reference, for
/// other regimes, and where the patch has parts that hardly feel each other. Errors: Error.
SensitivityMatrix sensitivities(const Problem& problem, const io::PatchResult& patch, bool with_moment);

}  // namespace treadmark::contact
