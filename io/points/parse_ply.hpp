// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/points/ply_layout.hpp"
#include "treadmark/io/points/sink.hpp"

namespace treadmark::io::points {

inline double ply_value(const char* at, PlyType type, bool big) {
  switch (type) {
    case PlyType::int8:
      return load<std::int8_t>(at);
    case PlyType::uint8:
      return load<std::uint8_t>(at);
    case PlyType::int16:
      return load<std::int16_t>(at, big);
    case PlyType::uint16:
      return load<std::uint16_t>(at, big);
    case PlyType::int32:
      return load<std::int32_t>(at, big);
    case PlyType::uint32:
      return load<std::uint32_t>(at, big);
    case PlyType::float32:
      return static_cast<double>(load<float>(at, big));
    case PlyType::float64:
      break;
  }
  return load<double>(at, big);
}

inline double take_ply_value(ByteBlocks& bytes, PlyType type, bool big) {
  const double value = ply_value(bytes.need(size_of(type)), type, big);
  bytes.consume(size_of(type));
  return value;
}

/// The number of entries of a list, which the file can hold.
inline std::uint64_t take_ply_count(ByteBlocks& bytes, const PlyProperty& list, bool big) {
  const std::size_t size = size_of(list.count_type);
  const double count = ply_value(bytes.need(size), list.count_type, big);
  if (count < 0.0 || count > static_cast<double>((bytes.left() - size) / size_of(list.type)))
    bytes.fail(fmt::format("a list of {:g} entries, more than the file holds", count), "is the file damaged?");
  bytes.consume(size);
  return static_cast<std::uint64_t>(count);
}

/// Vertices of one length each.
template <Sink S>
void read_ply_records(ByteBlocks& bytes, const PlyElement& element, const PlyLayout& layout, bool big, S& sink) {
  struct Slot {
    std::size_t offset;
    PlyType type;
    std::size_t value;
  };
  std::vector<Slot> slots;
  std::size_t stride = 0;
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    if (layout.value[k] >= 0)
      slots.push_back({stride, element.properties[k].type, static_cast<std::size_t>(layout.value[k])});
    stride += size_of(element.properties[k].type);
  }
  VertexValues values{};
  for (std::uint64_t left = element.count; left > 0;) {
    bytes.need(stride);
    const std::uint64_t here = std::min<std::uint64_t>(left, bytes.window().size() / stride);
    for (std::uint64_t i = 0; i < here; ++i) {
      const char* const at = bytes.window().data();
      for (const Slot& slot : slots) values[slot.value] = ply_value(at + slot.offset, slot.type, big);
      sink.add_values(values);
      bytes.consume(stride);
    }
    left -= here;
  }
}

template <Sink S>
void read_binary_ply(ByteBlocks& bytes, const PlyHeader& header, const PlyLayout& layout, S& sink) {
  const bool big = header.format == PlyHeader::Format::big_endian;
  VertexValues values{};
  for (std::size_t e = 0; e < header.elements.size() && (S::kFaces || e <= layout.vertex); ++e) {
    const PlyElement& element = header.elements[e];
    const bool vertex = e == layout.vertex, face = e == layout.face;
    const auto is_list = [](const PlyProperty& p) { return p.list; };
    if (std::none_of(element.properties.begin(), element.properties.end(), is_list)) {
      std::uint64_t stride = 0;
      for (const PlyProperty& p : element.properties) stride += size_of(p.type);
      vertex ? read_ply_records(bytes, element, layout, big, sink) : bytes.skip(element.count * stride);
      continue;
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        if (!p.list) {
          const double value = take_ply_value(bytes, p.type, big);
          if (vertex && layout.value[k] >= 0) values[static_cast<std::size_t>(layout.value[k])] = value;
          continue;
        }
        const std::uint64_t count = take_ply_count(bytes, p, big);
        if (!face || k != layout.corners)
          bytes.skip(count * size_of(p.type));
        else if constexpr (S::kFaces)
          for (std::uint64_t c = 0; c < count; ++c) sink.add_index(take_ply_value(bytes, p.type, big));
      }
      if (vertex) sink.add_values(values);
      if (face) sink.end_face();
    }
  }
}

/// One element a line, empty lines do not count. column: of the number that was read last.
template <Sink S>
void read_text_ply(LineBlocks& lines, const PlyHeader& header, const PlyLayout& layout, S& sink, int& column) {
  Field field;
  VertexValues values{};
  for (std::size_t e = 0; e < header.elements.size() && (S::kFaces || e <= layout.vertex); ++e) {
    const PlyElement& element = header.elements[e];
    const bool vertex = e == layout.vertex, face = e == layout.face;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      std::string_view line;
      do {
        if (!lines.next(line)) lines.fail("the file ends before all elements are read", 0, "is it truncated?");
      } while (line.find_first_not_of(" \t\v\f") == std::string_view::npos);
      if (!vertex && !face) continue;
      FieldScanner fields(line, ' ');
      const auto next = [&](bool is_read) {
        if (!fields.next(field))
          lines.fail("the line ends before all properties are read", 0, "is the file truncated?");
        if (is_read) column = field.column;
      };
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const PlyProperty& p = element.properties[k];
        const bool is_value = vertex && layout.value[k] >= 0, is_corners = face && k == layout.corners;
        next(is_value || p.list);
        if (is_value) values[static_cast<std::size_t>(layout.value[k])] = S::number(lines, field);
        if (!p.list) continue;
        const std::uint64_t count = S::count(lines, field);
        if (count > line.size() / 2 + 1)  // an entry takes a character and a blank
          lines.fail(fmt::format("a list of {} entries, more than the file holds", count), column,
                     "is the file damaged?");
        for (std::uint64_t c = 0; c < count; ++c) {
          next(is_corners);
          if constexpr (S::kFaces)
            if (is_corners)
              sink.add_index(is_whole_type(p.type) ? profiles::to_integer(lines, field)
                                                   : profiles::to_number(lines, field));
        }
      }
      if (!S::kFaces && fields.next(field))
        lines.fail("the line has more values than a vertex has properties", field.column);
      if (vertex) sink.add_values(values);
      if (face) sink.end_face();
    }
  }
}

/// Text and binary of both endians.
template <Sink S>
auto parse_ply(ByteBlocks& bytes, const typename S::Options& options) {
  constexpr std::size_t kLongestHeader = 1'000'100;
  bytes.want(kLongestHeader);
  const PlyHeader header = parse_ply_header(bytes.window(), bytes.file());
  bytes.consume(header.bytes);
  const PlyLayout layout = find_ply_layout(header, bytes.left(), bytes.file(), S::kFaces);

  std::optional<LineBlocks> lines;
  if (header.format == PlyHeader::Format::ascii) lines.emplace(bytes, header.lines + 1);
  int column = 0;
  S sink(bytes, options, 3, [&](const std::string& message, const std::string& advice) {
    if (lines && lines->start() > 0) lines->fail(message, S::kFaces ? column : 0, advice);
    bytes.fail(message, advice);
  });
  for (const std::string& comment : header.comments) sink.comment(comment);
  sink.set_content(layout.normals, layout.pass);
  if constexpr (requires { sink.set_intensities(true); }) sink.set_intensities(layout.intensity);
  sink.expect(header.elements[layout.vertex].count, S::kFaces ? header.elements[layout.face].count : 0);
  if (lines)
    read_text_ply(*lines, header, layout, sink, column);
  else
    read_binary_ply(bytes, header, layout, sink);
  return sink.finish(in_words(header, layout));
}

}  // namespace treadmark::io::points
