// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/kernels.hpp"

#include "treadmark/core/cpu.hpp"

namespace treadmark::mesh {

const Kernels& generic_kernels() {
  static const Kernels generic{fill_tile_generic, find_bounds_generic, kPatchGeneric, fit_cubics_generic};
  return generic;
}

const Kernels* avx2_kernels() {
#if defined(__x86_64__)
  static const Kernels avx2{fill_tile_avx2, find_bounds_avx2, kPatchAvx2, fit_cubics_avx2};
  if (cpu_has_avx2()) return &avx2;
#endif
  return nullptr;
}

const Kernels& kernels() {
  static const Kernels& fastest = avx2_kernels() ? *avx2_kernels() : generic_kernels();
  return fastest;
}

}  // namespace treadmark::mesh
