// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/kernel_types.hpp"
#if defined(__AVX2__)
#include "treadmark/backends/mesh/tile_kernel.hpp"

namespace treadmark::mesh {

bool fill_tile_avx2(const MeshArrays& mesh, const PlaneLines& lines, Tile& tile) {
  return TileFill(mesh, lines, tile).run();
}

}  // namespace treadmark::mesh
#endif
