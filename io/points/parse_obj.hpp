// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/points/sink.hpp"

namespace treadmark::io::points {

/// Joins lines that end with a backslash.
class LogicalLines {
 public:
  explicit LogicalLines(LineBlocks& lines) : lines_(lines) {}
  bool next(std::string_view& line) {
    if (!lines_.next(line)) return false;
    if (line.empty() || line.back() != '\\') return true;
    joined_.clear();
    do {
      joined_.append(line.substr(0, line.size() - 1)).append(1, ' ');
      if (joined_.size() > ByteBlocks::kLongestPiece)
        lines_.fail("a continued line of more than 64 million characters");
    } while (lines_.next(line) && !line.empty() && line.back() == '\\');
    line = joined_.append(line.ends_with('\\') ? std::string_view() : line);
    return true;
  }

 private:
  LineBlocks& lines_;
  std::string joined_;
};

/// A sink for OBJ gets normals and the corners of faces as they are written ("7", "7/1", "7//3", "7/1/3") too, while it
/// wants them.
template <class S>
concept ObjSink = Sink<S> && requires(S sink, const LineBlocks& lines, const Field& field, const Vec3& n) {
  sink.add_normal(n);
  { sink.wants_corners() } -> std::same_as<bool>;
  sink.add_obj_corner(lines, field);
};

template <ObjSink S>
auto parse_obj(ByteBlocks& bytes, const typename S::Options& options) {
  LineBlocks lines(bytes);
  LogicalLines logical(lines);
  constexpr std::size_t kVertexLine = 7;  // "v 0 0 0"
  S sink(bytes, options, kVertexLine, [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  std::string_view line;
  while (S::kFaces ? lines.next(line) : logical.next(line)) {
    if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
      sink.comment(line.substr(comment + 1));
      line = line.substr(0, comment);
    }
    FieldScanner fields(line, ' ');
    Field key;
    if (!fields.next(key)) continue;
    if (S::kFaces && line.ends_with('\\') && (key.text == "v" || key.text == "f"))
      lines.fail("continued lines are not read", 0, "write each vertex and face on a line of its own");
    if (key.text == "v") {  // weights and colours may follow
      sink.add(three_in<S>(lines, fields, key, "three numbers are expected behind 'v'"));
    } else if (key.text == "vn" && !S::kFaces) {
      sink.add_normal(three_in<S>(lines, fields, key, "three numbers are expected behind 'vn'"));
    } else if (key.text == "f" && sink.wants_corners()) {
      for (Field corner; sink.wants_corners() && fields.next(corner);) sink.add_obj_corner(lines, corner);
      sink.end_face();
    } else if (lines.line().find('\0') != std::string_view::npos) {
      lines.fail("unknown line");
    }
  }
  return sink.finish("OBJ");
}

}  // namespace treadmark::io::points
