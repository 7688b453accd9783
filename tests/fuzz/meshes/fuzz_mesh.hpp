// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"

namespace treadmark::fuzz {

/// What the users of a mesh rely on: finite vertices, corners that exist, not more elements than the file has bytes.
inline void require_sound(const TriangleMesh& mesh, std::size_t size) {
  bool sound = !mesh.triangles.empty() && mesh.vertices.size() + mesh.triangles.size() <= size;
  for (const Vec3& v : mesh.vertices) sound = sound && v.allFinite();
  for (const auto& corners : mesh.triangles)
    for (const std::uint32_t v : corners) sound = sound && v < mesh.vertices.size();
  if (!sound) std::abort();
}

/// Feeds the bytes to one parser; an Error is a fair answer, anything else that is thrown is not.
template <class Parser>
void parse_mesh(const std::uint8_t* data, std::size_t size, Parser parser) {
  try {
    require_sound(parser(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz", 1e-3), size);
  } catch (const Error&) {
  }
}

}  // namespace treadmark::fuzz
