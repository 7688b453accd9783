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
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/settings/exact_text.hpp"
#include "treadmark/io/settings/key_info.hpp"
#include "treadmark/io/simulations/recording_chainage.hpp"
#include "treadmark/io/simulations/recording_names.hpp"

namespace treadmark::io {

namespace {

using profiles::LineScanner;
using Notes = std::vector<std::string>;

/// The text as UTF-8, with ASCII signs for minus and blank.
std::string as_utf8(std::string_view text) {
  std::string out = profiles::from_utf16(text);
  if (out.empty()) {
    bool valid = true;
    for (std::size_t at = 0; at < text.size() && valid;) {
      const std::size_t length = utf8_length(text.substr(at));
      valid = length > 0;
      at += length;
    }
    if (valid) {
      out = text;
    } else {
      for (const char c : text) {  // Latin-1
        const auto code = static_cast<unsigned char>(c);
        if (code < 0x80u) {
          out += c;
        } else {
          out += static_cast<char>(0xC0u | code >> 6);
          out += static_cast<char>(0x80u | (code & 0x3Fu));
        }
      }
    }
  }
  for (const auto& [sign, plain] : {std::pair{std::string_view("\xE2\x88\x92"), '-'}, {"\xC2\xA0", ' '}})
    for (std::size_t at = out.find(sign); at != std::string::npos; at = out.find(sign, at))
      out.replace(at, sign.size(), 1, plain);
  return out;
}

/// A piece of a line; quoted: it stood in quotes, which are gone.
struct Cell {
  std::string_view text;
  int column = 0;
  bool quoted = false;
};

/// Separators in quotes separate nothing. Empty cells at the end count.
std::vector<Cell> cells_of(std::string_view line, char separator) {
  std::vector<Cell> cells;
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && (line[at] == ' ' || (line[at] == '\t' && separator != '\t'))) ++at;
  };
  for (;;) {
    skip_blanks();
    if (separator == ' ' && at == line.size()) return cells;
    Cell cell{{}, static_cast<int>(at) + 1};
    const std::size_t close = at < line.size() && line[at] == '"' ? line.find('"', at + 1) : std::string_view::npos;
    if (close != std::string_view::npos) {
      cell.text = line.substr(at + 1, close - at - 1);
      cell.quoted = true;
      at = close + 1;
      skip_blanks();
    } else {
      const std::size_t start = at;
      at =
          std::min(line.find_first_of(separator == ' ' ? std::string_view(" \t") : std::string_view(&separator, 1), at),
                   line.size());
      cell.text = line.substr(start, at - start);
      while (!cell.text.empty() && profiles::is_blank(cell.text.back())) cell.text.remove_suffix(1);
    }
    cells.push_back(cell);
    if (separator == ' ') continue;
    if (at >= line.size()) return cells;
    at = line[at] == separator ? at + 1 : line.size();
  }
}

/// Without empty cells at the end.
void trim(std::vector<Cell>& cells) {
  while (!cells.empty() && cells.back().text.empty()) cells.pop_back();
}

/// A column whose numbers are used.
struct Column {
  RecordedColumn meaning;
  std::string name;
  int place = 0;  ///< in the header line, for messages
  std::size_t cell = 0;
};

struct Header {
  int line = 0, lines = 1;
  char separator = ',';
  std::size_t cells = 0;
  std::vector<Column> columns;
  std::vector<Cell> unknown;
  std::vector<std::string> unknown_names;
  bool has(Recorded what) const {
    return std::ranges::any_of(columns, [what](const Column& c) { return c.meaning.what == what; });
  }
  bool has_function() const {
    return has(Recorded::level) || has(Recorded::cross_level) || has(Recorded::cant) || has(Recorded::alignment) ||
           has(Recorded::gauge);
  }
  bool complete() const { return (has(Recorded::distance) || has(Recorded::metres)) && has_function(); }
  std::size_t score() const { return columns.size() + (complete() ? 100 : 0); }
};

/// Names that a blank separates: a unit in brackets belongs to the name before it.
std::vector<std::string> header_names(std::string_view text, char separator, std::vector<Cell>& cells) {
  cells = cells_of(text, separator);
  trim(cells);
  std::vector<std::string> names;
  std::vector<Cell> own;
  for (const Cell& cell : cells) {
    if (separator == ' ' && !names.empty() && (cell.text.starts_with('[') || cell.text.starts_with('('))) {
      names.back().append(" ").append(cell.text);
      continue;
    }
    names.emplace_back(cell.text);
    own.push_back(cell);
  }
  cells = std::move(own);
  return names;
}

