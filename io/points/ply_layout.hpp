// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io::points {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type);
inline bool is_whole_type(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool list = false;
  PlyType count_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Format { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;
  std::size_t bytes = 0;  ///< length of the header: where the data begin
  int lines = 0;
};

/// Error(input_data) with line and column for anything that is not a header of a PLY file, version 1.0.
PlyHeader parse_ply_header(std::string_view bytes, const std::string& file);

/// Which element and which property holds what.
struct PlyLayout {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t vertex = kNone, face = kNone;  ///< elements; the faces only where they are asked for
  std::size_t corners = kNone;               ///< property of the faces
  std::vector<int> value;                    ///< per property of the vertices: which of VertexValues it is, -1: none
  bool normals = false, pass = false, intensity = false;  ///< whether vertices have them; not looked for beside faces
  std::string pass_name;
};

/// Finds the vertices, and the faces where asked for; Error(input_data) where they are missing, several, without
/// coordinates or corners, or where there are more elements of any kind than `left` bytes can hold.
PlyLayout find_ply_layout(const PlyHeader& header, std::uint64_t left, const std::string& file, bool faces);

/// "PLY, binary little endian, normals"
std::string in_words(const PlyHeader& header, const PlyLayout& layout);

}  // namespace treadmark::io::points
