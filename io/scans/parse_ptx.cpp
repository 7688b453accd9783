// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

/// Where a station puts its points: p -> linear p + shift.
struct Station {
  std::uint64_t points = 0;
  Mat3 linear = Mat3::Identity();
  Vec3 shift = Vec3::Zero();
};

/// Walks over the lines that are neither empty nor comments.
class PtxReader {
 public:
  explicit PtxReader(LineBlocks& lines) : lines_(lines) {}

  /// The numbers of the next line, `least` to `most` of them. False at the end of the file.
  bool row(std::size_t least, std::size_t most, const char* what) {
    std::string_view line;
    do {
      if (!lines_.next(line)) return false;
      if (kind_of_line(line) == LineKind::comment) unit_.look_at(comment_text(line));
    } while (kind_of_line(line) == LineKind::empty || kind_of_line(line) == LineKind::comment);
    FieldScanner fields(line, ' ');
    Field field;
    count_ = 0;
    while (fields.next(field)) {
      if (count_ == most)
        lines_.fail(fmt::format("{} has at most {} numbers", what, most), field.column,
                    "does a line of the header miss, or do two lines run together?");
      column_[count_] = field.column;
      value_[count_++] = number_in(lines_, field);
    }
    if (count_ < least)
      lines_.fail(fmt::format("{} has {} numbers, the line has {}", what, least, count_), 0,
                  "does a line of the header miss, or is the file truncated?");
    return true;
  }

  void need(std::size_t least, std::size_t most, const char* what) {
    if (!row(least, most, what)) lines_.fail(fmt::format("the file ends before {}", what), 0, "is it truncated?");
  }

  double value(std::size_t k) const { return value_[k]; }
  /// NaN where the line has no such number.
  double value_or_none(std::size_t k) const { return k < count_ ? value_[k] : std::nan(""); }

  std::uint64_t count(std::size_t k) const {
    if (!is_whole(value_[k]) || value_[k] < 0.0 || value_[k] > static_cast<double>(kMostElements))
      fail(k, "a number of columns or rows of points is expected");
    return to_whole<std::uint64_t>(value_[k]);
  }

  [[noreturn]] void fail(std::size_t k, const std::string& message, const std::string& advice = {}) const {
    lines_.fail(message, column_[k], advice);
  }

  std::optional<LengthUnit> unit() const { return unit_.unit(); }

 private:
  static constexpr std::size_t kMost = 7;  // x y z intensity red green blue
  LineBlocks& lines_;
  std::array<double, kMost> value_{};
  std::array<int, kMost> column_{};
  std::size_t count_ = 0;
  UnitFinder unit_;
};

/// The header of a station: columns, rows, the scanner's place and axes (which the matrix repeats), the matrix by rows
/// for points as rows. Nothing at the end of the file.
std::optional<Station> next_station(PtxReader& reader) {
  if (!reader.row(1, 1, "the number of columns of points")) return std::nullopt;
  Station out;
  const std::uint64_t columns = reader.count(0);
  reader.need(1, 1, "the number of rows of points");
  out.points = columns * reader.count(0);
  reader.need(3, 3, "the place of the scanner");
  for (int k = 0; k < 3; ++k) reader.need(3, 3, "an axis of the scanner");
  for (Eigen::Index row = 0; row < 4; ++row) {
    reader.need(4, 4, "a row of the matrix");
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = reader.value(k);
      if (!std::isfinite(value)) reader.fail(k, "the matrix of a station must be finite");
      if (k == 3 && value != (row == 3 ? 1.0 : 0.0))
        reader.fail(k, "the last column of the matrix must be 0 0 0 1", "write the matrix by rows, as for row vectors");
      if (k < 3)
        (row < 3 ? out.linear(static_cast<Eigen::Index>(k), row) : out.shift[static_cast<Eigen::Index>(k)]) = value;
    }
  }
  if (!(std::fabs(out.linear.determinant()) > 0.0))
    reader.fail(0, "the matrix of the station makes all points a plane");
  return out;
}

}  // namespace

Scan parse_ptx(ByteBlocks& bytes, const ScanReadOptions& options) {
  LineBlocks lines(bytes);
  PtxReader reader(lines);
  constexpr std::size_t kLeastLine = 6;  // "0 0 0"
  CloudBuilder builder(bytes, options, kLeastLine,
                       [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  builder.set_content(false, true);
  builder.set_intensities(true);
  std::size_t stations = 0;
  std::string stretched;
  while (const std::optional<Station> station = next_station(reader)) {
    ++stations;
    const Vec3 by = Eigen::JacobiSVD<Mat3>(station->linear).singularValues();
    constexpr double kRigid = 1e-3;  // matrices are written with six decimals
    if (stretched.empty() && (std::fabs(by[0] - 1.0) > kRigid || std::fabs(by[2] - 1.0) > kRigid))
      stretched = fmt::format(", the matrix of station {} stretches by {:.4g} to {:.4g}", stations, by[2], by[0]);
    builder.expect(station->points);
    const std::uint16_t pass = builder.pass(static_cast<double>(stations));
    builder.set_station(pass, station->shift);
    for (std::uint64_t i = 0; i < station->points; ++i) {
      reader.need(3, 7, "a point (x y z, intensity, red green blue)");
      const Vec3 p(reader.value(0), reader.value(1), reader.value(2));
      if (p.isZero(0.0))
        builder.add_lost();
      else
        builder.add(station->linear * p + station->shift, Eigen::Vector3f::Zero(), pass,
                    static_cast<float>(reader.value_or_none(3)));
    }
  }
  std::string format = fmt::format("PTX, {} station{}", stations, stations == 1 ? "" : "s") + stretched;
  if (builder.keep_different_passes()) format += ", pass from the station";
  return builder.finish(std::move(format), reader.unit());
}

}  // namespace treadmark::io::scans
