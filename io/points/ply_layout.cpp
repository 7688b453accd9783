// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/ply_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/sink.hpp"

namespace treadmark::io::points {

namespace {

constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::string_view kPassNames[] = {"pass", "pass_id", "scan_id", "scan",
                                           "point_source_id"};  // the first found counts
constexpr int kPass = static_cast<int>(kPassValue);

[[noreturn]] void refuse_ply(const std::string& file, const std::string& message, const std::string& advice = {}) {
  throw Error(ErrorKind::input_data, message, {file, 0, 0}, advice);
}

std::size_t find_one(const PlyHeader& header, const std::string& name, const std::string& file, bool faces) {
  const auto is_it = [&](const PlyElement& e) { return e.name == name; };
  const auto& all = header.elements;
  const auto count = std::count_if(all.begin(), all.end(), is_it);
  if (count != 1)
    refuse_ply(file, fmt::format("the header names the element {} {} times", name, count),
               !faces       ? "points are read from one element vertex"
               : count == 0 ? "is it a point cloud? make triangles of it first"
                            : "it must be there once");
  return static_cast<std::size_t>(std::find_if(all.begin(), all.end(), is_it) - all.begin());
}

void refuse_too_many(const PlyHeader& header, std::uint64_t left, const std::string& file) {
  std::uint64_t needed = 0;
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty() && element.count > 0)
      refuse_ply(file, fmt::format("the element {} has no properties", profiles::printable(element.name)));
    std::uint64_t least = 0;  // a value of text takes a character and a blank
    for (const PlyProperty& p : element.properties)
      least += header.format == PlyHeader::Format::ascii ? 2 : size_of(p.list ? p.count_type : p.type);
    needed += element.count * least;
    if (needed > left + 1)  // the last line may lack its end
      refuse_ply(file,
                 fmt::format("the header promises {} times {}, more than the file holds", element.count,
                             profiles::printable(element.name)),
                 "is it truncated?");
  }
}

void find_values(const PlyElement& element, const std::string& file, bool faces, PlyLayout& layout) {
  layout.value.assign(element.properties.size(), -1);
  std::array<int, kVertexValues> count{};
  std::size_t best_pass = std::size(kPassNames);
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& p = element.properties[k];
    if (p.list) continue;
    const std::string name = profiles::lower(p.name);
    for (int value = 0; value < (faces ? 3 : kPass); ++value)
      if (name == kNames[value]) {
        if (++count[static_cast<std::size_t>(value)] > 1)
          refuse_ply(file, "the vertices have the property " + name + " twice");
        layout.value[k] = value;
      }
    const auto rank = static_cast<std::size_t>(std::find(std::begin(kPassNames), std::end(kPassNames), name) -
                                               std::begin(kPassNames));
    if (!faces && rank < best_pass && is_whole_type(p.type)) {
      std::replace(layout.value.begin(), layout.value.end(), kPass, -1);
      layout.value[k] = kPass;
      layout.pass = true;
      layout.pass_name = name;
      best_pass = rank;
    }
  }
  if (count[0] + count[1] + count[2] < 3)
    refuse_ply(file, faces ? "the vertices lack one of x, y, z" : "the vertices lack one of the properties x, y, z");
  layout.normals = count[3] + count[4] + count[5] == 3;
  if (!layout.normals)
    for (int& value : layout.value)
      if (value >= 3 && value < kPass) value = -1;
}

}  // namespace

PlyLayout find_ply_layout(const PlyHeader& header, std::uint64_t left, const std::string& file, bool faces) {
  PlyLayout layout;
  refuse_too_many(header, left, file);
  layout.vertex = find_one(header, "vertex", file, faces);
  if (faces) layout.face = find_one(header, "face", file, faces);
  find_values(header.elements[layout.vertex], file, faces, layout);
  if (!faces) return layout;
  const std::vector<PlyProperty>& properties = header.elements[layout.face].properties;
  for (std::size_t k = 0; k < properties.size(); ++k)
    if (properties[k].list && (properties[k].name == "vertex_indices" || properties[k].name == "vertex_index"))
      layout.corners = k;
  if (layout.corners == PlyLayout::kNone)
    refuse_ply(file, "the faces lack the list vertex_indices", "triangle strips are not read: export triangles");
  return layout;
}

std::string in_words(const PlyHeader& header, const PlyLayout& layout) {
  std::string words = "PLY, ";
  words += header.format == PlyHeader::Format::ascii        ? "ASCII"
           : header.format == PlyHeader::Format::big_endian ? "binary big endian"
                                                            : "binary little endian";
  if (layout.normals) words += ", normals";
  if (layout.pass) words += ", pass from the property " + layout.pass_name;
  return words;
}

}  // namespace treadmark::io::points
