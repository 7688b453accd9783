// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#if defined(__AVX2__) && defined(__FMA__)
#include "treadmark/backends/analytic/arc_row_kernel.hpp"

namespace treadmark::analytic {
ArcRowKernel arc_row_avx2() { return arc_row; }
}  // namespace treadmark::analytic
#else
#include "treadmark/backends/analytic/arc_row.hpp"

namespace treadmark::analytic {
ArcRowKernel arc_row_avx2() { return nullptr; }
}  // namespace treadmark::analytic
#endif
