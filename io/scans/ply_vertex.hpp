// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/length_unit.hpp"
#include "treadmark/io/meshes/ply_header.hpp"

namespace treadmark::io::scans {

/// Which property of a vertex holds what. Values of a point: x y z nx ny nz pass.
struct PlyVertex {
  static constexpr int kPass = 6, kValues = 7;
  std::size_t element = 0;  ///< the vertices among the elements
  std::vector<int> value;   ///< per property: which value it is, -1: none
  bool normals = false, pass = false;
  std::string pass_name;
  bool has_lists = false;
};

/// Finds the vertices; Error(input_data) where there are none, several, without coordinates, or more elements of any
/// kind than `left` bytes can hold.
PlyVertex find_ply_vertex(const meshes::PlyHeader& header, std::uint64_t left, const std::string& file);

/// What the comments of a header say.
std::optional<LengthUnit> unit_of_ply_header(std::string_view header);

}  // namespace treadmark::io::scans