Header header_from(const std::vector<std::string>& names, const std::vector<Cell>& cells, int line, char separator) {
  Header header;
  header.line = line;
  header.separator = separator;
  header.cells = names.size();
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k].empty()) continue;
    if (const auto meaning = recorded_column(names[k])) {
      header.columns.push_back({*meaning, names[k], cells[k].column, k});
    } else {
      header.unknown.push_back(cells[k]);
      header.unknown_names.push_back(names[k]);
    }
  }
  return header;
}

/// The line that names most columns, among the first ones; or the first two that do so together.
Header find_header(const std::vector<std::pair<int, std::string_view>>& lines, std::string_view separators) {
  Header best;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const char separator : separators) {
      if (separator != ' ' && lines[i].second.find(separator) == std::string_view::npos) continue;
      std::vector<Cell> cells, below;
      std::vector<std::string> names = header_names(lines[i].second, separator, cells);
      Header one = header_from(names, cells, lines[i].first, separator);
      if (one.score() > best.score()) best = one;
      if (separator == ' ' || i + 1 == lines.size() || names.size() < 2) continue;
      // a name over several columns stands over the first of them
      const std::vector<std::string> more = header_names(lines[i + 1].second, separator, below);
      if (more.size() < names.size()) continue;
      for (std::size_t k = 0; k < more.size(); ++k) {
        if (k >= names.size()) {
          names.emplace_back();
          cells.push_back(below[k]);
        }
        if (names[k].empty() && k > 0) names[k] = names[k - 1];
      }
      for (std::size_t k = 0; k < more.size(); ++k) names[k].append(" ").append(more[k]);
      Header two = header_from(names, cells, lines[i].first, separator);
      two.lines = lines[i + 1].first - lines[i].first + 1;
      if (two.complete() && two.score() > std::max(one.score(), best.score())) best = two;
    }
  return best;
}

/// Blanks separate names only where nothing else does, and comments hold them where no other line does.
Header find_header(const std::vector<std::pair<int, std::string_view>>& lines,
                   const std::vector<std::pair<int, std::string_view>>& comments) {
  Header best;
  for (const auto* from : {&lines, &comments})
    for (const std::string_view separators : {";\t,|", " "}) {
      Header one = find_header(*from, separators);
      if (one.score() > best.score()) best = std::move(one);
      if (best.complete()) return best;
    }
  return best;
}

std::string own_name(const RecordedColumn& c) {
  if (c.what == Recorded::distance || c.what == Recorded::metres) return "distance_m";
  const int f = c.what == Recorded::level                                     ? 0
                : c.what == Recorded::cross_level || c.what == Recorded::cant ? 1
                : c.what == Recorded::alignment                               ? 2
                                                                              : 3;
  return fmt::format("{}{}_mm", kIrregularityNames[static_cast<std::size_t>(f)],
                     c.rail < 0   ? "_left"
                     : c.rail > 0 ? "_right"
                                  : "");
}

void refuse_slips(const LineScanner& line, const Header& header) {
  std::vector<std::string> own{"distance_m"};
  for (const Recorded what : {Recorded::level, Recorded::cross_level, Recorded::alignment, Recorded::gauge})
    for (const int rail : {0, -1, 1}) own.push_back(own_name({what, rail}));
  for (std::size_t k = 0; k < header.unknown.size(); ++k) {
    const std::string name = profiles::lower(header.unknown_names[k]);
    if (names_something_recorded(name)) continue;
    if (const std::string near = nearest_key(name, own); !near.empty())
      line.fail("unknown column " + profiles::printable(name), header.unknown[k].column,
                fmt::format("did you mean {}?", near));
  }
}

/// Of columns with the same meaning: one, or the bands of wavelengths that follow each other.
void choose_among_equals(const LineScanner& line, Header& header, Notes& notes) {
  std::vector<Column>& all = header.columns;
  const auto leave_out = [&](const Column& column, std::string_view why) {
    notes.push_back(fmt::format("{}: {} is not used, {}", line.file(), profiles::printable(column.name), why));
  };
  if (header.has(Recorded::cross_level))
    std::erase_if(all, [&](const Column& c) {
      const bool out = c.meaning.what == Recorded::cant;
      if (out) leave_out(c, "as another column holds the cross level");
      return out;
    });
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t k = i + 1; k < all.size();) {
      const RecordedColumn &a = all[i].meaning, &b = all[k].meaning;
      const bool distance = a.what == Recorded::distance && b.what == Recorded::distance && a.unit != b.unit;
      if (a.what != b.what || a.rail != b.rail || (a.band != b.band && a.band * b.band != 0 && a.band + b.band < 9)) {
        ++k;
        continue;
      }
      const bool by_band = a.band != b.band, by_length = a.longest != b.longest;
      if (!by_band && !by_length && !distance)
        line.fail(fmt::format("two columns hold the {}", own_name(a).substr(0, own_name(a).rfind('_'))), all[k].place,
                  fmt::format("{} and {}", profiles::printable(all[i].name), profiles::printable(all[k].name)));
      // metres before kilometres before no unit, all waves before some, D1 before D0
      const bool second = distance    ? b.unit == 1.0 || a.unit == 0.0
                          : by_band   ? b.band == 0 || (a.band == 9 && b.band != 9)
                          : by_length ? b.longest == 0 || (a.longest != 0 && b.longest > a.longest)
                                      : false;
      leave_out(all[second ? i : k],
                fmt::format("as {} holds the same", profiles::printable(all[second ? k : i].name)));
      if (second) std::swap(all[i], all[k]);
      all.erase(all.begin() + static_cast<std::ptrdiff_t>(k));
    }
}

