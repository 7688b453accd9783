// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/band_rows.hpp"
#include "treadmark/core/cpu.hpp"

namespace treadmark::displacement {

const BandKernel& band_kernel_generic() { return kBandKernel; }

const BandKernel& band_kernel() {
  const BandKernel* avx2 = cpu_has_avx2() ? band_kernel_avx2() : nullptr;
  return avx2 != nullptr ? *avx2 : kBandKernel;
}

}  // namespace treadmark::displacement
