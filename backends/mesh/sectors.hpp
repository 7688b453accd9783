// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/backends/mesh/prepared_mesh.hpp"

namespace treadmark::mesh {

/// Corners of triangles gathered into sectors: the triangles round a vertex between creases and rims.
struct Sectors {
  std::vector<Corners> of_corner;     ///< sector of each corner of each triangle
  std::vector<std::uint32_t> vertex;  ///< of each sector
  std::vector<std::uint32_t> begin;   ///< in triangles, one more than there are sectors
  std::vector<std::uint32_t> triangles;

  std::size_t size() const { return vertex.size(); }
  std::span<const std::uint32_t> around(std::uint32_t sector) const {
    return {triangles.data() + begin[sector], begin[sector + 1] - begin[sector]};
  }
};

/// crease_angle: edges that turn more separate sectors [rad].
Sectors find_sectors(const PreparedMesh& mesh, double crease_angle);

}  // namespace treadmark::mesh