void check_columns(const LineScanner& line, const Header& header) {
  if (!header.has(Recorded::distance) && !header.has(Recorded::metres))
    line.fail("no column holds the distance", 0, "call it distance_m");
  if (!header.has_function())
    line.fail("no column holds an irregularity", 0,
              "names are longitudinal_level_mm, cross_level_mm, alignment_mm, gauge_mm");
  for (const Recorded what : {Recorded::level, Recorded::alignment}) {
    bool given[3] = {false, false, false};
    for (const Column& c : header.columns)
      if (c.meaning.what == what) given[c.meaning.rail + 1] = true;
    if (given[0] != given[2] && !given[1])
      line.fail(fmt::format("{} is given of the {} rail only", kIrregularityNames[what == Recorded::level ? 0 : 2],
                            given[0] ? "left" : "right"),
                0, "give both rails, or the track");
  }
}

/// Marks of nothing, as words.
bool is_mark(std::string_view text) {
  static constexpr std::string_view kMarks[] = {
      "",  "n/a", "na",  "n.a.", "#n/a", "nan",     "null", "none", "nil",    "-",       "--",      "---",
      "*", "**",  "***", "?",    "void", "invalid", "k.a.", "n.v.", "nodata", "no data", "#value!", "missing"};
  return std::ranges::find(kMarks, profiles::lower(text)) != std::end(kMarks);
}

/// Marks of nothing, as numbers: -9999, 999.9, -99.99, and the ends of whole numbers.
bool is_mark(std::string_view text, double value) {
  for (const double end : {32767.0, 32768.0, 65535.0, 2147483647.0, 2147483648.0})
    if (std::abs(value) == end) return true;
  constexpr double kFar = 1e9;
  if (std::abs(value) >= kFar) return true;
  std::size_t nines = 0, whole = 0;
  bool point = false;
  for (const char c : text) {
    if (c == '9') {
      ++nines;
      if (!point) ++whole;
    } else if (c == '.' || c == ',') {
      point = true;
    } else if (c != '-' && c != '+' && !(c == '0' && point)) {
      return false;
    }
  }
  return whole >= 3 || (whole == 2 && nines >= 4);
}

/// Kilometres and metres, "44+123.4", "km 44+123,4", "K44 + 123": in metres.
std::optional<double> with_plus(std::string_view text, double base) {
  const std::size_t start = text.find_first_of("0123456789-");
  if (start == std::string_view::npos) return std::nullopt;
  for (const char c : text.substr(0, start))
    if (!profiles::is_blank(c) && c != '.' && !(c >= 'A' && c <= 'Z') && !(c >= 'a' && c <= 'z')) return std::nullopt;
  text.remove_prefix(start);
  const std::size_t plus = text.find('+');
  if (plus == std::string_view::npos || plus == 0) return std::nullopt;
  std::string_view left = text.substr(0, plus), right = text.substr(plus + 1);
  while (!left.empty() && profiles::is_blank(left.back())) left.remove_suffix(1);
  while (!right.empty() && profiles::is_blank(right.front())) right.remove_prefix(1);
  double whole = 0.0, rest = 0.0;
  if (right.empty() || right.front() < '0' || right.front() > '9' || !points::parse_number(left, false, whole) ||
      !points::is_whole(whole) || !points::parse_number(right, true, rest))
    return std::nullopt;
  return left.starts_with('-') ? whole * base - rest : whole * base + rest;
}

std::string unit_advice(std::string_view name) {
  return fmt::format("call it {}, or write the unit behind its name in brackets", name);
}

/// Reads one file.
class RecordingReader {
 public:
  RecordingReader(std::string_view text, const std::string& name, const RecordingSettings& settings)
      : text_(as_utf8(text)), name_(name), settings_(settings) {
    rows_.file = name;
  }

