// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <optional>

#include "treadmark/io/meshes/byte_reader.hpp"
#include "treadmark/io/meshes/mesh_builder.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"
#include "treadmark/io/meshes/ply_header.hpp"
#include "treadmark/io/profiles/line_scanner.hpp"

namespace treadmark::io::meshes {

namespace {

using profiles::LineScanner;
using profiles::Word;

/// Numbers of an ASCII file, one element a line.
class TextSource {
 public:
  TextSource(std::string_view bytes, const PlyHeader& header, const std::string& file) : scanner_(bytes, file) {
    for (int i = 0; i < header.lines; ++i) scanner_.next_line();
  }
  void next_element() {
    do {
      if (!scanner_.next_line()) scanner_.fail("the file ends before all elements are read", 0, "is it truncated?");
      word_ = scanner_.next_word();
    } while (!word_);
  }
  double read(PlyType type) {
    if (!word_) scanner_.fail("the line ends before all properties are read");
    last_ = word_->column;
    const double value = type == PlyType::float32 || type == PlyType::float64
                             ? to_number(scanner_, *word_)
                             : static_cast<double>(to_integer(scanner_, *word_));
    word_ = scanner_.next_word();
    return value;
  }
  void skip_value(PlyType) {
    if (!word_) scanner_.fail("the line ends before all properties are read");
    word_ = scanner_.next_word();
  }
  std::uint64_t left() const { return scanner_.line().size(); }
  static std::uint64_t least_bytes(PlyType) { return 2; }
  [[noreturn]] void fail(const std::string& message, const std::string& advice) const {
    scanner_.fail(message, last_, advice);
  }

 private:
  LineScanner scanner_;
  std::optional<Word> word_;
  int last_ = 0;
};

class BinarySource {
 public:
  BinarySource(std::string_view bytes, const PlyHeader& header, const std::string& file)
      : reader_(bytes, file, header.format == PlyHeader::Format::big_endian, header.bytes) {}
  void next_element() {}
  double read(PlyType type) {
    switch (type) {
      case PlyType::int8:
        return reader_.read<std::int8_t>();
      case PlyType::uint8:
        return reader_.read<std::uint8_t>();
      case PlyType::int16:
        return reader_.read<std::int16_t>();
      case PlyType::uint16:
        return reader_.read<std::uint16_t>();
      case PlyType::int32:
        return reader_.read<std::int32_t>();
      case PlyType::uint32:
        return reader_.read<std::uint32_t>();
      case PlyType::float32:
        return static_cast<double>(reader_.read<float>());
      case PlyType::float64:
        break;
    }
    return reader_.read<double>();
  }
  void skip_value(PlyType type) { reader_.skip(size_of(type)); }
  std::uint64_t left() const { return reader_.left(); }
  static std::uint64_t least_bytes(PlyType type) { return size_of(type); }
  [[noreturn]] void fail(const std::string& message, const std::string& advice) const { reader_.fail(message, advice); }

 private:
  ByteReader reader_;
};

template <class Source>
std::uint64_t read_count(Source& source, const PlyProperty& property) {
  const double count = source.read(property.count_type);
  // an entry takes at least this many bytes of what is left
  if (count < 0.0 || count > static_cast<double>(source.left() / Source::least_bytes(property.type) + 1))
    source.fail(fmt::format("a list of {:g} entries, more than the file holds", count), "is the file damaged?");
  return static_cast<std::uint64_t>(count);
}

template <class Source>
void skip_property(Source& source, const PlyProperty& property) {
  std::uint64_t count = property.list ? read_count(source, property) : 1;
  for (; count > 0; --count) source.skip_value(property.type);
}

template <class Source>
TriangleMesh read_elements(Source& source, const PlyHeader& header, std::uint64_t bytes, const std::string& file,
                           double scale) {
  const auto refuse = [&](const std::string& message, const std::string& advice) {
    throw Error(ErrorKind::input_data, message, {file, 0, 0}, advice);
  };
  const MeshBuilder::Fail fail = [&](const std::string& message, const std::string& advice) {
    source.fail(message, advice);
  };
  MeshBuilder builder(file, scale);
  std::uint64_t vertices = 0;
  for (const PlyElement& element : header.elements)
    if (element.name == "vertex") vertices = std::max(vertices, element.count);
  std::vector<std::uint32_t> corners;
  for (const PlyElement& element : header.elements) {
    std::uint64_t least = 0;
    for (const PlyProperty& p : element.properties) least += Source::least_bytes(p.list ? p.count_type : p.type);
    if (element.properties.empty()) {
      if (element.count > 0)
        refuse(fmt::format("the element {} has no properties", profiles::printable(element.name)), "");
      continue;
    }
    if (element.count > (bytes - header.bytes + 1) / least)
      refuse(fmt::format("the header promises {} times {}, more than the file holds", element.count,
                         profiles::printable(element.name)),
             "is it truncated?");
    const bool is_vertex = element.name == "vertex", is_face = element.name == "face";
    std::array<int, 3> xyz{-1, -1, -1};
    int list = -1;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& p = element.properties[k];
      if (!p.list && p.name.size() == 1 && p.name[0] >= 'x' && p.name[0] <= 'z')
        xyz[static_cast<std::size_t>(p.name[0] - 'x')] = static_cast<int>(k);
      if (p.list && (p.name == "vertex_indices" || p.name == "vertex_index")) list = static_cast<int>(k);
    }
    if (is_vertex && *std::min_element(xyz.begin(), xyz.end()) < 0) refuse("the vertices lack one of x, y, z", "");
    if (is_face && list < 0)
      refuse("the faces lack the list vertex_indices", "triangle strips are not read: export triangles");
    if (is_vertex) builder.reserve(element.count, 0);
    if (is_face) builder.reserve(0, element.count);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      source.next_element();
      std::array<double, 3> p{};
      corners.clear();
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        const PlyProperty& property = element.properties[static_cast<std::size_t>(k)];
        const auto axis = std::find(xyz.begin(), xyz.end(), k);
        if (is_vertex && axis != xyz.end()) {
          p[static_cast<std::size_t>(axis - xyz.begin())] = source.read(property.type);
        } else if (is_face && k == list) {
          for (std::uint64_t count = read_count(source, property); count > 0; --count)
            corners.push_back(builder.corner(source.read(property.type), vertices, fail));
        } else {
          skip_property(source, property);
        }
      }
      if (is_vertex) builder.add_vertex(p[0], p[1], p[2], fail);
      if (is_face) builder.add_polygon(corners, fail);
    }
  }
  return builder.finish();
}

}  // namespace

TriangleMesh parse_ply(std::string_view bytes, const std::string& file, double scale) {
  const PlyHeader header = parse_ply_header(bytes, file);
  for (const char* name : {"vertex", "face"}) {
    const auto is_it = [&](const PlyElement& e) { return e.name == name; };
    const auto count = std::count_if(header.elements.begin(), header.elements.end(), is_it);
    if (count != 1)
      throw Error(ErrorKind::input_data, fmt::format("the header names the element {} {} times", name, count),
                  {file, 0, 0},
                  count == 0 ? "is it a point cloud? make triangles of it first" : "it must be there once");
  }
  if (header.format == PlyHeader::Format::ascii) {
    TextSource source(bytes, header, file);
    return read_elements(source, header, bytes.size(), file, scale);
  }
  BinarySource source(bytes, header, file);
  return read_elements(source, header, bytes.size(), file, scale);
}

}  // namespace treadmark::io::meshes
