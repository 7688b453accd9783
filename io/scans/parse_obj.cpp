// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <charconv>

#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/parse_scan.hpp"
#include "treadmark/io/scans/text_values.hpp"
#include "treadmark/io/scans/unit_words.hpp"

namespace treadmark::io::scans {

namespace {

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

/// Whether the corner "7//7" or "7/2/7" of a face takes the normal of the vertex's own number. Negative numbers count
/// back from the last vertex and normal so far.
bool own_normal(std::string_view corner, std::size_t vertices, std::size_t normals) {
  const std::size_t first = corner.find('/'), last = corner.rfind('/');
  if (first == std::string_view::npos || first == last) return true;  // no normal is named
  const auto number = [](std::string_view text, std::size_t count) {
    long long value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value < 0 ? static_cast<long long>(count) + 1 + value : value;
  };
  return number(corner.substr(0, first), vertices) == number(corner.substr(last + 1), normals);
}

Vec3 three(const LineBlocks& lines, FieldScanner& fields, const Field& key) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    Field field;
    if (!fields.next(field))
      lines.fail("three numbers are expected behind " + profiles::printable(key.text), key.column,
                 "is the file truncated?");
    p[k] = number_in(lines, field);
  }
  return p;
}

}  // namespace

Scan parse_obj(ByteBlocks& bytes, const ScanReadOptions& options) {
  LineBlocks lines(bytes);
  LogicalLines logical(lines);
  constexpr std::size_t kVertexLine = 7;  // "v 0 0 0"
  CloudBuilder builder(bytes, options, kVertexLine,
                       [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  UnitFinder unit;
  std::vector<Eigen::Vector3f> normals;
  std::vector<std::size_t> left_out;  // vertices that are not finite
  bool own_normals = true;
  std::string_view line;
  while (logical.next(line)) {
    if (const std::size_t comment = line.find('#'); comment != std::string_view::npos) {
      unit.look_at(line.substr(comment + 1));
      line = line.substr(0, comment);
    }
    FieldScanner fields(line, ' ');
    Field key;
    if (!fields.next(key)) continue;
    if (key.text == "v") {
      const Vec3 p = three(lines, fields, key);  // weights and colours may follow
      if (!p.allFinite()) left_out.push_back(builder.scan().points_in_file);
      builder.add(p);
    } else if (key.text == "vn") {
      normals.push_back(CloudBuilder::unit_or_zero(three(lines, fields, key).cast<float>()));
    } else if (key.text == "f" && own_normals) {
      for (Field corner; own_normals && fields.next(corner);)
        own_normals = own_normal(corner.text, builder.scan().points_in_file, normals.size());
    } else if (lines.line().find('\0') != std::string_view::npos) {
      lines.fail("unknown line");
    }
  }
  std::string format = "OBJ";
  if (!normals.empty() && normals.size() == builder.scan().points_in_file && own_normals) {
    format += ", normals";
    std::size_t kept = 0;
    auto skip = left_out.begin();
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (skip != left_out.end() && *skip == i)
        ++skip;
      else
        normals[kept++] = normals[i];
    }
    normals.resize(kept);
    builder.scan().cloud.normals = std::move(normals);
  } else if (!normals.empty()) {
    format += ", normals ignored (not one for each vertex)";
  }
  return builder.finish(std::move(format), unit.unit());
}

}  // namespace treadmark::io::scans
