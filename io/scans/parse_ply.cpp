// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <array>

#include "treadmark/io/meshes/ply_header.hpp"
#include "treadmark/io/scans/binary_values.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/parse_scan.hpp"
#include "treadmark/io/scans/ply_vertex.hpp"
#include "treadmark/io/scans/text_values.hpp"

namespace treadmark::io::scans {

using meshes::PlyElement;
using meshes::PlyHeader;
using meshes::PlyProperty;
using meshes::PlyType;

namespace {

using Values = std::array<double, PlyVertex::kValues>;

void add_values(CloudBuilder& builder, const PlyVertex& vertex, const Values& v) {
  const std::uint16_t pass = vertex.pass ? builder.pass(v[PlyVertex::kPass]) : std::uint16_t{0};
  builder.add({v[0], v[1], v[2]}, {static_cast<float>(v[3]), static_cast<float>(v[4]), static_cast<float>(v[5])}, pass);
}

double value_at(const char* at, PlyType type, bool big) {
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

double take_value(ByteBlocks& bytes, PlyType type, bool big) {
  const double value = value_at(bytes.need(size_of(type)), type, big);
  bytes.consume(size_of(type));
  return value;
}

void skip_list(ByteBlocks& bytes, const PlyProperty& list, bool big) {
  bytes.need(size_of(list.count_type));
  const double count = value_at(bytes.window().data(), list.count_type, big);
  const std::uint64_t after = bytes.left() - size_of(list.count_type);
  if (count < 0.0 || count > static_cast<double>(after / size_of(list.type)))
    bytes.fail(fmt::format("a list of {:g} entries, more than the file holds", count), "is the file damaged?");
  bytes.skip(size_of(list.count_type) + static_cast<std::uint64_t>(count) * size_of(list.type));
}

std::size_t stride_of(const PlyElement& element) {
  std::size_t stride = 0;
  for (const PlyProperty& p : element.properties) stride += size_of(p.type);
  return stride;
}

void skip_element(ByteBlocks& bytes, const PlyElement& element, bool big) {
  bool lists = false;
  for (const PlyProperty& p : element.properties) lists = lists || p.list;
  if (!lists) return bytes.skip(element.count * stride_of(element));
  for (std::uint64_t i = 0; i < element.count; ++i)
    for (const PlyProperty& p : element.properties) {
      if (p.list)
        skip_list(bytes, p, big);
      else
        bytes.skip(size_of(p.type));
    }
}

/// Vertices of one length each.
void read_records(ByteBlocks& bytes, const PlyElement& element, const PlyVertex& vertex, bool big,
                  CloudBuilder& builder) {
  struct Slot {
    std::size_t offset;
    PlyType type;
    std::size_t value;
  };
  std::vector<Slot> slots;
  std::size_t stride = 0;
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    if (vertex.value[k] >= 0)
      slots.push_back({stride, element.properties[k].type, static_cast<std::size_t>(vertex.value[k])});
    stride += size_of(element.properties[k].type);
  }
  Values values{};
  for (std::uint64_t left = element.count; left > 0;) {
    bytes.need(stride);
    const std::uint64_t here = std::min<std::uint64_t>(left, bytes.window().size() / stride);
    for (std::uint64_t i = 0; i < here; ++i) {
      const char* const at = bytes.window().data();
      for (const Slot& slot : slots) values[slot.value] = value_at(at + slot.offset, slot.type, big);
      add_values(builder, vertex, values);
      bytes.consume(stride);
    }
    left -= here;
  }
}

void read_with_lists(ByteBlocks& bytes, const PlyElement& element, const PlyVertex& vertex, bool big,
                     CloudBuilder& builder) {
  Values values{};
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& p = element.properties[k];
      if (p.list) {
        skip_list(bytes, p, big);
        continue;
      }
      const double value = take_value(bytes, p.type, big);
      if (vertex.value[k] >= 0) values[static_cast<std::size_t>(vertex.value[k])] = value;
    }
    add_values(builder, vertex, values);
  }
}

/// One element a line, empty lines do not count.
void read_text(LineBlocks& lines, const PlyHeader& header, const PlyVertex& vertex, CloudBuilder& builder) {
  std::string_view line;
  const auto next_element = [&] {
    do {
      if (!lines.next(line)) lines.fail("the file ends before all elements are read", 0, "is it truncated?");
    } while (line.find_first_not_of(" \t\v\f") == std::string_view::npos);
  };
  for (std::size_t e = 0; e < vertex.element; ++e)
    for (std::uint64_t i = 0; i < header.elements[e].count; ++i) next_element();
  const PlyElement& element = header.elements[vertex.element];
  Values values{};
  for (std::uint64_t i = 0; i < element.count; ++i) {
    next_element();
    FieldScanner fields(line, ' ');
    Field field;
    const auto next = [&] {
      if (!fields.next(field)) lines.fail("the line ends before all properties are read", 0, "is the file truncated?");
    };
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      next();
      if (vertex.value[k] >= 0)
        values[static_cast<std::size_t>(vertex.value[k])] = number_in(lines, field);
      else if (element.properties[k].list)
        for (std::uint64_t left = count_in(lines, field); left > 0; --left) next();
    }
    if (fields.next(field)) lines.fail("the line has more values than a vertex has properties", field.column);
    add_values(builder, vertex, values);
  }
}

std::string format_of(const PlyHeader& header, const PlyVertex& vertex) {
  std::string words = "PLY, ";
  words += header.format == PlyHeader::Format::ascii        ? "ASCII"
           : header.format == PlyHeader::Format::big_endian ? "binary big endian"
                                                            : "binary little endian";
  if (vertex.normals) words += ", normals";
  if (vertex.pass) words += ", pass from the property " + vertex.pass_name;
  return words;
}

}  // namespace

Scan parse_ply(ByteBlocks& bytes, const ScanReadOptions& options) {
  constexpr std::size_t kLongestHeader = 1'000'100;
  bytes.want(kLongestHeader);
  const PlyHeader header = meshes::parse_ply_header(bytes.window(), bytes.file());
  const std::optional<LengthUnit> unit = unit_of_ply_header(bytes.window().substr(0, header.bytes));
  bytes.consume(header.bytes);
  const PlyVertex vertex = find_ply_vertex(header, bytes.left(), bytes.file());
  const PlyElement& element = header.elements[vertex.element];
  const bool ascii = header.format == PlyHeader::Format::ascii, big = header.format == PlyHeader::Format::big_endian;

  std::optional<LineBlocks> lines;
  if (ascii) lines.emplace(bytes, header.lines + 1);
  CloudBuilder builder(bytes, options, 3, [&](const std::string& message, const std::string& advice) {
    if (lines && lines->start() > 0) lines->fail(message, 0, advice);
    bytes.fail(message, advice);
  });
  builder.set_content(vertex.normals, vertex.pass);
  if (ascii) {
    builder.expect(element.count);
    read_text(*lines, header, vertex, builder);
  } else {
    for (std::size_t e = 0; e < vertex.element; ++e) skip_element(bytes, header.elements[e], big);
    builder.expect(element.count);
    if (vertex.has_lists)
      read_with_lists(bytes, element, vertex, big, builder);
    else
      read_records(bytes, element, vertex, big, builder);
  }
  return builder.finish(format_of(header, vertex), unit);
}

}  // namespace treadmark::io::scans
