// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/map_axis.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

class EsriReader {
 public:
  EsriReader(ByteBlocks& bytes, const MapReadOptions& options) : options_(options), lines_(bytes) {}

  OffsetMap read() {
    std::string_view line;
    bool more = next_line(line);
    for (; more && kind_of_line(line) == LineKind::words; more = next_line(line)) read_key(line);
    set_grid();
    const auto nx = static_cast<std::size_t>(map_.grid.nx), ny = static_cast<std::size_t>(map_.grid.ny);
    map_.offset.resize(nx * ny);
    bool any = false;
    for (std::size_t row = 0; row < ny; ++row, more = next_line(line)) {
      if (!more) lines_.fail(fmt::format("the file ends after {} of {} rows", row, ny), 0, "is it truncated?");
      any = read_row(line, static_cast<int>(ny - 1 - row)) || any;
    }
    if (more) lines_.fail(fmt::format("more than the {} rows of the header", ny), 1, "is nrows right?");
    if (!any) no_data(lines_.bytes().file());
    lines_.bytes().finish();
    return std::move(map_);
  }

 private:
  bool next_line(std::string_view& line) {
    while (lines_.next(line)) {
      const LineKind kind = kind_of_line(line);
      if (kind == LineKind::comment) words_.look_at(comment_text(line));
      if (kind != LineKind::empty && kind != LineKind::comment) return true;
    }
    return false;
  }

  void read_key(std::string_view line) {
    const std::vector<Field> fields = fields_of(line, ' ');
    const std::string key = profiles::lower(fields[0].text);
    static constexpr std::string_view kKeys[] = {"ncols",     "nrows",     "xllcorner", "xllcenter",
                                                 "yllcorner", "yllcenter", "cellsize",  "nodata_value"};
    if (std::find(std::begin(kKeys), std::end(kKeys), key) == std::end(kKeys))
      lines_.fail("unknown line " + profiles::printable(fields[0].text) + " in the header", fields[0].column,
                  "known are ncols, nrows, xllcorner, xllcenter, yllcorner, yllcenter, cellsize and NODATA_value");
    if (fields.size() != 2) lines_.fail("one value is expected behind " + key, fields[0].column);
    const double value = number_in(lines_, fields[1], true);
    if ((key == "ncols" || key == "nrows") && !(is_whole(value) && value >= 2.0))
      lines_.fail(key + " must be a whole number of at least 2", fields[1].column);
    if (key == "cellsize" && !(value > 0.0 && std::isfinite(value)))
      lines_.fail("cellsize must be positive", fields[1].column);
    if (key != "nodata_value" && !std::isfinite(value)) lines_.fail(key + " must be finite", fields[1].column);
    if (!keys_.emplace(key, value).second) lines_.fail(key + " a second time", fields[0].column);
  }

  double key(const std::string& name) const {
    const auto found = keys_.find(name);
    if (found == keys_.end())
      lines_.fail("the header lacks " + name, 0,
                  "an ESRI ASCII grid names ncols, nrows, xllcorner, yllcorner, cellsize");
    return found->second;
  }

  /// The middle of the first cell.
  double first(const std::string& axis) const {
    const auto centre = keys_.find(axis + "llcenter");
    return centre != keys_.end() ? centre->second : key(axis + "llcorner") + 0.5 * key("cellsize");
  }

  void set_grid() {
    const double nx = key("ncols"), ny = key("nrows");
    // a value takes a character and a blank
    if (2.0 * nx * ny > static_cast<double>(lines_.bytes().size() - lines_.start()) + 1.0)
      throw Error(ErrorKind::input_data,
                  fmt::format("{} times {} values are promised, more than the file can hold", ny, nx),
                  {lines_.bytes().file(), 0, 0}, "is it truncated?");
    constexpr double kMost = std::numeric_limits<int>::max();
    if (nx > kMost || ny > kMost) lines_.fail("too many rows or columns");
    const MapScales scales = map_scales(options_, words_.unit(), words_.height_unit());
    map_.name = lines_.bytes().file();
    map_.grid = {first("x") * scales.u,      first("y") * scales.y, key("cellsize") * scales.u,
                 key("cellsize") * scales.y, static_cast<int>(nx),  static_cast<int>(ny)};
    check_turn(map_.grid, options_, map_.name);
    height_ = scales.height;
    if (const auto found = keys_.find("nodata_value"); found != keys_.end()) no_data_ = found->second;
  }

  /// Whether there is a value.
  bool read_row(std::string_view line, int iy) {
    float* row = map_.offset.data() + map_.grid.index(0, iy);
    FieldScanner fields(line, ' ');
    Field field;
    const int columns = map_.grid.nx;
    bool any = false;
    for (int k = 0; k < columns; ++k) {
      if (!fields.next(field))
        lines_.fail(fmt::format("the row has {} values, ncols says {}", k, columns), 0, "is the file truncated?");
      const double value = number_in(lines_, field, true);
      const bool none = std::isnan(value) || value == no_data_;
      options_.judge([&](const auto& what, const auto& advice) { lines_.fail(what, field.column, advice); }, k, iy,
                     none);
      row[k] =
          none ? std::numeric_limits<float>::quiet_NaN() : deviation_in_metres(lines_, value, height_, field.column);
      any = any || !none;
    }
    if (fields.next(field))
      lines_.fail(fmt::format("more values than the {} of ncols", columns), field.column, "is ncols right?");
    return any;
  }

  const MapReadOptions& options_;
  LineBlocks lines_;
  MapUnitWords words_;
  std::map<std::string, double> keys_;
  OffsetMap map_;
  double height_ = 1.0, no_data_ = -9999.0;
};

}  // namespace

OffsetMap parse_esri_grid(ByteBlocks& bytes, const MapReadOptions& options) {
  return EsriReader(bytes, options).read();
}

}  // namespace treadmark::io::scans
