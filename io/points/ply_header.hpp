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

}  // namespace treadmark::io::points
