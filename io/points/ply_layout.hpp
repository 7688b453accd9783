// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "treadmark/io/points/ply_header.hpp"

namespace treadmark::io::points {

/// Which element and which property holds what.
struct PlyLayout {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t vertex = kNone, face = kNone;  ///< elements; the faces only where they are asked for
  std::size_t corners = kNone;               ///< property of the faces
  std::vector<int> value;                    ///< per property of the vertices: which of VertexValues it is, -1: none
  bool normals = false, pass = false;        ///< whether the vertices have them; not looked for beside faces
  std::string pass_name;
};

/// Finds the vertices, and the faces where asked for; Error(input_data) where they are missing, several, without
/// coordinates or corners, or where there are more elements of any kind than `left` bytes can hold.
PlyLayout find_ply_layout(const PlyHeader& header, std::uint64_t left, const std::string& file, bool faces);

/// "PLY, binary little endian, normals"
std::string in_words(const PlyHeader& header, const PlyLayout& layout);

}  // namespace treadmark::io::points
