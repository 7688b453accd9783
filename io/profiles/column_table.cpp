// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/column_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/io/points/unit_words.hpp"

namespace treadmark::io::profiles {
namespace {

constexpr std::size_t kSampleRows = 200;

double number_of(const TextLine& line, const Word& word, bool decimal_comma) {
  if (!decimal_comma || word.text.find(',') == std::string_view::npos) return to_number(line, word);
  double value = 0.0;
  if (points::parse_number(word.text, true, value) && std::isfinite(value)) return value;
  line.fail("a number is expected, this is " + printable(word.text), word.column);
}

struct KnownColumn {
  std::string_view name;  ///< small letters and digits only
  char axis;              ///< r: radius, d: diameter, which stand for z of a wheel
};

constexpr KnownColumn kKnownColumns[] = {
    {"x", 'x'},        {"xcoord", 'x'},      {"xcoordinate", 'x'},   {"xpos", 'x'},     {"y", 'y'},
    {"ycoord", 'y'},   {"ycoordinate", 'y'}, {"ypos", 'y'},          {"lateral", 'y'},  {"z", 'z'},
    {"zcoord", 'z'},   {"zcoordinate", 'z'}, {"zpos", 'z'},          {"vertical", 'z'}, {"height", 'z'},
    {"r", 'r'},        {"radius", 'r'},      {"rollingradius", 'r'}, {"rayon", 'r'},    {"d", 'd'},
    {"diameter", 'd'}, {"durchmesser", 'd'}, {"diametre", 'd'}};

/// An empty field is one only where something separates; blanks in a row separate nothing.
bool has_mark(std::string_view word, char separator) { return !word.empty() || separator != ' '; }

char axis_of(std::string_view name) {
  std::string plain = lower(name);
  std::erase_if(plain, [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); });
  for (const KnownColumn& known : kKnownColumns)
    if (known.name == plain) return known.axis;
  return '\0';
}

}  // namespace

std::string plain_line(std::string_view line) {
  const std::string signs = points::plain_signs(line);
  if (!signs.empty()) line = signs;
  std::string plain;
  if (line.find('"') == std::string_view::npos || !points::unquote_numbers(line, plain)) plain = line;
  const std::size_t start = plain.find_first_not_of(" \t\v\f");
  if (start == std::string::npos || plain.find_first_of("!\"%#", start) == start ||
      std::string_view(plain).substr(start).starts_with("//"))
    return {};
  plain.resize(points::without_comment(plain).size());
  for (std::size_t quote = plain.find('"'); quote != std::string::npos; quote = plain.find('"', quote + 1))
    if (quote > 0 && is_blank(plain[quote - 1])) {
      plain.resize(quote);
      break;
    }
  return plain;
}

std::optional<ColumnRoles> roles_of(const std::vector<std::string>& names, const TextLine& line) {
  int x = -1, y = -1, z = -1, r = -1, d = -1;
  ColumnRoles roles;
  points::UnitFinder unit;
  std::optional<std::string> twice;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string_view name = names[k];
    const std::optional<LengthUnit> own_unit = points::take_unit(name);
    const char axis = axis_of(name);
    int* const target = axis == 'x'   ? &x
                        : axis == 'y' ? &y
                        : axis == 'z' ? &z
                        : axis == 'r' ? &r
                        : axis == 'd' ? &d
                                      : nullptr;
    if (target == nullptr) continue;
    if (*target >= 0) twice = name;
    *target = static_cast<int>(k);
    unit.add(own_unit);
  }
  if (z < 0 && (x >= 0) != (y >= 0) && (r >= 0 || d >= 0)) {
    roles.radius_factor = r >= 0 ? 1.0 : 0.5;
    z = r >= 0 ? r : d;
  }
  if ((x >= 0) + (y >= 0) + (z >= 0) < 2) return std::nullopt;
  if (twice) line.fail("the column " + printable(*twice) + " is named twice", 1, "name the columns y and z once");
  if (unit.differ()) line.fail("the columns of coordinates have different units", 1, "write them in the same unit");
  // a section along x is written as x and y, or as x and z
  roles.y = y >= 0 && z >= 0 ? y : x;
  roles.z = z >= 0 ? z : y;
  roles.named = true;
  roles.unit = unit.unit();
  for (std::size_t k = 0; k < names.size(); ++k)
    if (static_cast<int>(k) != roles.y && static_cast<int>(k) != roles.z)
      roles.in_words += (roles.in_words.empty() ? "" : ", ") + names[k];
  return roles;
}