  IrregularityTable read(Notes* notes) {
    read_header();
    read_rows();
    settle_units();
    join_kilometres();
    take_nominal_gauge();
    if (!settings_.as_stated) put_in_order(rows_, settings_.sampling, notes_);
    std::vector<std::string> names;
    for (const Column& column : signals_) names.push_back(column.name);
    fill_empty_cells(rows_, names, notes_);
    check_rows();
    IrregularityTable table = track_functions();
    if (notes != nullptr) notes->insert(notes->end(), notes_.begin(), notes_.end());
    return table;
  }

 private:
  void read_header() {
    LineScanner line(text_, name_);
    std::vector<std::pair<int, std::string_view>> plain, comments;
    constexpr std::size_t kLooked = 200;
    std::optional<std::pair<int, points::LineKind>> first;
    while (line.next_line() && plain.size() + comments.size() < kLooked) {
      const points::LineKind kind = points::kind_of_line(line.line());
      if (kind == points::LineKind::empty) continue;
      // ';' before words is a comment elsewhere, here it may end an empty cell
      if (kind == points::LineKind::comment && !line.line().starts_with(';')) {
        comments.emplace_back(line.number(), points::comment_text(line.line()));
        continue;
      }
      if (!first) first.emplace(line.number(), kind);
      plain.emplace_back(line.number(), line.line());
    }
    header_ = find_header(plain, comments);
    LineScanner at(text_, name_);
    const bool none = header_.columns.empty();
    const int place = none && first ? first->first : header_.line;
    while (at.number() < place && at.next_line()) look_at(at);
    if (none && first && first->second == points::LineKind::numbers)
      at.fail("a line with the names of the columns must stand before the numbers", 1,
              "as distance_m,longitudinal_level_mm,cross_level_mm,alignment_mm,gauge_mm");
    refuse_slips(at, header_);
    check_columns(at, header_);
    for (std::size_t k = 0; k < header_.unknown_names.size(); ++k)
      unused_ += (unused_.empty() ? "" : ", ") + profiles::printable(profiles::lower(header_.unknown_names[k]));
    if (!unused_.empty()) notes_.push_back(fmt::format("{}: columns that are not used: {}", name_, unused_));
    choose_among_equals(at, header_, notes_);
    for (const Column& column : header_.columns) {
      if (column.meaning.what == Recorded::distance)
        distance_ = column;
      else if (column.meaning.what == Recorded::metres)
        metres_ = column;
      else
        signals_.push_back(column);
    }
    if (!distance_) std::swap(distance_, metres_);
    rows_.signals.resize(signals_.size());
  }

  /// A line before the names may state the unit, or the nominal gauge.
  void look_at(const LineScanner& line) {
    if (line.number() >= header_.line) return;
    const std::string_view text = points::comment_text(line.line());
    stated_unit_.look_at(text);
    if (const double gauge = stated_gauge(text); gauge > 0.0) stated_gauge_ = gauge;
  }

  /// A line of units below the names. False: it is none.
  bool read_units(const std::vector<Cell>& cells) {
    bool any = false;
    std::vector<std::pair<Column*, double>> found;
    const auto look = [&](Column& column) {
      if (column.cell >= cells.size() || cells[column.cell].text.empty() || cells[column.cell].text == "-") return true;
      const double unit = recorded_unit(cells[column.cell].text);
      found.emplace_back(&column, unit);
      any = any || unit != 0.0;
      return unit != 0.0;
    };
    bool all = look(*distance_) && (!metres_ || look(*metres_));
    for (Column& column : signals_) all = all && look(column);
    if (!any || !all) return false;
    for (const auto& [column, unit] : found) column->meaning.unit = unit;
    return true;
  }

  void read_rows() {
    LineScanner line(text_, name_);
    std::string skipped;
    int skipped_lines = 0;
    bool begun = false;
    while (line.next_line()) {
      if (line.number() < header_.line + header_.lines) continue;
      const points::LineKind kind = points::kind_of_line(line.line());
      if (kind == points::LineKind::empty) continue;
      if (kind == points::LineKind::comment && !line.line().starts_with("#N/A")) continue;
      std::vector<Cell> cells = cells_of(line.line(), header_.separator);
      const std::size_t before = cells.size();
      trim(cells);
      if (cells.empty()) continue;
      if (!begun && read_units(cells)) {
        begun = true;
        continue;
      }
      if (holds_no_number(cells)) {
        if (skipped.empty()) skipped = fmt::format("line {}: {}", line.number(), profiles::printable(line.line()));
        ++skipped_lines;
        continue;
      }
      begun = true;
      const bool fits = cells.size() == header_.cells || (cells.size() < header_.cells && before >= header_.cells);
      if (!fits)
        line.fail(fmt::format("the line has {} fields, {} columns have names", cells.size(), header_.cells),
                  cells.back().column,
                  header_.separator == ',' && cells.size() > header_.cells
                      ? "numbers with decimal commas are separated by semicolons, or stand in quotes"
                      : "");
      cells.resize(header_.cells);
      read_row(line, cells);
    }
    if (skipped_lines > 0)
      notes_.push_back(
          fmt::format("{}: lines without numbers, passed over: {}, first {}", name_, skipped_lines, skipped));
    if (marks_ > 0) notes_.push_back(fmt::format("{}: marks of nothing such as {}: {}", name_, mark_, marks_));
  }

