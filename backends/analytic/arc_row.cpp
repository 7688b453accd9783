// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/arc_row.hpp"

#include "treadmark/core/cpu.hpp"

namespace treadmark::analytic {

ArcRowKernel arc_row_kernel() {
  static const ArcRowKernel kernel = cpu_has_avx2() && arc_row_avx2() != nullptr ? arc_row_avx2() : arc_row_generic();
  return kernel;
}

}  // namespace treadmark::analytic
