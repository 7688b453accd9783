// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/scans/map_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/points/line_blocks.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

std::optional<std::size_t> uneven_position(const std::vector<double>& positions) {
  constexpr double kTolerance = 0.05;  // of a step
  const std::size_t n = positions.size();
  if (n < 2) return 0;
  const double step = (positions.back() - positions.front()) / static_cast<double>(n - 1);
  bool even = step > 0.0 && std::isfinite(step);
  for (std::size_t i = 0; even && i < n; ++i)
    even = std::abs(positions[i] - (positions.front() + static_cast<double>(i) * step)) <= kTolerance * step;
  if (even) return std::nullopt;

  // the usual step shows which one is out of line
  std::vector<double> steps(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) steps[i] = positions[i + 1] - positions[i];
  std::vector<double> sorted = steps;
  for (double& s : sorted)
    if (std::isnan(s)) s = 0.0;
  const std::size_t middle = (sorted.size() - 1) / 2;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(middle), sorted.end());
  const double usual = sorted[middle];
  std::size_t worst = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] > 0.0 && std::abs(steps[i] - usual) <= kTolerance * usual)) return i + 1;
    if (std::abs(steps[i] - usual) > std::abs(steps[worst] - usual)) worst = i;
  }
  return worst + 1;
}

MapScales map_scales(const MapReadOptions& options, std::optional<LengthUnit> unit,
                     std::optional<LengthUnit> height_unit) {
  const LengthUnit position = options.unit.value_or(unit.value_or(LengthUnit::millimetre));
  const LengthUnit height = options.height_unit.value_or(height_unit.value_or(position));
  MapScales scales;
  scales.y = scales.u = metres_per(position);
  scales.height = metres_per(height);
  if (options.body == Body::wheel)
    scales.u = options.angles_deg ? std::numbers::pi / 180.0 : metres_per(position) / options.nominal_radius;
  return scales;
}

void MapUnitWords::look_at(std::string_view comment) {
  // "positions in mm, deviations in um" are two statements
  for (std::size_t start = 0; start <= comment.size();) {
    const std::size_t end = std::min(comment.find_first_of(",;", start), comment.size());
    const std::string part = profiles::lower(comment.substr(start, end - start));
    const bool height = part.find("height") != std::string::npos || part.find("deviation") != std::string::npos ||
                        part.find("offset") != std::string::npos || part.find("value") != std::string::npos;
    (height ? height_ : unit_).look_at(part);
    start = end + 1;
  }
}

float deviation_in_metres(const LineBlocks& lines, double value, double scale, int column) {
  constexpr double kMost = 0.05;
  const double metres = value * scale;
  if (std::abs(metres) > kMost)
    lines.fail(fmt::format("a deviation of {:g} mm, more than 50 mm", 1e3 * metres), column,
               "is its unit right? it may differ from that of the positions");
  return static_cast<float>(metres);
}

void check_turn(const Grid2& grid, const MapReadOptions& options, const std::string& file) {
  if (options.body != Body::wheel) return;
  const double turns = grid.dx * (grid.nx - 1) / (2.0 * std::numbers::pi);
  if (turns > 1.0 + 1e-3)
    throw Error(ErrorKind::input_data, fmt::format("the map goes {:g} times round the wheel", turns), {file, 0, 0},
                options.angles_deg ? "are the rows' positions degrees?"
                                   : "are unit and nominal radius right, or are the positions degrees?");
}

void no_data(const std::string& file) {
  throw Error(ErrorKind::input_data, "the map has no data at all", {file, 0, 0}, "is every cell empty, nan or NODATA?");
}

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
