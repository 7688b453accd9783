// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <fmt/format.h>

#include <optional>

#include "treadmark/io/points/binary_values.hpp"
#include "treadmark/io/points/sink.hpp"

namespace treadmark::io::points {

/// Whether a keyword says that vertices have normals; nothing where the word is none. Prefixes add properties of
/// vertices, ST, C, N in this order; 4OFF and nOFF have other dimensions.
inline std::optional<bool> off_normals(std::string_view word) {
  if (word.starts_with("ST")) word.remove_prefix(2);
  if (word.starts_with("C")) word.remove_prefix(1);
  if (word == "OFF" || word == "NOFF") return word == "NOFF";
  return std::nullopt;
}

/// Binary data are big endian: three 32-bit counts, vertices of floats, faces of 32-bit integers with a number of
/// colours.
template <Sink S>
auto parse_binary_off(ByteBlocks& bytes, const typename S::Options& options) {
  constexpr std::size_t kVertex = 12;
  const auto take = [&] {
    const auto value = load<std::uint32_t>(bytes.need(4), true);
    bytes.consume(4);
    return value;
  };
  bytes.need(12);
  const std::uint64_t vertices = take(), faces = take();
  take();  // edges
  S sink(bytes, options, kVertex, [&](const std::string& m, const std::string& a) { bytes.fail(m, a); });
  sink.expect(vertices, faces);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    sink.add(load_floats(bytes.need(kVertex), true));
    bytes.consume(kVertex);
  }
  if constexpr (S::kFaces)
    for (std::uint64_t i = 0; i < faces; ++i) {
      const std::uint64_t count = take();
      if (count > bytes.left() / 4)
        bytes.fail(fmt::format("a face of {} corners, more than the file holds", count), "is it damaged?");
      for (std::uint64_t k = 0; k < count; ++k) sink.add_index(take());
      sink.end_face();
      bytes.skip(4 * std::uint64_t{take()});
    }
  return sink.finish("OFF, binary");
}

/// Fields of a text without comments, which the sink gets, and empty lines.
template <Sink S>
class OffFields {
 public:
  OffFields(LineBlocks& lines, S& sink) : lines_(lines), sink_(sink), scanner_({}, ' ') {}
  Field next_line() {
    std::string_view line;
    while (lines_.next(line)) {
      if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
        sink_.comment(line.substr(comment + 1));
        line = line.substr(0, comment);
      }
      scanner_ = FieldScanner(line, ' ');
      Field field;
      if (scanner_.next(field)) return field;
    }
    lines_.fail(S::kFaces ? "the file ends before all elements are read" : "the file ends before all vertices are read",
                0, "is it truncated?");
  }
  bool maybe(Field& field) { return scanner_.next(field); }
  Field next() {
    Field field;
    if (!scanner_.next(field)) lines_.fail("the line ends too early", 0, "is the file truncated?");
    return field;
  }

 private:
  LineBlocks& lines_;
  S& sink_;
  FieldScanner scanner_;
};

template <Sink S>
auto parse_text_off(ByteBlocks& bytes, const typename S::Options& options) {
  LineBlocks lines(bytes);
  constexpr std::size_t kVertexLine = 6;  // "0 0 0"
  S sink(bytes, options, kVertexLine, [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  OffFields<S> fields(lines, sink);
  // the keyword may be missing, and the counts may stand behind it
  Field field = fields.next_line();
  const std::optional<bool> keyword = off_normals(field.text);
  const bool normals = keyword.value_or(false);
  double value = 0.0;
  if (keyword) {
    if (!fields.maybe(field)) field = fields.next_line();
  } else if (!parse_number(field.text, false, value)) {
    lines.fail("an OFF file begins with the word OFF, COFF or NOFF, this is " + profiles::printable(field.text),
               field.column, "other dimensions than three are not read");
  }
  const std::uint64_t vertices = S::count(lines, field);
  std::uint64_t faces = 0;
  if constexpr (S::kFaces) {
    faces = S::count(lines, fields.next());
  } else {
    for (int k = 0; k < 2; ++k)
      if (fields.maybe(field)) S::count(lines, field);
  }
  sink.set_content(normals, false);
  sink.expect(vertices, faces);
  VertexValues v{};
  const std::size_t values = normals && !S::kFaces ? 6 : 3;
  for (std::uint64_t i = 0; i < vertices; ++i) {
    for (std::size_t k = 0; k < values; ++k) v[k] = S::number(lines, k == 0 ? fields.next_line() : fields.next());
    while (!S::kFaces && fields.maybe(field)) S::number(lines, field);  // colours
    sink.add_values(v);
  }
  if constexpr (S::kFaces)
    for (std::uint64_t i = 0; i < faces; ++i) {
      const Field first = fields.next_line();
      const int count = profiles::to_integer(lines, first);
      if (count < 0) lines.fail("a face of a negative number of corners", first.column);
      for (int k = 0; k < count; ++k) sink.add_index(profiles::to_integer(lines, fields.next()));
      sink.end_face();
    }
  return sink.finish(normals ? "OFF, normals" : "OFF");
}

/// Text and binary.
template <Sink S>
auto parse_off(ByteBlocks& bytes, const typename S::Options& options) {
  constexpr std::size_t kFirstLine = 100;
  bytes.want(kFirstLine);
  const std::string_view start = bytes.window().substr(0, kFirstLine);
  if (const std::size_t end = start.find('\n'); end != std::string_view::npos) {
    std::string_view line = start.substr(0, end);
    while (!line.empty() && (line.back() == '\r' || profiles::is_blank(line.back()))) line.remove_suffix(1);
    if (line == "OFF BINARY") {
      bytes.consume(end + 1);
      return parse_binary_off<S>(bytes, options);
    }
    if (line.ends_with(" BINARY"))
      throw Error(ErrorKind::input_data, "binary OFF files are read without further properties of vertices only",
                  {bytes.file(), 1, 1}, "write it as text or as .ply");
  }
  return parse_text_off<S>(bytes, options);
}

}  // namespace treadmark::io::points
