// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <optional>

#include "treadmark/io/meshes/byte_reader.hpp"
#include "treadmark/io/meshes/mesh_builder.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"

namespace treadmark::io::meshes {

namespace {

using profiles::LineScanner;
using profiles::lower;
using profiles::printable;
using profiles::Word;

constexpr std::size_t kHeader = 80, kFacet = 50;

/// Many binary files begin with the word solid too, so their size decides; after that what the first lines hold.
bool is_binary(std::string_view bytes, const std::string& file) {
  if (bytes.size() >= kHeader + 4) {
    ByteReader reader(bytes, file, false, kHeader);
    if (bytes.size() == kHeader + 4 + kFacet * static_cast<std::uint64_t>(reader.read<std::uint32_t>())) return true;
  }
  std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos || lower(bytes.substr(start, 5)) != "solid") return true;
  return bytes.substr(0, 1000).find('\0') != std::string_view::npos;
}

TriangleMesh parse_binary(std::string_view bytes, const std::string& file, double scale) {
  ByteReader reader(bytes, file, false);
  reader.skip(kHeader);
  const std::uint64_t count = reader.read<std::uint32_t>();
  if (count > kMostElements / 3) reader.fail(fmt::format("{} triangles are too many", count), "is it an STL file?");
  if (reader.left() < count * kFacet)
    reader.fail(fmt::format("{} triangles are promised, the file holds {}", count, reader.left() / kFacet),
                "is it truncated?");
  MeshBuilder builder(file, scale);
  builder.reserve(3 * count, count);
  const MeshBuilder::Fail fail = [&](const std::string& message, const std::string& advice) {
    reader.fail(message, advice);
  };
  for (std::uint64_t t = 0; t < count; ++t) {
    reader.skip(3 * sizeof(float));  // the normal follows from the order of the corners
    for (int k = 0; k < 3; ++k) {
      const double x = static_cast<double>(reader.read<float>()), y = static_cast<double>(reader.read<float>()),
                   z = static_cast<double>(reader.read<float>());
      builder.add_vertex(x, y, z, fail);
    }
    reader.skip(2);
    const auto n = static_cast<std::uint32_t>(3 * t);
    builder.add_polygon({n, n + 1, n + 2}, fail);
  }
  return builder.finish();
}

TriangleMesh parse_text(std::string_view text, const std::string& file, double scale) {
  LineScanner scanner(text, file);
  MeshBuilder builder(file, scale);
  const MeshBuilder::Fail fail = [&](const std::string& message, const std::string& advice) {
    scanner.fail(message, 0, advice);
  };
  std::vector<std::uint32_t> loop;
  bool in_loop = false, in_solid = false;
  while (scanner.next_line()) {
    const std::optional<Word> first = scanner.next_word();
    if (!first) continue;
    const std::string key = lower(first->text);
    if (key == "vertex") {
      if (!in_loop)
        scanner.fail("a vertex outside of a loop", first->column, "it belongs between 'outer loop' and 'endloop'");
      double p[3];
      for (double& c : p) {
        const std::optional<Word> word = scanner.next_word();
        if (!word) scanner.fail("a vertex needs three coordinates");
        c = to_number(scanner, *word);
      }
      loop.push_back(static_cast<std::uint32_t>(builder.vertex_count()));
      builder.add_vertex(p[0], p[1], p[2], fail);
    } else if (key == "outer") {
      if (in_loop) scanner.fail("a loop within a loop", first->column);
      in_loop = true;
      loop.clear();
    } else if (key == "endloop") {
      if (!in_loop) scanner.fail("the end of a loop that did not begin", first->column);
      in_loop = false;
      builder.add_polygon(loop, fail);
    } else if (key == "solid" || key == "endsolid") {
      in_solid = key == "solid";
    } else if (key != "facet" && key != "endfacet") {
      scanner.fail("unknown line " + printable(first->text), first->column, "is it an STL file?");
    }
  }
  if (in_loop || in_solid) scanner.fail("the file ends within a solid", 0, "is it truncated?");
  return builder.finish();
}

}  // namespace

TriangleMesh parse_stl(std::string_view bytes, const std::string& file, double scale) {
  return is_binary(bytes, file) ? parse_binary(bytes, file, scale) : parse_text(bytes, file, scale);
}

}  // namespace treadmark::io::meshes
