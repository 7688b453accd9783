// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#if defined(__AVX2__)
#include "treadmark/backends/spline/slices/slice_kernel.hpp"

namespace treadmark::spline {

const SliceKernels* slice_kernels_avx2() { return &kKernels; }

}  // namespace treadmark::spline
#else
#include "treadmark/backends/spline/slices/slice_kernels.hpp"

namespace treadmark::spline {

const SliceKernels* slice_kernels_avx2() { return nullptr; }

}  // namespace treadmark::spline
#endif
