// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/arc_row_kernel.hpp"

namespace treadmark::analytic {

ArcRowKernel arc_row_generic() { return arc_row; }

}  // namespace treadmark::analytic
