// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <array>
#include <limits>

#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/scans/cloud_builder.hpp"
#include "treadmark/io/scans/column_layout.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::io::scans {

namespace {

bool begins_comment(std::string_view text) { return text.find_first_of("#!%") == 0 || text.starts_with("//"); }

/// A line of points, read into values.
class RowReader {
 public:
  using Values = std::array<double, ColumnLayout::kValues>;

  RowReader(const LineBlocks& lines, const ColumnLayout& layout) : lines_(lines), layout_(layout) {}

  /// Number of the fields found where they are too few, else 0.
  std::size_t read(std::string_view line, Values& values) const {
    FieldScanner fields(line, layout_.style.separator);
    Field field;
    const std::size_t columns = layout_.value.size();
    for (std::size_t k = 0; k < columns; ++k) {
      if (!fields.next(field) || begins_comment(field.text)) return std::max<std::size_t>(k, 1);
      const int value = layout_.value[k];
      if (value < 0) continue;
      double& number = values[static_cast<std::size_t>(value)];
      if (!parse_number(field.text, layout_.style.decimal_comma, number))
        number = is_nothing(field.text) ? std::numeric_limits<double>::quiet_NaN()
                                        : number_in(lines_, field, layout_.style.decimal_comma);
    }
    while (fields.next(field)) {
      if (begins_comment(field.text)) return 0;
      if (!field.text.empty())
        lines_.fail(fmt::format("more than the {} columns of the lines before", columns), field.column,
                    "do two lines run together?");
    }
    return 0;
  }

 private:
  const LineBlocks& lines_;
  const ColumnLayout& layout_;
};

/// A pass that may be something else; false where it is.
bool is_pass(double number) { return number >= 0.0 && number <= 65535.0 && is_whole(number); }

}  // namespace

Scan parse_columns(ByteBlocks& bytes, const ScanReadOptions& options) {
  ColumnLayout layout = find_layout(bytes);
  LineBlocks lines(bytes);
  constexpr std::size_t kLeastLine = 6;  // "0 0 0"
  CloudBuilder builder(bytes, options, kLeastLine,
                       [&](const std::string& m, const std::string& a) { lines.fail(m, 0, a); });
  builder.set_content(layout.normals, layout.pass);
  builder.set_intensities(layout.intensity);
  const RowReader row(lines, layout);
  RowReader::Values v{};
  std::uint64_t promised = 0;
  std::string_view line;
  while (lines.next(line)) {
    // after the first point most lines show by their first character what they are
    const bool plain =
        builder.scan().points_in_file > 0 && !line.empty() && ((line[0] >= '0' && line[0] <= '9') || line[0] == '-');
    LineKind kind = plain ? LineKind::numbers : kind_of_line(line);
    if (kind == LineKind::empty || kind == LineKind::comment) continue;
    if (kind == LineKind::words && layout.text_first && lines.number() >= layout.first_points) kind = LineKind::numbers;
    if (kind == LineKind::words && is_lost_row(line)) {
      builder.add_lost();
      continue;
    }
    if (kind == LineKind::words) {
      if (lines.number() < layout.first_points || builder.scan().points_in_file == 0) continue;  // looked at before
      const std::size_t start = line.find_first_not_of(" \t\v\f");
      lines.fail("a number is expected, this is " + profiles::printable(line.substr(start)),
                 static_cast<int>(start + 1), "put a # before lines that are no points");
    }
    if (const std::size_t found = row.read(line, v); found > 0) {
      // exports of several scans have a count before each
      if (layout.count_first && found == 1) {
        const std::vector<Field> fields = fields_of(line, ' ');
        const std::uint64_t count = count_in(lines, fields.front());
        promised += count;
        builder.expect(count);
        continue;
      }
      lines.fail(fmt::format("the line has {} column{}, those before have {}", found, found > 1 ? "s" : "",
                             layout.value.size()),
                 0, "is the file truncated?");
    }
    std::uint16_t pass = 0;
    if (layout.pass) {
      if (layout.loose_pass && !is_pass(v[ColumnLayout::kPass])) {
        layout.pass = false;
        layout.in_words += fmt::format(", the pass of line {} is none and all are ignored", lines.number());
        builder.drop_passes();
      } else {
        pass = builder.pass(v[ColumnLayout::kPass]);
      }
    }
    builder.add({v[0], v[1], v[2]}, {static_cast<float>(v[3]), static_cast<float>(v[4]), static_cast<float>(v[5])},
                pass, static_cast<float>(v[ColumnLayout::kIntensity]));
  }
  if (builder.scan().points_in_file < promised)
    lines.fail(fmt::format("{} points are promised, the file ends after {}", promised, builder.scan().points_in_file),
               0, "is it truncated?");
  if (promised > 0 && builder.scan().points_in_file > promised)
    layout.in_words += fmt::format(", {} points promised and {} found", promised, builder.scan().points_in_file);
  return builder.finish(layout.in_words, layout.unit);
}

}  // namespace treadmark::io::scans
