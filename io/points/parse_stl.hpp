// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <fmt/format.h>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/points/sink.hpp"

namespace treadmark::io::points {

inline constexpr std::size_t kStlHeader = 80, kStlFacet = 50;

/// Many binary files begin with the word solid too, so their size decides; after that what the first lines hold.
inline bool is_binary_stl(ByteBlocks& bytes) {
  constexpr std::size_t kSample = 1000;
  bytes.want(kSample);
  const std::string_view start = bytes.window();
  if (start.size() >= kStlHeader + 4 &&
      bytes.size() ==
          kStlHeader + 4 + kStlFacet * static_cast<std::uint64_t>(load<std::uint32_t>(start.data() + kStlHeader)))
    return true;
  const std::size_t word = start.find_first_not_of(" \t\r\n");
  if (word == std::string_view::npos || profiles::lower(start.substr(word, 5)) != "solid") return true;
  return start.substr(0, kSample).find('\0') != std::string_view::npos;
}

template <Sink S>
auto parse_binary_stl(ByteBlocks& bytes, const typename S::Options& options) {
  S sink(bytes, options, kStlFacet / 3, [&](const std::string& m, const std::string& a) { bytes.fail(m, a); });
  const std::string_view title(bytes.need(kStlHeader), kStlHeader);
  sink.comment(title.substr(0, title.find('\0')));
  bytes.consume(kStlHeader);
  const std::uint64_t count = load<std::uint32_t>(bytes.need(4));
  if (S::kFaces && count > kMostElements / 3)
    bytes.fail(fmt::format("{} triangles are too many", count), "is it an STL file?");
  if (bytes.left() - 4 < count * kStlFacet)
    bytes.fail(fmt::format("{} triangles are promised, the file holds {}", count, (bytes.left() - 4) / kStlFacet),
               "is it truncated, or no STL file?");
  bytes.consume(4);
  if constexpr (S::kFaces) sink.expect(3 * count, count);  // points without faces are fewer: each once
  for (std::uint64_t t = 0; t < count; ++t) {
    const char* at = bytes.need(kStlFacet) + 12;  // the normal is that of the triangle, not of its corners
    for (int k = 0; k < 3; ++k, at += 12) sink.add_corner(load_floats(at));
    sink.end_face();
    bytes.consume(kStlFacet);
  }
  return sink.finish("STL, binary");
}

template <Sink S>
auto parse_text_stl(ByteBlocks& bytes, const typename S::Options& options) {
  LineBlocks lines(bytes);
  constexpr std::size_t kVertexLine = 12;  // "vertex 0 0 0"
  S sink(bytes, options, kVertexLine, [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  bool in_solid = false, in_loop = false;
  std::string_view line;
  while (lines.next(line)) {
    FieldScanner fields(line, ' ');
    Field first;
    if (!fields.next(first)) continue;
    const std::string key = profiles::lower(first.text);
    if (key == "vertex") {
      if (S::kFaces && !in_loop)
        lines.fail("a vertex outside of a loop", first.column, "it belongs between 'outer loop' and 'endloop'");
      sink.add_corner(three_in<S>(lines, fields, first, "a vertex needs three coordinates"));
    } else if (key == "outer") {
      if (S::kFaces && in_loop) lines.fail("a loop within a loop", first.column);
      in_loop = true;
    } else if (key == "endloop") {
      if (S::kFaces && !in_loop) lines.fail("the end of a loop that did not begin", first.column);
      in_loop = false;
      sink.end_face();
    } else if (key == "solid" || key == "endsolid") {
      in_solid = key == "solid";
      if (in_solid) sink.comment(line.substr(static_cast<std::size_t>(first.column) + 4));
    } else if (key != "facet" && key != "endfacet") {
      lines.fail("unknown line " + profiles::printable(first.text), first.column, "is it an STL file?");
    }
  }
  if (in_solid || (S::kFaces && in_loop)) lines.fail("the file ends within a solid", 0, "is it truncated?");
  return sink.finish("STL, ASCII");
}

/// Text and binary.
template <Sink S>
auto parse_stl(ByteBlocks& bytes, const typename S::Options& options) {
  return is_binary_stl(bytes) ? parse_binary_stl<S>(bytes, options) : parse_text_stl<S>(bytes, options);
}

}  // namespace treadmark::io::points
