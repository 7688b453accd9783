// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset/sheet_kernel.hpp"

#if defined(__AVX2__) && defined(__FMA__)
#include "treadmark/backends/offset/sheet_points.hpp"
#endif

namespace treadmark::offset {

SheetKernel sheet_kernel_avx2(int degree) {
#if defined(__AVX2__) && defined(__FMA__)
  return kernel_of_degree(degree);
#else
  static_cast<void>(degree);
  return nullptr;
#endif
}

}  // namespace treadmark::offset
