// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/scans/column_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/points/line_blocks.hpp"
#include "treadmark/io/points/unit_words.hpp"

namespace treadmark::io::scans {

using profiles::printable;

namespace {

constexpr std::size_t kHead = 1'000'000;   ///< bytes that are looked at
constexpr std::size_t kSampleLines = 200;  ///< lines of numbers that are looked at

struct Head {
  struct Line {
    std::string text;
    int number;
  };
  std::vector<Line> comments, words;  ///< before the points
  std::vector<std::string> points;
  int first_points = 0, count_line = 0;
  UnitFinder unit;
};

/// What stands between two signs that may separate.
std::vector<std::string_view> pieces_of(std::string_view line) {
  std::vector<std::string_view> out;
  constexpr std::string_view kSeparators = " \t\v\f,;";
  for (std::size_t at = line.find_first_not_of(kSeparators); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSeparators, at), line.size());
    out.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSeparators, end);
  }
  return out;
}

bool is_count(std::string_view line) {
  const std::vector<Field> fields = fields_of(line, ' ');
  return fields.size() == 1 && fields[0].text.find_first_not_of("0123456789") == std::string_view::npos;
}

Head look(ByteBlocks& bytes) {
  bytes.want(kHead);
  const std::string_view text = bytes.window().substr(0, kHead);
  ByteBlocks start(text, bytes.file());
  LineBlocks lines(start);
  Head head;
  std::string_view line;
  while (head.points.size() < kSampleLines && lines.next(line)) {
    // the last line of the sample may be cut
    if (start.left() == 0 && text.size() < bytes.left() && !head.points.empty()) break;
    switch (kind_of_line(line)) {
      case LineKind::empty:
        break;
      case LineKind::comment:
        head.unit.look_at(comment_text(line));
        if (head.points.empty()) head.comments.push_back({std::string(comment_text(line)), lines.number()});
        break;
      case LineKind::words:
        if (is_lost_row(line)) break;
        if (!head.points.empty()) return head;  // the reader stops there with an error
        head.words.push_back({std::string(line), lines.number()});
        break;
      case LineKind::numbers:
        if (head.points.empty() && head.count_line == 0 && is_count(line)) {
          head.count_line = lines.number();
          break;
        }
        if (head.points.empty()) head.first_points = lines.number();
        head.points.emplace_back(without_comment(line));
    }
  }
  return head;
}

/// Whether the columns from `first` on are unit vectors in the sample; zero vectors say nothing.
bool are_normals(const std::vector<std::string>& lines, const FieldStyle& style, std::size_t first) {
  constexpr double kTolerance = 0.01;
  bool any = false;
  for (const std::string& line : lines) {
    const std::vector<Field> fields = fields_of(line, style.separator);
    double square = 0.0;
    for (std::size_t k = first; k < first + 3; ++k) {
      double value = 0.0;
      if (k >= fields.size() || !parse_number(fields[k].text, style.decimal_comma, value)) return false;
      square += value * value;
    }
    if (square == 0.0 || std::isnan(square)) continue;
    if (std::abs(std::sqrt(square) - 1.0) > kTolerance) return false;
    any = true;
  }
  return any;
}

/// Which columns of lines hold numbers, but for marks of nothing.
class NumberColumns {
 public:
  NumberColumns(const FieldStyle& style, std::size_t columns) : style_(style), what_(columns, kNothing) {}

  void add(std::string_view line) {
    const std::vector<Field> fields = fields_of(line, style_.separator);
    for (std::size_t k = 0; k < std::min(what_.size(), fields.size()); ++k) {
      double value = 0.0;
      if (what_[k] == kText || is_nothing(fields[k].text)) continue;
      what_[k] = parse_number(fields[k].text, style_.decimal_comma, value) ? kNumber : kText;
    }
  }
  std::vector<std::size_t> columns() const {
    std::vector<std::size_t> out;
    for (std::size_t k = 0; k < what_.size(); ++k)
      if (what_[k] == kNumber) out.push_back(k);
    return out;
  }

