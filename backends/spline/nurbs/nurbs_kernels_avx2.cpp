// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#if defined(__AVX2__)
#include "treadmark/backends/spline/nurbs/nurbs_kernel.hpp"

namespace treadmark::spline {

const NurbsKernels* nurbs_kernels_avx2() { return &kNurbsKernels; }

}  // namespace treadmark::spline
#else
#include "treadmark/backends/spline/nurbs/nurbs_kernels.hpp"

namespace treadmark::spline {

const NurbsKernels* nurbs_kernels_avx2() { return nullptr; }

}  // namespace treadmark::spline
#endif
