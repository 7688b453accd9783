// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/points/ply_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/sink.hpp"

namespace treadmark::io::points {

namespace {

constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz"};
constexpr std::string_view kPassNames[] = {"pass", "pass_id", "scan_id", "scan",
                                           "point_source_id"};  // the first found counts
constexpr std::string_view kIntensityNames[] = {"intensity", "scalar_intensity", "reflectance"};
constexpr int kPass = static_cast<int>(kPassValue), kIntensity = static_cast<int>(kIntensityValue);

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
    if (!faces && !layout.intensity &&
        std::find(std::begin(kIntensityNames), std::end(kIntensityNames), name) != std::end(kIntensityNames)) {
      layout.value[k] = kIntensity;
      layout.intensity = true;
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

using profiles::LineScanner;
using profiles::printable;
using profiles::Word;

namespace {

Word want(LineScanner& scanner, const char* what) {
  const std::optional<Word> word = scanner.next_word();
  if (!word) scanner.fail(std::string("the line ends, here should be ") + what);
  return *word;
}

PlyType type_of(const LineScanner& scanner, const Word& word) {
  struct Name {
    std::string_view name;
    PlyType type;
  };
  static constexpr Name kNames[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const Name& n : kNames)
    if (n.name == word.text) return n.type;
  scanner.fail("unknown type " + printable(word.text), word.column,
               "known are char, uchar, short, ushort, int, uint, float, double");
}

std::uint64_t count_of(const LineScanner& scanner, const Word& word) {
  std::uint64_t value = 0;
  const auto [end, error] = from_chars(word.text.data(), word.text.data() + word.text.size(), value);
  if (error != std::errc{} || end != word.text.data() + word.text.size() || value > kMostElements)
    scanner.fail("a number of elements up to 1e9 is expected, this is " + printable(word.text), word.column);
  return value;
}

PlyHeader::Format format_of(LineScanner& scanner) {
  const Word format = want(scanner, "the format"), version = want(scanner, "the version");
  if (version.text != "1.0")
    scanner.fail("unknown version " + printable(version.text), version.column, "only 1.0 exists");
  if (format.text == "ascii") return PlyHeader::Format::ascii;
  if (format.text == "binary_little_endian") return PlyHeader::Format::little_endian;
  if (format.text == "binary_big_endian") return PlyHeader::Format::big_endian;
  scanner.fail("unknown format " + printable(format.text), format.column,
               "known are ascii, binary_little_endian and binary_big_endian");
}

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::string& file) {
  // the header ends with the line end_header; what follows may be binary
  constexpr std::size_t kLongest = 1'000'000;
  const std::string_view start = bytes.substr(0, kLongest);
  std::size_t end = std::string_view::npos;
  for (std::size_t at = start.find("end_header"); at != std::string_view::npos; at = start.find("end_header", at + 1)) {
    const std::size_t after = at + std::string_view("end_header").size();
    const bool alone = at > 0 && (start[at - 1] == '\n' || start[at - 1] == '\r');
    if (!alone || (after < start.size() && start[after] != '\n' && start[after] != '\r')) continue;
    end = after;
    break;
  }
  if (!start.starts_with("ply"))
    throw Error(ErrorKind::input_data, "a PLY file begins with the word ply", {file, 1, 1}, "is the extension right?");
  if (end == std::string_view::npos)
    throw Error(ErrorKind::input_data, "the header has no line end_header", {file, 0, 0}, "is the file truncated?");
  PlyHeader header;
  header.bytes = end;
  if (header.bytes < bytes.size() && bytes[header.bytes] == '\r') ++header.bytes;
  if (header.bytes < bytes.size() && bytes[header.bytes] == '\n') ++header.bytes;

  LineScanner scanner(bytes.substr(0, end), file);
  bool has_format = false;
  while (scanner.next_line()) {
    ++header.lines;
    const std::optional<Word> key = scanner.next_word();
    if (!key || key->text == "end_header") continue;
    if (key->text == "comment" || key->text == "obj_info") {
      header.comments.emplace_back(scanner.line().substr(scanner.offset()));
      continue;
    }
    if (key->text == "ply" && header.lines == 1) continue;
    if (key->text == "format") {
      header.format = format_of(scanner);
      has_format = true;
    } else if (key->text == "element") {
      PlyElement element;
      element.name = std::string(want(scanner, "the name of the element").text);
      element.count = count_of(scanner, want(scanner, "the number of elements"));
      header.elements.push_back(std::move(element));
    } else if (key->text == "property") {
      if (header.elements.empty()) scanner.fail("a property before the first element", key->column);
      PlyProperty property;
      Word type = want(scanner, "the type of the property");
      if (type.text == "list") {
        property.list = true;
        const Word count = want(scanner, "the type of the length of the list");
        property.count_type = type_of(scanner, count);
        if (!is_whole_type(property.count_type))
          scanner.fail("the length of a list must be of a whole type", count.column);
        type = want(scanner, "the type of the entries");
      }
      property.type = type_of(scanner, type);
      property.name = std::string(want(scanner, "the name of the property").text);
      header.elements.back().properties.push_back(std::move(property));
    } else {
      scanner.fail("unknown line " + printable(key->text) + " in the header", key->column);
    }
  }
  if (!has_format)
    throw Error(ErrorKind::input_data, "the header does not name its format", {file, 1, 0},
                "a line like 'format ascii 1.0'");
  return header;
}

}  // namespace treadmark::io::points
