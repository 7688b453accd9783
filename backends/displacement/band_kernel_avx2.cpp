// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/band_kernel.hpp"

#if defined(__AVX2__) && defined(__FMA__)
#include "treadmark/backends/displacement/band_rows.hpp"
#endif

namespace treadmark::displacement {

const BandKernel* band_kernel_avx2() {
#if defined(__AVX2__) && defined(__FMA__)
  return &kBandKernel;
#else
  return nullptr;
#endif
}

}  // namespace treadmark::displacement