std::optional<ColumnRoles> roles_in(const TextLine& line, std::string_view text, char separator, std::size_t columns) {
  std::string unquoted(text);
  std::erase(unquoted, '"');
  for (const char s : {separator, ',', ';', '\t', ' '}) {
    const std::vector<std::string> names = points::names_in(unquoted, s);
    if (names.size() != columns) continue;
    if (std::optional<ColumnRoles> roles = roles_of(names, line)) return roles;
  }
  return std::nullopt;
}

points::FieldStyle ColumnTable::style() const {
  std::vector<std::string> sample;
  for (std::size_t k = 0; k < std::min(rows_.size(), kSampleRows); ++k) sample.push_back(rows_[k].text);
  points::FieldStyle style = points::find_style(sample, 2);
  // tabs are blanks here: no column of a profile is empty
  if (style.separator == '\t') style.separator = ' ';
  return style;
}

void ColumnTable::refuse_ambiguous_commas(const points::FieldStyle& style) const {
  if (style.separator != ',') return;
  // 1,5,2,5 may be two numbers or four
  std::vector<std::string> sample;
  for (std::size_t k = 0; k < std::min(rows_.size(), kSampleRows); ++k) sample.push_back(rows_[k].text);
  const bool decimal_points =
      std::any_of(sample.begin(), sample.end(), [](const std::string& s) { return s.find('.') != std::string::npos; });
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const std::size_t fields = points::fields_of(sample[k], ',').size();
    if (decimal_points || fields <= 2) continue;
    KeptLine(file_, rows_[k].line, rows_[k].text)
        .fail("the commas may separate numbers or stand for decimal points", 1,
              "separate numbers with decimal commas by ';' or blanks, or write decimal points");
  }
}

std::size_t ColumnTable::columns(char separator) const {
  return rows_.empty() ? 0 : points::fields_of(rows_.front().text, separator).size();
}

void ColumnTable::drop_count(std::vector<std::string>& notes) {
  constexpr std::size_t kFewest = 4;
  constexpr double kMostColumns = 20.0;
  if (rows_.size() < kFewest) return;
  std::string first = rows_.front().text;
  ranges::replace_if(
      first, [](char c) { return c == ',' || c == ';' || c == '\t'; }, ' ');
  const std::vector<points::Field> fields = points::fields_of(first, ' ');
  double count = 0.0, columns = 0.0;
  if (fields.empty() || fields.size() > 2 || !points::parse_number(fields[0].text, false, count)) return;
  if (count != static_cast<double>(rows_.size() - 1)) return;
  if (fields.size() == 2 && (!points::parse_number(fields[1].text, false, columns) || !points::is_whole(columns) ||
                             columns < 1.0 || columns > kMostColumns))
    return;
  notes.push_back(
      fmt::format("line {} counts the points that follow: {}", rows_.front().line, printable(rows_.front().text)));
  rows_.erase(rows_.begin());
}

void ColumnTable::turn_two_lines(const points::FieldStyle& style, std::vector<std::string>& notes) {
  constexpr std::size_t kFewest = 10;
  if (rows_.size() != 2 || columns(style.separator) < kFewest) return;
  const std::vector<points::Field> y = points::fields_of(rows_[0].text, style.separator),
                                   z = points::fields_of(rows_[1].text, style.separator);
  if (y.size() != z.size()) return;
  const char between = style.separator == ' ' ? ' ' : style.separator;
  std::vector<Row> turned;
  for (std::size_t k = 0; k < y.size(); ++k)
    turned.push_back({rows_[0].line, fmt::format("{}{}{}", y[k].text, between, z[k].text)});
  notes.push_back(fmt::format("two lines of {} numbers: the first holds y, the second z", y.size()));
  rows_ = std::move(turned);
}

