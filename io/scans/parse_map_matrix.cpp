// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/scans/map_axis.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

bool all_nan(const std::vector<float>& values) {
  for (const float v : values)
    if (!std::isnan(v)) return false;
  return true;
}

class MatrixReader {
 public:
  MatrixReader(ByteBlocks& bytes, const MapReadOptions& options)
      : options_(options), head_(find_map_head(bytes)), lines_(bytes) {}

  OffsetMap read() {
    std::string_view line;
    bool first = true;
    while (next_line(line)) {
      if (first)
        read_positions(line);
      else
        read_row(line);
      first = false;
    }
    if (first) lines_.fail("the file holds no map", 0, "is it the right file?");
    return finish();
  }

 private:
  bool next_line(std::string_view& line) {
    while (lines_.next(line)) {
      const LineKind kind = kind_of_line(line);
      if (kind == LineKind::comment && columns_.empty()) words_.look_at(comment_text(line));
      if (kind != LineKind::empty && kind != LineKind::comment) return true;
    }
    return false;
  }

  void read_positions(std::string_view line) {
    std::vector<Field> fields = fields_of(line, head_.style.separator);
    if (!head_.corner_missing) {
      if (fields.empty()) lines_.fail("the first row has no lateral positions");
      std::string_view corner = fields.front().text;
      if (const std::optional<LengthUnit> unit = unit_of_word(corner))
        corner_unit_.add(unit);
      else
        corner_unit_.look_at(corner);
      fields.erase(fields.begin());
    }
    for (const Field& field : fields) columns_.push_back(number_in(lines_, field, head_.style.decimal_comma));
    if (const std::optional<std::size_t> bad = uneven_position(columns_))
      lines_.fail(
          columns_.size() < 2 ? "a map needs at least two lateral positions"
                              : "the lateral positions do not increase evenly",
          *bad < fields.size() ? fields[*bad].column : 0,
          "the first row holds the lateral positions, the first column those along the track or round the wheel");
    scales_ = map_scales(options_, corner_unit_.unit() ? corner_unit_.unit() : words_.unit(), words_.height_unit());
  }

  void read_row(std::string_view line) {
    FieldScanner fields(line, head_.style.separator);
    Field field;
    if (!fields.next(field)) return;
    rows_.push_back(number_in(lines_, field, head_.style.decimal_comma));
    row_lines_.push_back(lines_.number());
    row_columns_.push_back(field.column);
    std::size_t n = 0;
    while (fields.next(field)) {
      if (n == columns_.size()) {
        if (field.text.empty()) continue;
        lines_.fail(fmt::format("more values than the {} lateral positions of the first row", n), field.column,
                    "all rows must have the same number of columns");
      }
      const double value = field.text.empty() ? std::numeric_limits<double>::quiet_NaN()
                                              : number_in(lines_, field, head_.style.decimal_comma);
      options_.judge([&](const auto& what, const auto& advice) { lines_.fail(what, field.column, advice); },
                     static_cast<int>(rows_.size()) - 1, static_cast<int>(n), std::isnan(value));
      values_.push_back(deviation_in_metres(lines_, value, scales_.height, field.column));
      ++n;
    }
    if (n < columns_.size())
      lines_.fail(fmt::format("the row has {} values, there are {} lateral positions", n, columns_.size()), 0,
                  "all rows must have the same number of columns; is the file truncated?");
  }

  OffsetMap finish() {
    const std::string& file = lines_.bytes().file();
    if (rows_.size() < 2) lines_.fail("a map needs at least two rows of deviations", 0, "is the file truncated?");
    if (rows_.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) lines_.fail("too many rows");
    if (const std::optional<std::size_t> bad = uneven_position(rows_))
      throw Error(ErrorKind::input_data, "the positions of the rows do not increase evenly",
                  {file, row_lines_[*bad], row_columns_[*bad]}, "interpolate the map onto an even grid");
    if (all_nan(values_)) no_data(file);
    OffsetMap map;
    map.name = file;
    const auto nx = rows_.size(), ny = columns_.size();
    map.grid.nx = static_cast<int>(nx);
    map.grid.ny = static_cast<int>(ny);
    map.grid.x0 = rows_.front() * scales_.u;
    map.grid.y0 = columns_.front() * scales_.y;
    map.grid.dx = (rows_.back() - rows_.front()) / static_cast<double>(nx - 1) * scales_.u;
    map.grid.dy = (columns_.back() - columns_.front()) / static_cast<double>(ny - 1) * scales_.y;
    check_turn(map.grid, options_, file);
    map.offset.resize(values_.size());
    for (std::size_t iy = 0; iy < ny; ++iy)
      for (std::size_t ix = 0; ix < nx; ++ix) map.offset[ix + nx * iy] = values_[iy + ny * ix];
    lines_.bytes().finish();
    return map;
  }

  const MapReadOptions& options_;
  MapHead head_;
  LineBlocks lines_;
  MapUnitWords words_;
  UnitFinder corner_unit_;
  MapScales scales_;
  std::vector<double> columns_, rows_;
  std::vector<int> row_lines_, row_columns_;
  std::vector<float> values_;  ///< row by row of the file, along y
};

}  // namespace

OffsetMap parse_map_matrix(ByteBlocks& bytes, const MapReadOptions& options) {
  return MatrixReader(bytes, options).read();
}

}  // namespace treadmark::io::scans
