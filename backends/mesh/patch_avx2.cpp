// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/patch.hpp"
#if defined(__AVX2__)
#include "treadmark/backends/mesh/patch_kernel.hpp"

namespace treadmark::mesh {

const PatchKernel kPatchAvx2{prepare_patch, patch_points, patch_mixed, patch_bulge};

}  // namespace treadmark::mesh
#endif
