// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_irregularities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/io/settings/exact_text.hpp"
#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {

namespace {

using points::Field;
using profiles::LineScanner;

/// What a column may hold: the distance, or a function of the track or of one rail.
struct Quantity {
  std::string_view name;
  int function = -1;  ///< of Irregularity; -1: distance
  int rail = 0;       ///< -1 left, 1 right, 0 track
};
constexpr Quantity kQuantities[] = {{"distance", -1, 0},
                                    {"longitudinal_level", 0, 0},
                                    {"longitudinal_level_left", 0, -1},
                                    {"longitudinal_level_right", 0, 1},
                                    {"cross_level", 1, 0},
                                    {"alignment", 2, 0},
                                    {"alignment_left", 2, -1},
                                    {"alignment_right", 2, 1},
                                    {"gauge", 3, 0}};
constexpr std::size_t kCount = std::size(kQuantities);

struct LengthEnding {
  std::string_view ending;
  double si;
};
constexpr LengthEnding kEndings[] = {{"_um", 1e-6}, {"_mm", 1e-3}, {"_km", 1e3}, {"_m", 1.0}};

struct Column {
  const Quantity* quantity = nullptr;  ///< null: not used
  double unit = 1.0;
};

std::vector<std::string> known_names() {
  std::vector<std::string> names;
  for (const Quantity& q : kQuantities) names.push_back(std::string(q.name) + (q.function < 0 ? "_m" : "_mm"));
  return names;
}

Column column_of(const LineScanner& line, const Field& field, const std::string& name) {
  for (const Quantity& q : kQuantities) {
    if (name == q.name)
      line.fail(fmt::format("the column {} has no unit", name), field.column,
                fmt::format("call it {}{}", name, q.function < 0 ? "_m" : "_mm"));
    for (const LengthEnding& unit : kEndings)
      if (name == fmt::format("{}{}", q.name, unit.ending)) return {&q, unit.si};
  }
  if (const std::string near = nearest_key(name, known_names()); !near.empty())
    line.fail("unknown column " + profiles::printable(name), field.column, fmt::format("did you mean {}?", near));
  return {};
}

/// The columns by the line that names them; place: of each quantity, or nothing.
struct Columns {
  std::vector<Column> all;
  std::array<std::optional<std::size_t>, kCount> place;
  char separator = ',';

  std::optional<std::size_t> of(int function, int rail) const {
    for (std::size_t i = 0; i < kCount; ++i)
      if (kQuantities[i].function == function && kQuantities[i].rail == rail) return place[i];
    return std::nullopt;
  }
};

void check_columns(const LineScanner& line, const Columns& columns) {
  if (!columns.place[0]) line.fail("no column holds the distance", 0, "call it distance_m");
  int functions = 0;
  for (int function = 0; function < kIrregularities; ++function) {
    const bool track = columns.of(function, 0).has_value(), left = columns.of(function, -1).has_value(),
               right = columns.of(function, 1).has_value();
    const auto index = static_cast<std::size_t>(function);
    const std::string_view name = kIrregularityNames[index];
    if (left != right)
      line.fail(fmt::format("{} is given of the {} rail only", name, left ? "left" : "right"), 0,
                "give both rails, or the track");
    // The level and the alignment of both rails say what cross level and gauge say, too.
    const bool again = left && columns.of(function + 1, 0).has_value();
    if ((track && left) || again)
      line.fail(fmt::format("{} of both rails stands beside {}", name, track ? name : kIrregularityNames[index + 1]), 0,
                "give two functions of the track, or one of each rail");
    if (track || left) ++functions;
  }
  if (functions == 0)
    line.fail("no column holds an irregularity", 0,
              "names are longitudinal_level_mm, cross_level_mm, alignment_mm, gauge_mm");
}

Columns read_names(const LineScanner& line, std::vector<std::string>* notes) {
  Columns columns;
  const std::string_view text = line.line();
  for (const char separator : {';', '\t', ','})
    if (text.find(separator) != std::string_view::npos) {
      columns.separator = separator;
      break;
    }
  std::string unused;
  for (const Field& field : points::fields_of(text, columns.separator)) {
    std::string_view raw = field.text;
    if (raw.size() >= 2 && raw.front() == '"' && raw.back() == '"') raw = raw.substr(1, raw.size() - 2);
    const std::string name = profiles::lower(raw);
    const Column column = column_of(line, field, name);
    if (column.quantity == nullptr) {
      unused += (unused.empty() ? "" : ", ") + profiles::printable(name);
    } else {
      auto& place = columns.place[static_cast<std::size_t>(column.quantity - kQuantities)];
      if (place) line.fail(fmt::format("two columns hold the {}", column.quantity->name), field.column);
      place = columns.all.size();
    }
    columns.all.push_back(column);
  }
  check_columns(line, columns);
  if (notes != nullptr && !unused.empty())
    notes->push_back(fmt::format("{}: columns that are not used: {}", line.file(), unused));
  return columns;
}

/// Numbers of one line by quantity, in SI units.
using Row = std::array<double, kCount>;
Row read_row(const LineScanner& line, const Columns& columns) {
  const std::vector<Field> fields = points::fields_of(line.line(), columns.separator);
  if (fields.size() != columns.all.size())
    line.fail(fmt::format("the line has {} fields, {} columns have names", fields.size(), columns.all.size()),
              fields.empty() ? 0 : fields.back().column);
  Row row{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const Column& column = columns.all[i];
    if (column.quantity == nullptr) continue;
    double value = 0.0;
    const bool comma = columns.separator != ',' && fields[i].text.find(',') != std::string_view::npos;
    if (!points::parse_number(fields[i].text, comma, value))
      line.fail("a number is expected, this is " + profiles::printable(fields[i].text), fields[i].column);
    value *= column.unit;
    if (!std::isfinite(value))
      line.fail("a finite number is expected, this is " + profiles::printable(fields[i].text), fields[i].column,
                "leave out lines without values");
    if (column.quantity->function >= 0 && std::abs(value) > kLargestIrregularity)
      line.fail(fmt::format("{} = {:.6g} mm is more than {:g} mm", column.quantity->name, value * 1e3,
                            kLargestIrregularity * 1e3),
                fields[i].column,
                column.quantity->function == static_cast<int>(Irregularity::gauge)
                    ? "the gauge is that beyond the gauge of the line"
                    : "look at the unit in the name of the column");
    row[static_cast<std::size_t>(column.quantity - kQuantities)] = value;
  }
  return row;
}

/// The functions of the track from those of a line.
void add_row(IrregularityTable& table, const Columns& columns, const Row& row) {
  table.distance.push_back(row[0]);
  const auto value = [&](int function, int rail) {
    return row[static_cast<std::size_t>(
        std::find_if(std::begin(kQuantities), std::end(kQuantities),
                     [&](const Quantity& q) { return q.function == function && q.rail == rail; }) -
        std::begin(kQuantities))];
  };
  for (int function = 0; function < kIrregularities; ++function) {
    const auto index = static_cast<std::size_t>(function);
    if (columns.of(function, 0)) table.values[index].push_back(value(function, 0));
    if (!columns.of(function, -1)) continue;
    const double left = value(function, -1), right = value(function, 1);
    table.values[index].push_back(0.5 * (left + right));
    table.values[index + 1].push_back(right - left);
  }
}

}  // namespace

