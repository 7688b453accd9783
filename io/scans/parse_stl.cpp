// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/io/scans/binary_values.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/parse_scan.hpp"
#include "treadmark/io/scans/text_values.hpp"
#include "treadmark/io/scans/unit_words.hpp"
#include "treadmark/io/scans/vertex_set.hpp"

namespace treadmark::io::scans {

using profiles::lower;
using profiles::printable;

namespace {

constexpr std::size_t kHeader = 80, kFacet = 50;

/// Many binary files begin with the word solid too, so their size decides; after that what the first lines hold.
bool is_binary(ByteBlocks& bytes) {
  constexpr std::size_t kSample = 1000;
  bytes.want(kSample);
  const std::string_view start = bytes.window();
  if (start.size() >= kHeader + 4 &&
      bytes.size() == kHeader + 4 + kFacet * static_cast<std::uint64_t>(load<std::uint32_t>(start.data() + kHeader)))
    return true;
  const std::size_t word = start.find_first_not_of(" \t\r\n");
  if (word == std::string_view::npos || lower(start.substr(word, 5)) != "solid") return true;
  return start.substr(0, kSample).find('\0') != std::string_view::npos;
}

class Corners {
 public:
  Corners(CloudBuilder& builder) : builder_(builder) {}
  void add(const Vec3& p) {
    if (p.allFinite() && !known_.insert(p, builder_.scan().cloud.points)) return;
    builder_.add(p);
  }

 private:
  CloudBuilder& builder_;
  VertexSet known_;
};

Scan parse_binary_stl(ByteBlocks& bytes, const ScanReadOptions& options) {
  const std::string_view title(bytes.need(kHeader), kHeader);
  const std::optional<LengthUnit> unit = unit_in_words(title.substr(0, title.find('\0')));
  bytes.consume(kHeader);
  const std::uint64_t count = load<std::uint32_t>(bytes.need(4));
  if (bytes.left() - 4 < count * kFacet)
    bytes.fail(fmt::format("{} triangles are promised, the file holds {}", count, (bytes.left() - 4) / kFacet),
               "is it truncated, or no STL file?");
  bytes.consume(4);
  CloudBuilder builder(bytes, options, kFacet / 3,
                       [&](const std::string& m, const std::string& a) { bytes.fail(m, a); });
  Corners corners(builder);
  for (std::uint64_t t = 0; t < count; ++t) {
    const char* at = bytes.need(kFacet) + 3 * sizeof(float);  // the normal is that of the triangle, not of the points
    for (int k = 0; k < 3; ++k, at += 3 * sizeof(float))
      corners.add(Eigen::Vector3f(load<float>(at), load<float>(at + 4), load<float>(at + 8)).cast<double>());
    bytes.consume(kFacet);
  }
  return builder.finish("STL, binary", unit);
}

Scan parse_text_stl(ByteBlocks& bytes, const ScanReadOptions& options) {
  LineBlocks lines(bytes);
  constexpr std::size_t kVertexLine = 12;  // "vertex 0 0 0"
  CloudBuilder builder(bytes, options, kVertexLine,
                       [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  Corners corners(builder);
  UnitFinder unit;
  bool in_solid = false;
  std::string_view line;
  while (lines.next(line)) {
    FieldScanner fields(line, ' ');
    Field first;
    if (!fields.next(first)) continue;
    const std::string key = lower(first.text);
    if (key == "vertex") {
      Vec3 p;
      for (int k = 0; k < 3; ++k) {
        Field field;
        if (!fields.next(field)) lines.fail("a vertex needs three coordinates", first.column, "is the file truncated?");
        p[k] = number_in(lines, field);
      }
      corners.add(p);
    } else if (key == "solid" || key == "endsolid") {
      in_solid = key == "solid";
      if (in_solid) unit.look_at(line.substr(static_cast<std::size_t>(first.column) + 4));
    } else if (key != "facet" && key != "endfacet" && key != "outer" && key != "endloop") {
      lines.fail("unknown line " + printable(first.text), first.column, "is it an STL file?");
    }
  }
  if (in_solid) lines.fail("the file ends within a solid", 0, "is it truncated?");
  return builder.finish("STL, ASCII", unit.unit());
}

}  // namespace

Scan parse_stl(ByteBlocks& bytes, const ScanReadOptions& options) {
  ScanReadOptions limited = options;
  limited.most_points = std::min(options.most_points, VertexSet::kMost);
  return is_binary(bytes) ? parse_binary_stl(bytes, limited) : parse_text_stl(bytes, limited);
}

}  // namespace treadmark::io::scans