RawPoints ColumnTable::points(const ColumnRoles& roles, const points::FieldStyle& style, bool numbers_only,
                              std::vector<std::string>& notes) const {
  constexpr double kMostOfAll = 0.3;
  RawPoints out;
  out.file = file_;
  int first_void = 0;
  std::size_t voids = 0, pending = 0, within = 0;
  for (const Row& row : rows_) {
    const KeptLine line(file_, row.line, row.text);
    points::FieldScanner fields(line.line(), style.separator);
    std::optional<double> y, z;
    bool nothing = false;
    int first = 0;
    points::Field field;
    for (int column = 0; fields.next(field); ++column) {
      if (first == 0) first = field.column;
      if (column == roles.y || column == roles.z) {
        if (points::is_void_word(field.text) && rows_.size() > 1 && has_mark(field.text, style.separator)) {
          nothing = true;
          continue;
        }
        (column == roles.y ? y : z) = number_of(line, field, style.decimal_comma);
      } else if (numbers_only && !field.text.empty() && !looks_numeric(field.text)) {
        if (!points::is_void_word(field.text)) number_of(line, field, style.decimal_comma);
      }
    }
    if (nothing) {
      if (first_void == 0) first_void = row.line;
      ++voids;
      if (out.size() > 0) ++pending;
      continue;
    }
    if (!y || !z)
      line.fail("a point needs a lateral and a vertical position, the line has too few numbers", first,
                "is the file truncated?");
    within += pending;
    pending = 0;
    out.add(*y, *z, row.line);
  }
  if (static_cast<double>(within) > kMostOfAll * static_cast<double>(out.size() + within))
    throw Error(
        ErrorKind::input_data,
        fmt::format("{} of {} points between the first and the last one have no value", within, out.size() + within),
        {file_, first_void, 0}, "measure again, or remove them");
  if (voids > 0)
    notes.push_back(fmt::format("{} point{} without a value {} left out (line {}{})", voids, voids == 1 ? "" : "s",
                                voids == 1 ? "was" : "were", first_void, voids == 1 ? "" : " and on"));
  return out;
}

ColumnRoles ColumnTable::assume_roles(const points::FieldStyle& style, std::vector<std::string>& notes) const {
  refuse_ambiguous_commas(style);
  constexpr std::size_t kFewest = 20;    // lines in which nobody counts by chance
  constexpr std::size_t kWidest = 300;   // mm: no profile is wider
  constexpr double kLeastHeight = 0.02;  // of a third column against the second, else it is a weight or constant
  const std::size_t count = columns(style.separator);
  if (rows_.size() < kFewest || count < 2) return {};
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
  double start = 0.0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    points::FieldScanner fields(rows_[k].text, style.separator);
    points::Field field;
    for (std::size_t c = 0; c < std::min<std::size_t>(count, 3); ++c) {
      double value = 0.0;
      if (!fields.next(field) || !points::parse_number(field.text, style.decimal_comma, value)) return {};
      if (c == 0 && k == 0) start = value;
      if (c == 0 && (value != start + static_cast<double>(k) || (start != 0.0 && start != 1.0))) return {};
      low[c] = std::min(low[c], value);
      high[c] = std::max(high[c], value);
    }
  }
  const auto counts = [&](const std::string& advice) {
    KeptLine(file_, rows_.front().line, rows_.front().text)
        .fail(fmt::format("the first column counts the points ({:g}, {:g}, {:g} ...): it is no lateral position", start,
                          start + 1.0, start + 2.0),
              1, advice);
  };
  const double third = high[2] - low[2];
  const bool more = count >= 3 && third > kLeastHeight * (high[1] - low[1]) && high[1] > low[1];
  if (rows_.size() > kWidest && more) {
    notes.push_back("the first column counts the points: y and z are the second and the third");
    ColumnRoles roles;
    roles.y = 1, roles.z = 2;
    return roles;
  }
  if (more) counts("name the columns in a line before them, for example: n y z; or leave it out");
  if (rows_.size() > kWidest) counts("write y and z in each line");
  return {};
}

}  // namespace treadmark::io::profiles
