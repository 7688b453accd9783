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
    {"diameter", 'd'}, {"durchmesser", 'd'}, {"diametre", 'd'},      {"quer", 'y'},     {"hoehe", 'z'},
    {"hhe", 'z'}};  // without its umlaut

/// Words that make no coordinate of a name: "z deviation".
constexpr std::string_view kDifferences[] = {"deviation", "deviations", "dev",   "diff", "difference", "delta",
                                             "error",     "wear",       "sigma", "std",  "uncertainty"};

/// An empty field is one only where something separates; blanks in a row separate nothing.
bool has_mark(std::string_view word, char separator) { return !word.empty() || separator != ' '; }

char axis_of(std::string_view name) {
  std::string plain = lower(name);
  std::erase_if(plain, [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); });
  for (const KnownColumn& known : kKnownColumns)
    if (known.name == plain) return known.axis;
  return '\0';
}

/// A coordinate, and which of several it is: "" of "y", "left" of "z left", "1" of "y1", "l" of "yL".
struct CoordinateName {
  char axis = '\0';
  std::string of;
};

CoordinateName coordinate_named(std::string_view name) {
  if (const char axis = axis_of(name)) return {axis, {}};
  const std::string text = lower(name);
  const auto in_word = [&](std::size_t at) {
    const char c = text[at];
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80;
  };
  CoordinateName out;
  const auto add = [&out](std::string_view word) { out.of.append(out.of.empty() ? "" : " ").append(word); };
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t start = at;
    while (at < text.size() && in_word(at)) ++at;
    if (at == start) {
      ++at;
      continue;
    }
    std::string_view word = std::string_view(text).substr(start, at - start), rest;
    if (ranges::find(kDifferences, word) != std::end(kDifferences)) return {};
    char axis = word == "r" || word == "d" ? '\0' : axis_of(word);
    const bool short_name = axis == '\0' && word[0] >= 'x' && word[0] <= 'z';
    if (short_name) rest = word.substr(1);
    if (short_name && (rest == "l" || rest == "r" || rest.find_first_not_of("0123456789") == std::string_view::npos))
      axis = word[0];
    if (axis == '\0') add(word);
    if (axis == '\0') continue;
    if (out.axis != '\0' && out.axis != axis) return {};
    out.axis = axis;
    if (!rest.empty()) add(rest);
  }
  return out.axis == '\0' ? CoordinateName{} : out;
}

/// The columns of one thing's coordinates.
struct Coordinates {
  int x = -1, y = -1, z = -1, r = -1, d = -1;

  int* of(char axis) {
    switch (axis) {
      case 'x':
        return &x;
      case 'y':
        return &y;
      case 'z':
        return &z;
      case 'r':
        return &r;
      case 'd':
        return &d;
      default:
        return nullptr;
    }
  }
  /// With those that it has not of another one's.
  Coordinates with(const Coordinates& common) const {
    const auto one = [](int own, int other) { return own >= 0 ? own : other; };
    return {one(x, common.x), one(y, common.y), one(z, common.z), one(r, common.r), one(d, common.d)};
  }
  /// y and z of a profile; nothing where there are not two coordinates.
  std::optional<ColumnRoles> roles() const {
    Coordinates c = *this;
    ColumnRoles out;
    if (z < 0 && (x >= 0) != (y >= 0) && (r >= 0 || d >= 0)) {
      out.radius_factor = r >= 0 ? 1.0 : 0.5;
      c.z = r >= 0 ? r : d;
    }
    if ((c.x >= 0) + (c.y >= 0) + (c.z >= 0) < 2) return std::nullopt;
    // a section along x is written as x and y, or as x and z
    out.y = c.y >= 0 && c.z >= 0 ? c.y : c.x;
    out.z = c.z >= 0 ? c.z : c.y;
    out.named = true;
    return out;
  }
};

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

std::vector<ColumnRoles> profiles_of(const std::vector<std::string>& names, const TextLine& line) {
  std::vector<std::pair<std::string, Coordinates>> things(1);  // the first: of what has no name of its own
  std::vector<std::optional<LengthUnit>> units;
  std::optional<std::string> twice;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string_view name = names[k];
    units.push_back(points::take_unit(name));
    const CoordinateName found = coordinate_named(name);
    if (found.axis == '\0') continue;
    auto thing = ranges::find(things, found.of, &std::pair<std::string, Coordinates>::first);
    if (thing == things.end()) thing = things.emplace(things.end(), found.of, Coordinates{});
    int* const target = thing->second.of(found.axis);
    if (*target >= 0) twice = name;
    *target = static_cast<int>(k);
  }
  const Coordinates& common = things.front().second;
  std::vector<ColumnRoles> out;
  const auto unnamed = common.roles();
  // heights of several over one x and y
  const bool shares = !unnamed || (common.z < 0 && std::any_of(things.begin() + 1, things.end(), [](const auto& thing) {
                                     return thing.second.z >= 0 && thing.second.x < 0 && thing.second.y < 0;
                                   }));
  if (!shares) out.push_back(*unnamed);
  for (std::size_t k = 1; k < things.size(); ++k)
    if (const auto roles = (shares ? things[k].second.with(common) : things[k].second).roles()) out.push_back(*roles);
  if (out.empty()) return out;
  if (twice) line.fail("the column " + printable(*twice) + " is named twice", 1, "name the columns y and z once");
  for (ColumnRoles& roles : out) {
    points::UnitFinder unit;
    for (std::size_t k = 0; k < names.size(); ++k) {
      const bool own = static_cast<int>(k) == roles.y || static_cast<int>(k) == roles.z;
      std::string& words = own ? roles.own_words : roles.in_words;
      words += (words.empty() ? "" : ", ") + names[k];
      if (!own) continue;
      unit.add(units[k]);
      if (!units[k] && !roles.unknown_unit) roles.unknown_unit = points::unknown_unit_of_name(names[k]);
    }
    if (unit.differ()) line.fail("the columns of coordinates have different units", 1, "write them in the same unit");
    roles.unit = unit.unit();
  }
  return out;
}