 private:
  enum What : std::uint8_t { kNothing, kNumber, kText };
  FieldStyle style_;
  std::vector<What> what_;
};

/// The roles of columns without names: the first three with numbers are x y z.
void assume_columns(ColumnLayout& layout, std::size_t columns, const std::vector<std::string>& points) {
  layout.value.assign(columns, -1);
  NumberColumns of_sample(layout.style, columns);
  for (const std::string& line : points) of_sample.add(line);
  std::vector<std::size_t> numbers = of_sample.columns();
  constexpr std::size_t kCoordinates = 3;
  if (numbers.size() < kCoordinates) numbers = {0, 1, 2};  // the reader says what is no number
  for (std::size_t k = 0; k < kCoordinates; ++k) layout.value[numbers[k]] = static_cast<int>(k);
  if (columns == 6 && are_normals(points, layout.style, 3)) {
    for (int k = 3; k < 6; ++k) layout.value[static_cast<std::size_t>(k)] = k;
    layout.normals = true;
    layout.in_words = "columns x y z nx ny nz (assumed: no names, unit vectors)";
  } else if (columns == 3) {
    layout.in_words = "columns x y z (assumed: no names)";
  } else {
    layout.in_words = fmt::format("columns x y z and {} ignored (assumed: no names)", columns - 3);
  }
}

void take_names(ColumnLayout& layout, const ColumnNames& names) {
  layout.value = names.value;
  layout.normals = names.has_normals;
  layout.pass = names.passes > 0;
  layout.intensity = names.has_intensity;
  layout.loose_pass = names.loose_pass;
  layout.in_words = "columns";
  constexpr std::string_view kNames[] = {"x", "y", "z", "nx", "ny", "nz", "pass", "intensity"};
  int ignored = 0;
  for (const int v : layout.value) {
    if (v < 0)
      ++ignored;
    else
      layout.in_words.append(" ").append(kNames[v]);
  }
  if (ignored > 0) layout.in_words += fmt::format(" and {} ignored", ignored);
}

/// The names of a line that has as many as there are columns, cut at the separator of the numbers or at another.
std::optional<ColumnNames> match(std::string_view line, char separator, std::size_t columns) {
  for (const char s : {separator, ',', ';', '\t', ' '}) {
    const std::vector<std::string> names = names_in(line, s);
    if (names.size() != columns) continue;
    ColumnNames found = find_names(names);
    if (found.has_xyz) return found;
  }
  return std::nullopt;
}

/// The names in the lines before the points: of the last line of words that has them, else of the last such comment.
/// with_empty: columns of the first line of points where empty ones at its end count.
std::optional<ColumnNames> names_of(const Head& head, char separator, std::size_t columns, std::size_t with_empty,
                                    const std::string& file) {
  const auto check = [&](const ColumnNames& names, int line) {
    if (names.twice)
      throw Error(ErrorKind::input_data, "a coordinate is named twice", {file, line, 0}, "name columns x, y, z once");
    if (names.units_differ)
      throw Error(ErrorKind::input_data, "the columns of coordinates have different units", {file, line, 0},
                  "write x, y and z in the same unit");
  };
  for (auto line = head.words.rbegin(); line != head.words.rend(); ++line)
    for (const std::size_t number : {columns, with_empty})
      if (const std::optional<ColumnNames> names = match(line->text, separator, number)) {
        check(*names, line->number);
        return names;
      }
  if (!head.words.empty()) {
    const Head::Line& line = head.words.front();
    const std::size_t found = names_in(line.text, separator).size();
    throw Error(ErrorKind::input_data,
                fmt::format("neither numbers nor {} names of columns with x, y and z among them, this is {}", columns,
                            printable(line.text)),
                {file, line.number, 1},
                found > 1 ? fmt::format("it has {} names", found) : "put a # before it, or name the columns");
  }
  for (auto line = head.comments.rbegin(); line != head.comments.rend(); ++line)
    if (const std::optional<ColumnNames> names = match(line->text, separator, columns)) {
      check(*names, line->number);
      return names;
    }
  return std::nullopt;
}

