// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/cpu.hpp"
#include "treadmark/solvers/kalker/tangential/spectrum_lanes.hpp"

namespace treadmark::kalker {

const SpectrumKernel& spectrum_kernel_generic() { return kSpectrumKernel; }

const SpectrumKernel& spectrum_kernel() {
  const SpectrumKernel* avx2 = cpu_has_avx2() ? spectrum_kernel_avx2() : nullptr;
  return avx2 != nullptr ? *avx2 : kSpectrumKernel;
}

}  // namespace treadmark::kalker
