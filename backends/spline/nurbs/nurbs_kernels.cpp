// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_kernels.hpp"

#include "treadmark/core/cpu.hpp"

namespace treadmark::spline {

const NurbsKernels& nurbs_kernels() {
  static const NurbsKernels& chosen =
      nurbs_kernels_avx2() != nullptr && cpu_has_avx2() ? *nurbs_kernels_avx2() : nurbs_kernels_generic();
  return chosen;
}

}  // namespace treadmark::spline
