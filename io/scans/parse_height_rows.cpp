// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/map_axis.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

constexpr std::size_t kFewestHeights = 16, kFewestRows = 4;  // a list of points has fewer columns

/// Whether the first of these columns grows or falls from row to row, as an encoder does.
bool is_encoder(const std::vector<std::string>& lines, const FieldStyle& style) {
  std::vector<double> places;
  for (const std::string& line : lines) {
    double value = 0.0;
    const std::vector<Field> fields = fields_of(line, style.separator);
    if (fields.empty() || !parse_number(fields.front().text, style.decimal_comma, value)) return false;
    places.push_back(value);
  }
  const auto runs = [&](auto before) {
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      if (!before(places[k], places[k + 1])) return false;
    return true;
  };
  return runs([](double a, double b) { return a < b; }) || runs([](double a, double b) { return a > b; });
}

}  // namespace

std::optional<HeightRows> sniff_height_rows(ByteBlocks& bytes) {
  const MapHead head = find_map_head(bytes);
  if (head.lines.size() < kFewestRows || sniff_map(bytes) != MapKind::none) return std::nullopt;
  const std::vector<std::string>& lines = head.lines;
  HeightRows out;
  out.style = find_style(lines);
  const std::size_t columns = fields_of(lines.front(), out.style.separator).size();
  if (columns < kFewestHeights) return std::nullopt;
  for (const std::string& line : lines) {
    const std::vector<Field> fields = fields_of(line, out.style.separator);
    if (fields.size() != columns) return std::nullopt;
    for (const Field& field : fields)
      if (double value = 0.0; !parse_number(field.text, out.style.decimal_comma, value) && !is_nothing(field.text))
        return std::nullopt;
  }
  out.encoder = is_encoder(lines, out.style);
  out.heights = columns - (out.encoder ? 1 : 0);
  return out;
}

Scan parse_height_rows(ByteBlocks& bytes, const HeightRows& rows, const HeightRowOptions& how,
                       const ScanReadOptions& options) {
  LineBlocks lines(bytes);
  const std::string what = fmt::format("rows of {} heights{}, as line scanners write them", rows.heights,
                                       rows.encoder ? " behind the place of the row" : "");
  if (!(how.across > 0.0))
    throw Error(ErrorKind::configuration, "these are " + what + ": how far the heights are apart across is not said",
                {bytes.file(), 0, 0},
                fmt::format("say map.across_mm{}", rows.encoder ? ", and map.along_mm if the first column is no length"
                                                                : " and map.along_mm, the distance of the rows"));
  if (!rows.encoder && !(how.along > 0.0))
    throw Error(ErrorKind::configuration, "these are " + what + ": how far the rows are apart is not said",
                {bytes.file(), 0, 0}, "say map.along_mm");
  constexpr std::size_t kLeastHeight = 2;  // "0,"
  CloudBuilder builder(bytes, options, kLeastHeight,
                       [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  std::string_view line;
  double count = 0.0;
  while (lines.next(line)) {
    const LineKind kind = kind_of_line(line);
    if (kind == LineKind::empty || kind == LineKind::comment) continue;
    FieldScanner fields(line, rows.style.separator);
    Field field;
    double x = how.along * count;
    if (rows.encoder && fields.next(field) && !(how.along > 0.0)) x = number_in(lines, field, rows.style.decimal_comma);
    std::size_t k = 0;
    for (; k < rows.heights && fields.next(field); ++k) {
      double z = 0.0;
      if (!parse_number(field.text, rows.style.decimal_comma, z))
        z = is_nothing(field.text) ? std::numeric_limits<double>::quiet_NaN()
                                   : number_in(lines, field, rows.style.decimal_comma);
      builder.add({x, how.across * static_cast<double>(k), z});
    }
    if (k < rows.heights)
      lines.fail(fmt::format("the row has {} heights, those before have {}", k, rows.heights), 0,
                 "is the file truncated?");
    count += 1.0;
  }
  return builder.finish(what + ", " + rows.style.in_words(), std::nullopt);
}

}  // namespace treadmark::io::scans
