// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slices/slice_kernel.hpp"

namespace treadmark::spline {

const SliceKernels& slice_kernels_generic() { return kKernels; }

}  // namespace treadmark::spline
