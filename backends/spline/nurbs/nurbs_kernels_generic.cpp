// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_kernel.hpp"

namespace treadmark::spline {

const NurbsKernels& nurbs_kernels_generic() { return kNurbsKernels; }

}  // namespace treadmark::spline