  /// Titles, names again, feet of tables: every cell is a word.
  static bool holds_no_number(const std::vector<Cell>& cells) {
    bool mark = false;
    for (const Cell& cell : cells) {
      double value = 0.0;
      if (points::parse_number(cell.text, true, value) || with_plus(cell.text, 1.0)) return false;
      mark = mark || (!cell.text.empty() && is_mark(cell.text));
    }
    return !mark;
  }

  /// NaN for a mark of nothing.
  double number(const LineScanner& line, const Cell& cell) {
    double value = 0.0;
    if (points::parse_number(cell.text, header_.separator != ',' || cell.quoted, value) && std::isfinite(value))
      return value;
    if (!is_mark(cell.text) && std::isfinite(value))
      line.fail("a number is expected, this is " + profiles::printable(cell.text), cell.column);
    count_mark(cell.text);
    return kNaN;
  }

  void count_mark(std::string_view text) {
    if (marks_++ == 0) mark_ = text.empty() ? "an empty cell" : profiles::printable(text);
  }

  double distance(const LineScanner& line, const Column& column, const Cell& cell) {
    constexpr double kKilometre = 1e3, kFeet = 0.3048, kStation = 100.0, kFarthest = 1e9;
    const bool feet = column.meaning.unit == kFeet;
    if (const auto metres = with_plus(cell.text, feet ? kStation : kKilometre)) {
      plus_ = true;
      return feet ? *metres * kFeet : *metres;
    }
    const double metres = number(line, cell) * (column.meaning.unit == 0.0 ? 1.0 : column.meaning.unit);
    if (std::abs(metres) > kFarthest) line.fail("no track is a million kilometres long", cell.column);
    return metres;
  }

  void read_row(const LineScanner& line, const std::vector<Cell>& cells) {
    rows_.lines.push_back(line.number());
    rows_.distance.push_back(distance(line, *distance_, cells[distance_->cell]));
    if (metres_) behind_.push_back(distance(line, *metres_, cells[metres_->cell]));
    for (std::size_t s = 0; s < signals_.size(); ++s) {
      const Column& column = signals_[s];
      const Cell& cell = cells[column.cell];
      double value = number(line, cell);
      if (is_mark(cell.text, value)) {
        count_mark(cell.text);
        value = kNaN;
      }
      value *= column.meaning.unit == 0.0 ? 1.0 : column.meaning.unit;
      if (column.meaning.what != Recorded::gauge && column.meaning.unit != 0.0 &&
          std::abs(value) > kLargestIrregularity)
        line.fail(fmt::format("{} = {:.6g} mm is more than {:g} mm", function_name(column), value * kMilli,
                              kLargestIrregularity * kMilli),
                  cell.column, "look at the unit in the name of the column");
      rows_.signals[s].push_back(value);
      if (column.meaning.what == Recorded::gauge) gauge_places_.push_back(cell.column);
    }
  }

  static std::string function_name(const Column& column) {
    const std::string name = own_name(column.meaning);
    return name.substr(0, name.rfind('_'));
  }

  static double median(std::vector<double> values) {
    std::erase_if(values, [](double v) { return std::isnan(v); });
    if (values.empty()) return kNaN;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
  }

  static void scale(std::vector<double>& values, double unit) {
    for (double& value : values) value *= unit;
  }

