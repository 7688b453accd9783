// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/mesh/ray_scene.hpp"

namespace treadmark::mesh {

std::unique_ptr<const RayScene> ray_scene(const PreparedMesh&) { return nullptr; }

}  // namespace treadmark::mesh
