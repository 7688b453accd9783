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
using profiles::printable;
using profiles::Word;

void refuse_too_many(const std::string& file, std::uint64_t vertices, std::uint64_t faces) {
  throw Error(ErrorKind::input_data,
              fmt::format("{} vertices and {} faces are promised, more than the file holds", vertices, faces),
              {file, 0, 0}, "is it truncated?");
}

/// The words of a text without comments and empty lines.
class Words {
 public:
  explicit Words(LineScanner& scanner) : scanner_(scanner) {}
  /// The first word of the next line that has one.
  Word next_line() {
    while (scanner_.next_line()) {
      if (const std::size_t comment = scanner_.line().find('#'); comment != std::string_view::npos)
        scanner_.cut(comment);
      if (const std::optional<Word> word = scanner_.next_word()) return *word;
    }
    scanner_.fail("the file ends before all elements are read", 0, "is it truncated?");
  }
  Word next() {
    const std::optional<Word> word = scanner_.next_word();
    if (!word) scanner_.fail("the line ends too early");
    return *word;
  }
  std::optional<Word> maybe() { return scanner_.next_word(); }

 private:
  LineScanner& scanner_;
};

/// Prefixes of the keyword add properties of vertices: ST, C, N. 4OFF and nOFF have other dimensions.
bool is_keyword(std::string_view word) {
  if (word.starts_with("ST")) word.remove_prefix(2);
  if (word.starts_with("C")) word.remove_prefix(1);
  if (word.starts_with("N")) word.remove_prefix(1);
  return word == "OFF";
}

/// Binary data are big endian: three 32-bit counts, vertices of floats, faces of 32-bit integers with a number of
/// colours.
TriangleMesh parse_binary(std::string_view bytes, const std::string& file, double scale, std::size_t offset) {
  ByteReader reader(bytes, file, true, offset);
  const std::uint64_t vertices = reader.read<std::uint32_t>(), faces = reader.read<std::uint32_t>();
  reader.skip(4);
  if (vertices > reader.left() / 12 || faces > reader.left() / 8) refuse_too_many(file, vertices, faces);
  MeshBuilder builder(file, scale);
  builder.reserve(vertices, faces);
  const MeshBuilder::Fail fail = [&](const std::string& message, const std::string& advice) {
    reader.fail(message, advice);
  };
  for (std::uint64_t i = 0; i < vertices; ++i) {
    const double x = static_cast<double>(reader.read<float>()), y = static_cast<double>(reader.read<float>()),
                 z = static_cast<double>(reader.read<float>());
    builder.add_vertex(x, y, z, fail);
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < faces; ++i) {
    const std::uint64_t count = reader.read<std::uint32_t>();
    if (count > reader.left() / 4)
      reader.fail(fmt::format("a face of {} corners, more than the file holds", count), "is it damaged?");
    corners.clear();
    for (std::uint64_t k = 0; k < count; ++k)
      corners.push_back(builder.corner(static_cast<double>(reader.read<std::uint32_t>()), vertices, fail));
    builder.add_polygon(corners, fail);
    reader.skip(4 * static_cast<std::uint64_t>(reader.read<std::uint32_t>()));
  }
  return builder.finish();
}

}  // namespace

TriangleMesh parse_off(std::string_view text, const std::string& file, double scale) {
  // "OFF BINARY" and an end of line
  const std::size_t first_end = text.find('\n');
  if (first_end != std::string_view::npos && first_end < 100) {
    std::string_view line = text.substr(0, first_end);
    while (!line.empty() && (line.back() == '\r' || profiles::is_blank(line.back()))) line.remove_suffix(1);
    if (line == "OFF BINARY") return parse_binary(text, file, scale, first_end + 1);
    if (line.ends_with(" BINARY"))
      throw Error(ErrorKind::input_data, "binary OFF files are read without further properties of vertices only",
                  {file, 1, 1}, "write it as text or as .ply");
  }
  LineScanner scanner(text, file);
  Words words(scanner);
  // the keyword may be missing, and the counts may stand behind it
  Word word = words.next_line();
  if (is_keyword(word.text)) {
    const std::optional<Word> next = words.maybe();
    word = next ? *next : words.next_line();
  } else if (!profiles::looks_numeric(word.text)) {
    scanner.fail("an OFF file begins with the word OFF, COFF or NOFF, this is " + printable(word.text), word.column,
                 "other dimensions than three are not read");
  }
  const auto count = [&](const Word& w) {
    const int value = to_integer(scanner, w);
    if (value < 0) scanner.fail("a number of elements is negative", w.column);
    return static_cast<std::uint64_t>(value);
  };
  const std::uint64_t vertices = count(word), faces = count(words.next());
  // a vertex takes at least six characters ("0 0 0" and an end of line), a face eight
  if (vertices > text.size() / 6 + 1 || faces > text.size() / 8 + 1) refuse_too_many(file, vertices, faces);

  MeshBuilder builder(file, scale);
  builder.reserve(vertices, faces);
  const MeshBuilder::Fail fail = [&](const std::string& message, const std::string& advice) {
    scanner.fail(message, 0, advice);
  };
  for (std::uint64_t i = 0; i < vertices; ++i) {
    const double x = to_number(scanner, words.next_line()), y = to_number(scanner, words.next()),
                 z = to_number(scanner, words.next());
    builder.add_vertex(x, y, z, fail);  // normals and colours may follow
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t i = 0; i < faces; ++i) {
    const Word first = words.next_line();
    const int n = to_integer(scanner, first);
    if (n < 0) scanner.fail("a face of a negative number of corners", first.column);
    corners.clear();
    for (int k = 0; k < n; ++k) corners.push_back(builder.corner(to_integer(scanner, words.next()), vertices, fail));
    builder.add_polygon(corners, fail);
  }
  return builder.finish();
}

}  // namespace treadmark::io::meshes
