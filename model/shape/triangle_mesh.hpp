// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark {

/// Triangles over shared vertices, in the surface frame. Orientation: counter-clockwise seen from outside the material.
struct TriangleMesh {
  std::string name;            ///< where it comes from, for messages
  std::vector<Vec3> vertices;  ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace treadmark
