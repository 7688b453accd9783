// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_points.hpp"

namespace treadmark::offset {

SheetKernel sheet_kernel_generic(int degree) { return kernel_of_degree(degree); }

}  // namespace treadmark::offset
