// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_irregularities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/settings/exact_text.hpp"
#include "treadmark/io/simulations/recording_chainage.hpp"
#include "treadmark/io/simulations/recording_functions.hpp"
#include "treadmark/io/simulations/recording_header.hpp"

namespace treadmark::io::recording {

namespace {

using profiles::LineScanner;
using Notes = std::vector<std::string>;

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
    IrregularityTable table = functions_of(rows_, signals_, settings_.seen_backwards, notes_);
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
    for (const std::string& unknown : header_.unknown_names)
      unused_ += (unused_.empty() ? "" : ", ") + profiles::printable(profiles::lower(unknown));
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
        line.fail(fmt::format("{} = {:.6g} mm is more than {:g} mm", function_name(column.meaning), value * kMilli,
                              kLargestIrregularity * kMilli),
                  cell.column, "look at the unit in the name of the column");
      rows_.signals[s].push_back(value);
      if (column.meaning.what == Recorded::gauge) gauge_places_.push_back(cell.column);
    }
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
    const bool whole = ranges::all_of(rows_.distance, [](double d) {
      return std::isnan(d) || std::abs(d / kKilometre - std::round(d / kKilometre)) < 1e-9;
    });
    const bool behind =
        ranges::all_of(behind_, [](double d) { return std::isnan(d) || (d >= 0.0 && d <= kLongestKilometre); });
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
        ranges::replace(gauge, 0.0, kNaN);  // no track has a gauge of 0
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
                 nearest = *ranges::min_element(kInUse, {}, [&](double g) { return std::abs(g - whole); });
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

}  // namespace treadmark::io::recording

namespace treadmark::io {

IrregularityTable parse_irregularity_text(std::string_view text, const std::string& name,
                                          std::vector<std::string>* notes, const RecordingSettings& settings) {
  return recording::RecordingReader(text, name, settings).read(notes);
}

IrregularityTable read_irregularity_file(const std::filesystem::path& file, std::vector<std::string>* notes,
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