std::size_t coordinates_among(const std::vector<std::string>& names) {
  return static_cast<std::size_t>(ranges::count_if(names, [](std::string_view name) {
    points::take_unit(name);
    return axis_of(name) != '\0';
  }));
}

bool is_height(std::string_view name) {
  points::take_unit(name);
  return axis_of(name) == 'z';
}

std::vector<std::string> names_for(std::string_view text, char separator, std::size_t columns) {
  std::string unquoted(text);
  std::erase(unquoted, '"');
  std::vector<std::string> names = points::names_in(unquoted, separator);
  if (names.size() != columns) names.clear();
  return names;
}

std::optional<ColumnRoles> roles_in(const TextLine& line, std::string_view text, char separator, std::size_t columns,
                                    int profile) {
  for (const char s : {separator, ',', ';', '\t', ' '}) {
    const std::vector<std::string> names = names_for(text, s, columns);
    const std::vector<ColumnRoles> found = names.empty() ? std::vector<ColumnRoles>{} : profiles_of(names, line);
    if (found.empty()) continue;
    std::string all;
    for (std::size_t k = 0; k < found.size(); ++k)
      all += fmt::format("{}{} ({})", k > 0 ? ", " : "", k + 1, found[k].own_words);
    if (static_cast<std::size_t>(profile) > found.size())
      line.fail(fmt::format("there is no profile {} in the file, there are {}", profile, all), 1, "name one of them");
    if (profile == 0 && found.size() > 1)
      line.fail("the columns hold several profiles: " + all, 1,
                fmt::format("put its number behind the name: '{}#1' to '#{}', or keep one in a file",
                            std::string_view(line.file()).substr(line.file().find_last_of('/') + 1), found.size()));
    return found[static_cast<std::size_t>(std::max(profile, 1)) - 1];
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

ColumnTable::Others ColumnTable::others(const ColumnRoles& roles, const points::FieldStyle& style) const {
  constexpr std::size_t kMostRows = 2000, kFewest = 10;
  constexpr double kAlike = 0.9, kTimes = 2.0;  // correlation; ranges of columns
  const std::size_t count = columns(style.separator), step = 1 + rows_.size() / kMostRows;
  std::vector<std::vector<double>> values(count);  // NaN: no number
  for (std::size_t k = 0; k < rows_.size(); k += step) {
    points::FieldScanner fields(rows_[k].text, style.separator);
    points::Field field;
    for (std::vector<double>& column : values) {
      double value = 0.0;
      const bool is_number = fields.next(field) && points::parse_number(field.text, style.decimal_comma, value);
      column.push_back(is_number && std::isfinite(value) ? value : std::nan(""));
    }
  }
  Others out;
  const auto z = static_cast<std::size_t>(roles.z);
  for (std::size_t c = 0; c < count; ++c) {
    // before y a column counts the lines
    if (static_cast<int>(c) <= roles.y || static_cast<int>(c) == roles.z || z >= count) continue;
    double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, ab = 0.0, bb = 0.0, apart = 0.0;
    double low_a = INFINITY, high_a = -INFINITY, low_b = INFINITY, high_b = -INFINITY;
    for (std::size_t k = 0; k < values[c].size(); ++k) {
      const double own = values[c][k], other = values[z][k];
      if (std::isnan(own) || std::isnan(other)) continue;
      n += 1.0, a += own, b += other, aa += own * own, ab += own * other, bb += other * other;
      low_a = std::min(low_a, own), high_a = std::max(high_a, own);
      low_b = std::min(low_b, other), high_b = std::max(high_b, other);
      apart = std::max(apart, std::fabs(own - other));
    }
    const double range_a = high_a - low_a, range_b = high_b - low_b;
    if (!(range_a > 0.0)) continue;
    out.varying.push_back(static_cast<int>(c));
    const double alike = (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b));
    if (n >= static_cast<double>(kFewest) && std::fabs(alike) > kAlike && range_a < kTimes * range_b &&
        range_b < kTimes * range_a && apart > 0.0 && !out.like_z)
      out.like_z = static_cast<int>(c);
  }
  return out;
}

}  // namespace treadmark::io::profiles