  /// Units that nothing states.
  void settle_units() {
    settle_distance();
    std::optional<double> by_gauge;
    for (std::size_t s = 0; s < signals_.size(); ++s) {
      if (signals_[s].meaning.what != Recorded::gauge || signals_[s].meaning.unit != 0.0) continue;
      constexpr double kNarrow = 0.5, kWide = 1.8, kSpread = 0.02;  // [m]
      const double whole = median(rows_.signals[s]);
      std::vector<double> beside = rows_.signals[s];
      for (double& value : beside) value = std::abs(value - whole);
      for (const double unit : {kMillimetre, 0.1 * kMillimetre, 0.01 * kMillimetre})
        if (whole * unit > kNarrow && whole * unit < kWide && median(beside) * unit < kSpread) by_gauge = unit;
    }
    bool assumed = false;
    for (std::size_t s = 0; s < signals_.size(); ++s) {
      RecordedColumn& meaning = signals_[s].meaning;
      if (meaning.unit != 0.0) continue;
      if (const auto unit = stated_unit_.unit())
        meaning.unit = metres_per(*unit);
      else if (by_gauge)
        meaning.unit = *by_gauge, assumed = true;
      else
        throw Error(ErrorKind::input_data, fmt::format("the column {} has no unit", signals_[s].name),
                    {name_, header_.line, signals_[s].place}, unit_advice(own_name(meaning)));
      scale(rows_.signals[s], meaning.unit);
    }
    if (assumed)
      notes_.push_back(
          fmt::format("{}: no units are stated; the gauge shows that they are {:g} mm", name_, *by_gauge * kMilli));
  }

  /// Rows lie 0.02 to 10 m apart: that tells metres, kilometres and millimetres from each other.
  void settle_distance() {
    if (distance_->meaning.unit != 0.0 || plus_ || rows_.distance.size() < 2) return;
    std::vector<double> by;
    for (std::size_t i = 1; i < rows_.distance.size(); ++i)
      by.push_back(std::abs(rows_.distance[i] - rows_.distance[i - 1]));
    std::erase(by, 0.0);
    const double step = median(by);
    const bool count = std::abs(step - 1.0) < 1e-9 && rows_.distance.front() <= 1.0 && rows_.distance.front() >= 0.0 &&
                       settings_.sampling == 0.0;
    if (count && points::is_whole(rows_.distance.front()))
      throw Error(ErrorKind::input_data, fmt::format("the column {} may count the rows", distance_->name),
                  {name_, header_.line, distance_->place},
                  "write its unit behind its name, or give irregularities.sampling_m");
    constexpr double kShort = 0.02, kLong = 10.0;
    for (const auto& [unit, symbol] : {std::pair{1.0, "m"}, {1e3, "km"}, {kMillimetre, "mm"}})
      if (step * unit >= kShort && step * unit <= kLong) {
        distance_->meaning.unit = unit;
        scale(rows_.distance, unit);
        notes_.push_back(
            fmt::format("{}: the distance has no unit; rows {:.6g} apart are taken as {}", name_, step, symbol));
        return;
      }
    throw Error(ErrorKind::input_data, fmt::format("the column {} has no unit", distance_->name),
                {name_, header_.line, distance_->place}, unit_advice("distance_m"));
  }

  /// Whole kilometres and metres in two columns.
  void join_kilometres() {
    if (!metres_) return;
    constexpr double kKilometre = 1e3, kLongestKilometre = 2e3;
    const bool whole = std::ranges::all_of(rows_.distance, [](double d) {
      return std::isnan(d) || std::abs(d / kKilometre - std::round(d / kKilometre)) < 1e-9;
    });
    const bool behind =
        std::ranges::all_of(behind_, [](double d) { return std::isnan(d) || (d >= 0.0 && d <= kLongestKilometre); });
    if (whole && behind) {
      for (std::size_t i = 0; i < behind_.size(); ++i) rows_.distance[i] += behind_[i];
    } else {
      notes_.push_back(fmt::format("{}: {} is not used, as {} holds the distance", name_,
                                   profiles::printable(metres_->name), profiles::printable(distance_->name)));
    }
  }

  /// A gauge such as 1436.2 mm as what lies beyond the nominal one.
  void take_nominal_gauge() {
    for (std::size_t s = 0; s < signals_.size(); ++s) {
      if (signals_[s].meaning.what != Recorded::gauge) continue;
      std::vector<double>& gauge = rows_.signals[s];
      const double whole = median(gauge);
      double nominal = 0.0;
      if (whole > kLargestIrregularity) {
        std::ranges::replace(gauge, 0.0, kNaN);  // no track has a gauge of 0
        nominal = nominal_gauge(signals_[s].meaning, whole);
      }
      constexpr double kFarthest = 0.1;  // from a nominal gauge
      const double most = nominal > 0.0 ? kFarthest : kLargestIrregularity;
      for (std::size_t i = 0; i < gauge.size(); ++i) {
        if (std::abs(gauge[i] - nominal) > most)
          throw Error(ErrorKind::input_data,
                      nominal > 0.0
                          ? fmt::format("gauge = {:.6g} mm is more than {:g} mm from {:.6g} mm", gauge[i] * kMilli,
                                        most * kMilli, nominal * kMilli)
                          : fmt::format("gauge = {:.6g} mm is more than {:g} mm", gauge[i] * kMilli, most * kMilli),
                      {name_, rows_.lines[i], gauge_places_[i]},
                      nominal > 0.0 ? "" : "the gauge is that beyond the gauge of the line");
        gauge[i] -= nominal;
      }
    }
  }