/// Lines that begin with text, such as labels or times, and hold three numbers or more in the same columns, all of
/// them: they are the points then. False if there are none.
bool take_rows_with_text(Head& head, FieldStyle& style) {
  constexpr std::size_t kFewestLines = 2, kFewestColumns = 4;
  if (!head.points.empty() || head.words.size() < kFewestLines) return false;
  for (const char separator : {';', '\t', ',', ' '})
    for (const bool decimal_comma : {false, true}) {
      if (decimal_comma && separator == ',') continue;
      const FieldStyle tried{separator, decimal_comma};
      const std::size_t columns = fields_of(head.words.back().text, separator).size();
      if (columns < kFewestColumns) continue;
      // back to where the lines are of another kind
      std::size_t first = head.words.size();
      NumberColumns numbers(tried, columns);
      while (first > 0 && fields_of(head.words[first - 1].text, separator).size() == columns) {
        numbers.add(head.words[first - 1].text);
        if (numbers.columns().size() < kFewestColumns - 1) break;
        --first;
      }
      if (head.words.size() - first < kFewestLines) continue;
      for (std::size_t k = first; k < std::min(head.words.size(), first + kSampleLines); ++k)
        head.points.push_back(head.words[k].text);
      head.first_points = head.words[first].number;
      head.words.resize(first);
      style = tried;
      return true;
    }
  return false;
}

}  // namespace

bool is_nothing(std::string_view text) {
  constexpr std::string_view kMarks[] = {"",    "-",    "--",      "---",    "n/a", "na", "#n/a", "null", "none",
                                         "nil", "void", "invalid", "nodata", "*",   "**", "***",  "?"};
  const std::string small = profiles::lower(text);
  return std::find(std::begin(kMarks), std::end(kMarks), small) != std::end(kMarks);
}

bool is_lost_row(std::string_view line) {
  const std::vector<std::string_view> pieces = pieces_of(line);
  constexpr std::size_t kFewest = 3;
  if (pieces.size() < kFewest || !is_nothing(pieces.front())) return false;
  return std::all_of(pieces.begin(), pieces.end(), [](std::string_view piece) {
    double value = 0.0;
    return is_nothing(piece) || parse_number(piece, false, value);
  });
}

ColumnLayout find_layout(ByteBlocks& bytes) {
  Head head = look(bytes);
  ColumnLayout layout;
  layout.text_first = take_rows_with_text(head, layout.style);
  const std::string& file = bytes.file();
  if (head.points.empty()) {
    if (!head.words.empty())
      throw Error(ErrorKind::input_data, "numbers are expected, this is " + printable(head.words.front().text),
                  {file, head.words.front().number, 1}, "is it a file of points?");
    throw Error(ErrorKind::input_data, "the file holds no points", {file, 0, 0}, "is it the right file?");
  }
  if (!layout.text_first) layout.style = find_style(head.points);
  const std::string& first = head.points.front();
  const std::size_t columns = fields_of(first, layout.style.separator).size();
  const auto with_empty =
      layout.style.separator == ' '
          ? columns
          : 1 + static_cast<std::size_t>(std::count(first.begin(), first.end(), layout.style.separator));
  if (columns < 3)
    throw Error(ErrorKind::input_data, fmt::format("a point needs at least three columns, the line has {}", columns),
                {file, head.first_points, 1}, "is it a file of points?");
  layout.unit = head.unit.unit();
  if (const std::optional<ColumnNames> names = names_of(head, layout.style.separator, columns, with_empty, file)) {
    take_names(layout, *names);
    if (names->unit) layout.unit = names->unit;  // names count more than comments
  } else {
    assume_columns(layout, columns, head.points);
  }
  layout.count_first = head.count_line > 0;
  layout.first_points = layout.count_first ? std::min(head.count_line, head.first_points) : head.first_points;
  layout.in_words += ", " + layout.style.in_words();
  return layout;
}

