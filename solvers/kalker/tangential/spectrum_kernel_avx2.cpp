// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/spectrum_kernel.hpp"

#if defined(__AVX2__)
#include "treadmark/solvers/kalker/tangential/spectrum_lanes.hpp"
#endif

namespace treadmark::kalker {

const SpectrumKernel* spectrum_kernel_avx2() {
#if defined(__AVX2__)
  return &kSpectrumKernel;
#else
  return nullptr;
#endif
}

}  // namespace treadmark::kalker