IrregularityTable parse_irregularity_text(std::string_view text, const std::string& name,
                                          std::vector<std::string>* notes) {
  LineScanner line(text, name);
  std::optional<Columns> columns;
  IrregularityTable table;
  while (line.next_line()) {
    const points::LineKind kind = points::kind_of_line(line.line());
    if (kind == points::LineKind::empty || kind == points::LineKind::comment) continue;
    if (!columns) {
      if (kind == points::LineKind::numbers)
        line.fail("a line with the names of the columns must stand before the numbers", 1,
                  "as distance_m,longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm");
      columns = read_names(line, notes);
      continue;
    }
    const Row row = read_row(line, *columns);
    if (!table.distance.empty() && !(row[0] > table.distance.back()))
      line.fail(
          fmt::format("the distance goes from {:.10g} to {:.10g} m, it must increase", table.distance.back(), row[0]),
          1);
    add_row(table, *columns, row);
  }
  constexpr std::size_t kLeast = 4;
  if (table.distance.size() < kLeast)
    throw Error(ErrorKind::input_data,
                fmt::format("the file has {} lines of numbers, at least {} are needed", table.distance.size(), kLeast),
                {name, 0, 0});
  return table;
}

IrregularityTable read_irregularity_file(const std::filesystem::path& file, std::vector<std::string>* notes) {
  return parse_irregularity_text(read_text(file), file.string(), notes);
}

std::string irregularity_text(const IrregularityTable& table) {
  // In millimetres where that means the same numbers.
  std::array<bool, kIrregularities> in_mm{};
  std::string text = "distance_m";
  for (std::size_t f = 0; f < table.values.size(); ++f) {
    const std::vector<double>& values = table.values[f];
    in_mm[f] = std::all_of(values.begin(), values.end(), [](double value) {
      double read = 0.0;
      return points::parse_number(exact_text(value, kMillimetre), false, read) && read * kMillimetre == value;
    });
    if (!values.empty()) text += fmt::format(",{}_{}", kIrregularityNames[f], in_mm[f] ? "mm" : "m");
  }
  text += '\n';
  for (std::size_t i = 0; i < table.distance.size(); ++i) {
    text += exact_text(table.distance[i], 1.0);
    for (std::size_t f = 0; f < table.values.size(); ++f)
      if (!table.values[f].empty()) text += ',' + exact_text(table.values[f][i], in_mm[f] ? kMillimetre : 1.0);
    text += '\n';
  }
  return text;
}

}  // namespace treadmark::io
