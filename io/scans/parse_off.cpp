// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <optional>

#include <fmt/format.h>

#include "treadmark/io/scans/binary_values.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/parse_scan.hpp"
#include "treadmark/io/scans/text_values.hpp"
#include "treadmark/io/scans/unit_words.hpp"

namespace treadmark::io::scans {

namespace {

/// Prefixes of the keyword add properties of vertices, ST, C, N in this order; 4OFF and nOFF have other dimensions.
struct Keyword {
  bool known = false, normals = false;
};

Keyword keyword_of(std::string_view word) {
  Keyword keyword;
  if (word.starts_with("ST")) word.remove_prefix(2);
  if (word.starts_with("C")) word.remove_prefix(1);
  if (word.starts_with("N")) {
    keyword.normals = true;
    word.remove_prefix(1);
  }
  keyword.known = word == "OFF";
  return keyword;
}

/// Binary data are big endian: three 32-bit counts, vertices of floats, faces.
Scan parse_binary(ByteBlocks& bytes, const ScanReadOptions& options) {
  const std::uint32_t count = load<std::uint32_t>(bytes.need(12), true);
  CloudBuilder builder(bytes, options, 12, [&](const std::string& m, const std::string& a) { bytes.fail(m, a); });
  bytes.consume(12);
  builder.expect(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const char* const at = bytes.need(12);
    builder.add(
        Eigen::Vector3f(load<float>(at, true), load<float>(at + 4, true), load<float>(at + 8, true)).cast<double>());
    bytes.consume(12);
  }
  return builder.finish("OFF, binary", std::nullopt);
}

/// Fields of a text without comments and empty lines.
class Fields {
 public:
  Fields(LineBlocks& lines, UnitFinder& unit) : lines_(lines), unit_(unit), scanner_({}, ' ') {}
  Field next_line() {
    std::string_view line;
    while (lines_.next(line)) {
      if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
        unit_.look_at(line.substr(comment + 1));
        line = line.substr(0, comment);
      }
      scanner_ = FieldScanner(line, ' ');
      Field field;
      if (scanner_.next(field)) return field;
    }
    lines_.fail("the file ends before all vertices are read", 0, "is it truncated?");
  }
  bool maybe(Field& field) { return scanner_.next(field); }
  Field next() {
    Field field;
    if (!scanner_.next(field)) lines_.fail("the line ends too early", 0, "is the file truncated?");
    return field;
  }

 private:
  LineBlocks& lines_;
  UnitFinder& unit_;
  FieldScanner scanner_;
};

Scan parse_text(ByteBlocks& bytes, const ScanReadOptions& options) {
  LineBlocks lines(bytes);
  UnitFinder unit;
  Fields fields(lines, unit);
  constexpr std::size_t kVertexLine = 6;  // "0 0 0"
  CloudBuilder builder(bytes, options, kVertexLine,
                       [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  // the keyword may be missing, and the counts may stand behind it
  Field field = fields.next_line();
  const Keyword keyword = keyword_of(field.text);
  double value = 0.0;
  if (keyword.known) {
    if (!fields.maybe(field)) field = fields.next_line();
  } else if (!parse_number(field.text, false, value)) {
    lines.fail("an OFF file begins with the word OFF, COFF or NOFF, this is " + profiles::printable(field.text),
               field.column, "other dimensions than three are not read");
  }
  const std::uint64_t count = count_in(lines, field);
  for (int k = 0; k < 2; ++k)
    if (fields.maybe(field)) count_in(lines, field);  // faces and edges
  builder.set_content(keyword.normals, false);
  builder.expect(count);
  for (std::uint64_t i = 0; i < count; ++i) {
    Vec3 p, n = Vec3::Zero();
    for (int k = 0; k < 3; ++k) p[k] = number_in(lines, k == 0 ? fields.next_line() : fields.next());
    for (int k = 0; keyword.normals && k < 3; ++k) n[k] = number_in(lines, fields.next());
    while (fields.maybe(field)) number_in(lines, field);  // colours
    builder.add(p, n.cast<float>());
  }
  return builder.finish(keyword.normals ? "OFF, normals" : "OFF", unit.unit());
}

}  // namespace

Scan parse_off(ByteBlocks& bytes, const ScanReadOptions& options) {
  constexpr std::size_t kFirstLine = 100;
  bytes.want(kFirstLine);
  const std::string_view start = bytes.window().substr(0, kFirstLine);
  if (const std::size_t end = start.find('\n'); end != std::string_view::npos) {
    std::string_view line = start.substr(0, end);
    while (!line.empty() && (line.back() == '\r' || profiles::is_blank(line.back()))) line.remove_suffix(1);
    if (line == "OFF BINARY") {
      bytes.consume(end + 1);
      return parse_binary(bytes, options);
    }
    if (line.ends_with(" BINARY"))
      throw Error(ErrorKind::input_data, "binary OFF files are read without further properties of vertices only",
                  {bytes.file(), 1, 1}, "write it as text or as .ply");
  }
  return parse_text(bytes, options);
}

}  // namespace treadmark::io::scans
