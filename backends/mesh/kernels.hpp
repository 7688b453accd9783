// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/fit.hpp"
#include "treadmark/backends/mesh/kernel_types.hpp"
#include "treadmark/backends/mesh/patch.hpp"

namespace treadmark::mesh {

/// The kernels of this processor.
struct Kernels {
  bool (*fill_tile)(const MeshArrays& mesh, const PlaneLines& lines, Tile& tile);
  BoundsFound (*find_bounds)(const MeshArrays& mesh, const PlaneLines& lines, const BoundsQuery& query);
  PatchKernel patch;
  void (*fit_cubics)(FitBlock& block);
};

const Kernels& generic_kernels();
/// nullptr where the processor has no AVX2.
const Kernels* avx2_kernels();
/// The fastest ones.
const Kernels& kernels();

}  // namespace treadmark::mesh
