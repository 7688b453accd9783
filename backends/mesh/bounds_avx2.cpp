// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/kernel_types.hpp"
#if defined(__AVX2__)
#include "treadmark/backends/mesh/bounds_kernel.hpp"

namespace treadmark::mesh {

BoundsFound find_bounds_avx2(const MeshArrays& mesh, const PlaneLines& lines, const BoundsQuery& query) {
  return BoundsSearch(mesh, lines, query).run();
}

}  // namespace treadmark::mesh
#endif
