// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/scans/ply_vertex.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"
#include "treadmark/io/scans/unit_words.hpp"

namespace treadmark::io::scans {

using meshes::PlyElement;
using meshes::PlyHeader;
using meshes::PlyProperty;

namespace {

constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::string_view kPassNames[] = {"pass", "pass_id", "scan_id", "scan",
                                           "point_source_id"};  // the first found counts

bool is_whole_type(meshes::PlyType type) {
  return type != meshes::PlyType::float32 && type != meshes::PlyType::float64;
}

}  // namespace

PlyVertex find_ply_vertex(const PlyHeader& header, std::uint64_t left, const std::string& file) {
  const auto refuse = [&](const std::string& message, const std::string& advice) {
    throw Error(ErrorKind::input_data, message, {file, 0, 0}, advice);
  };
  PlyVertex vertex;
  int found = 0;
  std::uint64_t needed = 0;
  for (std::size_t e = 0; e < header.elements.size(); ++e) {
    const PlyElement& element = header.elements[e];
    if (element.name == "vertex") {
      vertex.element = e;
      ++found;
    }
    if (element.properties.empty() && element.count > 0)
      refuse(fmt::format("the element {} has no properties", profiles::printable(element.name)), "");
    std::uint64_t least = 0;  // a value of text takes a character and a blank
    for (const PlyProperty& p : element.properties)
      least += header.format == PlyHeader::Format::ascii ? 2 : size_of(p.list ? p.count_type : p.type);
    needed += element.count * least;
    if (needed > left + 1)  // the last line may lack its end
      refuse(fmt::format("the header promises {} times {}, more than the file holds", element.count,
                         profiles::printable(element.name)),
             "is it truncated?");
  }
  if (found != 1)
    refuse(fmt::format("the header names the element vertex {} times", found),
           "points are read from one element vertex");

  const PlyElement& element = header.elements[vertex.element];
  vertex.value.assign(element.properties.size(), -1);
  std::array<int, PlyVertex::kValues> count{};
  std::size_t best_pass = std::size(kPassNames);
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& p = element.properties[k];
    if (p.list) {
      vertex.has_lists = true;
      continue;
    }
    const std::string name = profiles::lower(p.name);
    for (int value = 0; value < PlyVertex::kPass; ++value)
      if (name == kNames[value]) {
        if (++count[static_cast<std::size_t>(value)] > 1)
          refuse("the vertices have the property " + name + " twice", "");
        vertex.value[k] = value;
      }
    const auto rank = static_cast<std::size_t>(std::find(std::begin(kPassNames), std::end(kPassNames), name) -
                                               std::begin(kPassNames));
    if (rank < best_pass && is_whole_type(p.type)) {
      std::replace(vertex.value.begin(), vertex.value.end(), PlyVertex::kPass, -1);
      vertex.value[k] = PlyVertex::kPass;
      vertex.pass = true;
      vertex.pass_name = name;
      best_pass = rank;
    }
  }
  if (count[0] + count[1] + count[2] < 3) refuse("the vertices lack one of the properties x, y, z", "");
  vertex.normals = count[3] + count[4] + count[5] == 3;
  if (!vertex.normals)
    for (int& value : vertex.value)
      if (value >= 3 && value < PlyVertex::kPass) value = -1;
  return vertex;
}

std::optional<LengthUnit> unit_of_ply_header(std::string_view header) {
  UnitFinder unit;
  while (!header.empty()) {
    const std::size_t end = std::min(header.find_first_of("\r\n"), header.size());
    const std::string_view line = header.substr(0, end);
    header.remove_prefix(std::min(end + 1, header.size()));
    for (const std::string_view key : {"comment ", "obj_info "})
      if (line.starts_with(key)) unit.look_at(line.substr(key.size()));
  }
  return unit.unit();
}

}  // namespace treadmark::io::scans
