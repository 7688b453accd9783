// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/fit.hpp"
#if defined(__AVX2__)
#include "treadmark/backends/mesh/fit_kernel.hpp"

namespace treadmark::mesh {

void fit_cubics_avx2(FitBlock& block) { fit_cubics(block); }

}  // namespace treadmark::mesh
#endif
