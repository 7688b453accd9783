// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/recording_header.hpp"

#include <fmt/format.h>

#include "treadmark/io/settings/key_info.hpp"
#include "treadmark/model/vehicle/irregularities.hpp"

namespace treadmark::io::recording {

namespace {

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
Header best_header(const std::vector<NumberedLine>& lines, std::string_view separators) {
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

}  // namespace

Header find_header(const std::vector<NumberedLine>& lines, const std::vector<NumberedLine>& comments) {
  Header best;
  for (const auto* from : {&lines, &comments})
    for (const std::string_view separators : {";\t,|", " "}) {
      Header one = best_header(*from, separators);
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

std::string function_name(const RecordedColumn& column) {
  const std::string name = own_name(column);
  return name.substr(0, name.rfind('_'));
}

void refuse_slips(const profiles::TextLine& line, const Header& header) {
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

void choose_among_equals(const profiles::TextLine& line, Header& header, std::vector<std::string>& notes) {
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
        line.fail(fmt::format("two columns hold the {}", function_name(a)), all[k].place,
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

void check_columns(const profiles::TextLine& line, const Header& header) {
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

}  // namespace treadmark::io::recording
