// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slices/slice_kernels.hpp"

#include "treadmark/core/cpu.hpp"

namespace treadmark::spline {

const SliceKernels& slice_kernels() {
  static const SliceKernels& chosen =
      slice_kernels_avx2() != nullptr && cpu_has_avx2() ? *slice_kernels_avx2() : slice_kernels_generic();
  return chosen;
}

}  // namespace treadmark::spline
