// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/io/points/line_blocks.hpp"
#include "treadmark/io/points/number.hpp"
#include "treadmark/io/scans/map_axis.hpp"
#include "treadmark/io/scans/map_head.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

bool finite_number(const Field& field, const FieldStyle& style, double& value) {
  return parse_number(field.text, style.decimal_comma, value) && std::isfinite(value);
}

bool is_esri(const std::string& line) {
  const std::vector<Field> fields = fields_of(line, ' ');
  double value = 0.0;
  if (fields.size() != 2 || !parse_number(fields[1].text, true, value)) return false;
  const std::string key = profiles::lower(fields[0].text);
  return key == "ncols" || key == "nrows";
}

bool is_matrix(const MapHead& head) {
  constexpr std::size_t kLeastLines = 3, kLeastPositions = 2;
  if (head.lines.size() < kLeastLines) return false;
  std::vector<Field> first = fields_of(head.lines.front(), head.style.separator);
  if (first.empty()) return false;
  double value = 0.0;
  const bool words_in_corner =
      !head.corner_missing && !parse_number(first.front().text, head.style.decimal_comma, value);
  if (!head.corner_missing) first.erase(first.begin());
  std::vector<double> positions, rows;
  for (const Field& field : first) {
    if (!finite_number(field, head.style, value)) return false;
    positions.push_back(value);
  }
  if (positions.size() < kLeastPositions) return false;
  for (std::size_t i = 1; i < head.lines.size(); ++i) {
    const std::vector<Field> fields = fields_of(head.lines[i], head.style.separator);
    if (fields.empty() || !finite_number(fields.front(), head.style, value)) return false;
    rows.push_back(value);
    if (!words_in_corner && fields.size() > positions.size() + 1) return false;
  }
  if (words_in_corner) {
    // A list of points has names for all columns or for none, so these are positions; uneven ones are for the reader to
    // refuse.
    return positions[1] > positions[0] && rows[1] > rows[0];
  }
  // a line of a list may increase evenly by chance, but hardly with that many numbers, and the first column too
  constexpr std::size_t kManyPositions = 4;
  return positions.size() >= kManyPositions && !uneven_position(positions) && !uneven_position(rows);
}

}  // namespace

MapHead find_map_head(ByteBlocks& bytes) {
  constexpr std::size_t kHead = 1'000'000, kSampleLines = 200;
  // long rows: as many bytes as two of them need
  bytes.want(kHead);
  std::size_t size = bytes.window().size();
  if (size > kHead && bytes.window().substr(0, kHead).find('\n') != std::string_view::npos) size = kHead;
  const std::string_view text = bytes.window().substr(0, size);
  ByteBlocks start(text, bytes.file());
  LineBlocks lines(start);
  MapHead head;
  std::string_view line;
  while (head.lines.size() < kSampleLines && lines.next(line)) {
    if (start.left() == 0 && text.size() < bytes.left() && head.lines.size() > 1) break;  // may be cut
    const LineKind kind = kind_of_line(line);
    if (kind != LineKind::empty && kind != LineKind::comment) head.lines.emplace_back(line);
  }
  if (head.lines.size() < 2) return head;
  const std::vector<std::string> rows(head.lines.begin() + 1, head.lines.end());
  head.style = find_style(rows);
  if (const FieldStyle all = find_style(head.lines); all.separator == head.style.separator) head.style = all;
  bool tabs = head.style.separator == ' ';
  for (const std::string& row : rows) tabs = tabs && row.find('\t') != std::string::npos;
  if (tabs) head.style.separator = '\t';  // empty cells between two of them
  head.corner_missing =
      head.style.separator == ' ' && fields_of(head.lines[0], ' ').size() + 1 == fields_of(head.lines[1], ' ').size();
  return head;
}

MapKind sniff_map(ByteBlocks& bytes) {
  const MapHead head = find_map_head(bytes);
  if (head.lines.empty()) return MapKind::none;
  if (is_esri(head.lines.front())) return MapKind::esri_grid;
  return is_matrix(head) ? MapKind::matrix : MapKind::none;
}

}  // namespace treadmark::io::scans