  double nominal_gauge(const RecordedColumn& column, double whole) {
    constexpr double kNear = 0.04;
    static constexpr double kInUse[] = {0.600, 0.610, 0.750, 0.760, 0.762, 0.891, 0.914, 0.950, 1.000,
                                        1.067, 1.372, 1.435, 1.520, 1.524, 1.600, 1.668, 1.676};
    const double named = column.nominal * (column.nominal > 2.0 ? kMillimetre : 1.0),
                 nearest = *std::ranges::min_element(kInUse, {}, [&](double g) { return std::abs(g - whole); });
    const bool of_track = settings_.track_gauge > 0.0 && std::abs(settings_.track_gauge - whole) <= kNear;
    double nominal = nearest;
    std::string_view by = "the nearest gauge in use; irregularities.nominal_gauge_mm sets another";
    if (settings_.nominal_gauge > 0.0)
      nominal = settings_.nominal_gauge, by = "by irregularities.nominal_gauge_mm";
    else if (named > 0.0 || stated_gauge_ > 0.0)
      nominal = named > 0.0 ? named : stated_gauge_, by = "as the file states";
    else if (of_track)
      nominal = settings_.track_gauge, by = "that of the track";
    if (std::abs(nominal - whole) > kNear)
      throw Error(ErrorKind::input_data,
                  fmt::format("the gauge is about {:.6g} mm, its nominal value {:.6g} mm ({})", whole * kMilli,
                              nominal * kMilli, by),
                  {name_, header_.line, 0}, "give irregularities.nominal_gauge_mm");
    notes_.push_back(
        fmt::format("{}: the gauge is a whole one, about {:.6g} mm; what lies beyond {:.6g} mm is used ({})", name_,
                    whole * kMilli, nominal * kMilli, by));
    if (settings_.track_gauge > 0.0 && std::abs(settings_.track_gauge - nominal) > 0.5 * kMillimetre)
      notes_.push_back(fmt::format("{}: a recording of a track of {:.6g} mm, used on one of {:.6g} mm", name_,
                                   nominal * kMilli, settings_.track_gauge * kMilli));
    return nominal;
  }

  void check_rows() {
    const std::vector<double>& d = rows_.distance;
    constexpr std::size_t kLeast = 4;
    if (d.size() < kLeast)
      throw Error(ErrorKind::input_data,
                  fmt::format("the file has {} lines of numbers, at least {} are needed", d.size(), kLeast),
                  {name_, 0, 0});
    for (std::size_t i = 1; i < d.size(); ++i)
      if (!(d[i] > d[i - 1]))
        rows_.fail(i, fmt::format("the distance goes from {:.10g} to {:.10g} m, it must increase", d[i - 1], d[i]));
  }

  /// The column of a quantity, bands of wavelengths added; empty: there is none.
  std::vector<double> signal(Recorded what, int rail) {
    std::vector<double> sum;
    std::string bands;
    int count = 0;
    for (std::size_t s = 0; s < signals_.size(); ++s) {
      if (signals_[s].meaning.what != what || signals_[s].meaning.rail != rail) continue;
      if (count++ == 0)
        sum = rows_.signals[s];
      else
        std::ranges::transform(sum, rows_.signals[s], sum.begin(), std::plus<>());
      bands += (bands.empty() ? "" : " + ") + profiles::printable(signals_[s].name);
    }
    if (count > 1)
      notes_.push_back(fmt::format("{}: {} are bands of wavelengths that follow each other: added", name_, bands));
    return sum;
  }

  /// How alike two functions change from row to row, -1 to 1; nothing where one of them hardly changes.
  static std::optional<double> likeness(const std::vector<double>& a, const std::vector<double>& b) {
    double aa = 0.0, bb = 0.0, ab = 0.0;
    for (std::size_t i = 1; i < a.size(); ++i) {
      const double da = a[i] - a[i - 1], db = b[i] - b[i - 1];
      aa += da * da;
      bb += db * db;
      ab += da * db;
    }
    constexpr double kResolution = 1e-5;  // of recordings [m]
    const double least = kResolution * kResolution * static_cast<double>(a.size());
    if (aa < least || bb < least) return std::nullopt;
    return ab / std::sqrt(aa * bb);
  }