namespace {

struct Known {
  std::string_view name;  ///< small letters and digits only
  int value;
  bool loose = false;
};

constexpr Known kKnown[] = {{"x", 0},
                            {"xcoord", 0},
                            {"xcoordinate", 0},
                            {"coordx", 0},
                            {"xpos", 0},
                            {"posx", 0},
                            {"pointx", 0},
                            {"points0", 0},
                            {"y", 1},
                            {"ycoord", 1},
                            {"ycoordinate", 1},
                            {"coordy", 1},
                            {"ypos", 1},
                            {"posy", 1},
                            {"pointy", 1},
                            {"points1", 1},
                            {"z", 2},
                            {"zcoord", 2},
                            {"zcoordinate", 2},
                            {"coordz", 2},
                            {"zpos", 2},
                            {"posz", 2},
                            {"pointz", 2},
                            {"points2", 2},
                            {"nx", 3},
                            {"normalx", 3},
                            {"xnormal", 3},
                            {"normals0", 3},
                            {"ny", 4},
                            {"normaly", 4},
                            {"ynormal", 4},
                            {"normals1", 4},
                            {"nz", 5},
                            {"normalz", 5},
                            {"znormal", 5},
                            {"normals2", 5},
                            {"pass", 6},
                            {"passid", 6},
                            {"passno", 6},
                            {"passnumber", 6},
                            {"scan", 6},
                            {"scanid", 6},
                            {"scanno", 6},
                            {"scannumber", 6},
                            {"pointsourceid", 6},
                            {"line", 6, true},
                            {"lineid", 6, true},
                            {"lineno", 6, true},
                            {"linenumber", 6, true},
                            {"intensity", 7},
                            {"reflectance", 7}};

}  // namespace

ColumnNames find_names(const std::vector<std::string>& names) {
  ColumnNames result;
  result.value.assign(names.size(), -1);
  std::array<int, ColumnLayout::kValues> count{};
  UnitFinder unit;
  int pass_column = -1;
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::string_view name = names[k];
    const std::optional<LengthUnit> own_unit = take_unit(name);
    std::string plain = profiles::lower(name);
    std::erase_if(plain, [](char c) { return !((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')); });
    const auto known =
        std::find_if(std::begin(kKnown), std::end(kKnown), [&](const Known& n) { return n.name == plain; });
    if (known == std::end(kKnown)) continue;
    if (known->value == ColumnLayout::kPass) {
      // the first that is certain counts, else the first that may be
      if (pass_column >= 0 && !(result.loose_pass && !known->loose)) continue;
      if (pass_column >= 0) result.value[static_cast<std::size_t>(pass_column)] = -1;
      pass_column = static_cast<int>(k);
      result.loose_pass = known->loose;
      ++result.passes;
    } else if (known->value == ColumnLayout::kIntensity) {
      if (result.has_intensity) continue;
      result.has_intensity = true;
    } else if (++count[static_cast<std::size_t>(known->value)] > 1) {
      result.twice = true;
    }
    result.value[k] = known->value;
    if (known->value < 3) unit.add(own_unit);
  }
  result.has_xyz = count[0] > 0 && count[1] > 0 && count[2] > 0;
  result.has_normals = count[3] > 0 && count[4] > 0 && count[5] > 0;
  if (!result.has_normals)
    for (int& v : result.value)
      if (v >= 3 && v < ColumnLayout::kPass) v = -1;
  result.unit = unit.unit();
  result.units_differ = unit.differ();
  return result;
}

}  // namespace treadmark::io::scans
