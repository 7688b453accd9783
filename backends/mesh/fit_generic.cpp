// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/fit_kernel.hpp"

namespace treadmark::mesh {

void fit_cubics_generic(FitBlock& block) { fit_cubics(block); }

}  // namespace treadmark::mesh