  /// Function of the track and difference of the rails, from what is there. Returns how the difference agrees.
  std::optional<double> join(Recorded what, std::vector<double> difference, IrregularityTable& table) {
    const std::size_t index = what == Recorded::level ? 0 : 2;
    const std::vector<double> track = signal(what, 0), left = signal(what, -1), right = signal(what, 1);
    table.values[index] = track;
    table.values[index + 1] = std::move(difference);
    if (left.empty() || right.empty()) return std::nullopt;
    std::vector<double> mean(left.size()), apart(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      mean[i] = 0.5 * (left[i] + right[i]);
      apart[i] = right[i] - left[i];
    }
    constexpr double kAlike = 0.9;
    if (track.empty())
      table.values[index] = mean;
    else if (const auto like = likeness(track, mean); like && *like < kAlike)
      notes_.push_back(
          fmt::format("{}: DOUBT: {} of the track is not the mean of its rails (correlation {:.2f}); the "
                      "column of the track is used",
                      name_, kIrregularityNames[index], *like));
    if (!table.values[index + 1].empty()) return likeness(table.values[index + 1], apart);
    table.values[index + 1] = apart;
    return std::nullopt;
  }

  void tell_agreement(std::size_t index, std::optional<double> like, bool exchanged) {
    if (!like) return;
    constexpr double kAlike = 0.5;
    const std::string_view rails = kIrregularityNames[index], other = kIrregularityNames[index + 1];
    if (*like > kAlike)
      notes_.push_back(
          fmt::format("{}: {} stands beside {} of both rails and agrees with them (correlation {:.2f}): the "
                      "mean of the rails and the column of {} are used",
                      name_, other, rails, *like, other));
    else if (*like < -kAlike && exchanged)
      notes_.push_back(
          fmt::format("{}: left and right seem to be exchanged in {}: {} has the other sign (correlation "
                      "{:.2f}); the mean of the rails and the column of {} are used",
                      name_, rails, other, *like, other));
    else if (*like < -kAlike)
      notes_.push_back(
          fmt::format("{}: DOUBT: {} and {} have opposite signs (correlation {:.2f} of right less left rail with {}): "
                      "compare a known "
                      "place and give {}_factor = -1{}",
                      name_, rails, other, *like, other, rails,
                      index == 0 ? fmt::format(" or {}_factor = -1", other) : std::string()));
    else
      notes_.push_back(
          fmt::format("{}: DOUBT: {} does not follow from {} of both rails (correlation {:.2f}); the mean of "
                      "the rails and the column of {} are used",
                      name_, other, rails, *like, other));
  }

  IrregularityTable track_functions() {
    IrregularityTable table;
    table.distance = rows_.distance;
    std::vector<double> cross = signal(Recorded::cross_level, 0);
    if (cross.empty()) cross = signal(Recorded::cant, 0);
    constexpr double kCanted = 0.03;  // more is the cant of a curve
    if (!cross.empty())
      if (const double most = std::abs(*std::ranges::max_element(cross, {}, [](double v) { return std::abs(v); }));
          most > kCanted)
        notes_.push_back(
            fmt::format("{}: the cross level reaches {:.4g} mm: it seems to hold the cant of curves, which "
                        "[layout] must not have again",
                        name_, most * kMilli));
    const std::optional<double> level = join(Recorded::level, std::move(cross), table),
                                sides = join(Recorded::alignment, signal(Recorded::gauge, 0), table);
    const bool exchanged = level && sides && *level < 0.0 && *sides < 0.0;
    tell_agreement(0, level, exchanged);
    tell_agreement(2, sides, exchanged);
    if (settings_.seen_backwards)
      for (const std::size_t turned : {1u, 2u})
        for (double& value : table.values[turned]) value = -value;
    return table;
  }

  const std::string text_, name_;
  const RecordingSettings settings_;
  Notes notes_;
  Header header_;
  std::string unused_;
  points::UnitFinder stated_unit_;
  double stated_gauge_ = 0.0;
  std::optional<Column> distance_, metres_;
  std::vector<Column> signals_;
  std::vector<double> behind_;  ///< numbers of metres_
  RecordedRows rows_;
  std::vector<int> gauge_places_;  ///< columns of the cells, for messages
  bool plus_ = false;
  std::size_t marks_ = 0;
  std::string mark_;
};

}  // namespace

IrregularityTable parse_irregularity_text(std::string_view text, const std::string& name, Notes* notes,
                                          const RecordingSettings& settings) {
  return RecordingReader(text, name, settings).read(notes);
}

IrregularityTable read_irregularity_file(const std::filesystem::path& file, Notes* notes,
                                         const RecordingSettings& settings) {
  return parse_irregularity_text(read_text(file), file.string(), notes, settings);
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
