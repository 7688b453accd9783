// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/points/text_lines.hpp"
#include "treadmark/io/points/unit_words.hpp"
#include "treadmark/io/profiles/column_table.hpp"
#include "treadmark/io/profiles/parse_points.hpp"

namespace treadmark::io::profiles {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

/// A line of words before the points: names of columns, a title, or something that was to be a number.
void check_title(const LineScanner& scanner, std::string_view line) {
  const std::size_t start = line.find_first_not_of(" \t\v\f");
  if (lower(line).find("vampire") != std::string::npos)
    scanner.fail("profiles of VAMPIRE are not read: their format is not published", 1,
                 "export the points as two columns y z in mm");
  const Word word{line.substr(start, line.find_first_of(" \t\v\f,;", start) - start), static_cast<int>(start + 1)};
  // figures without letters are a point whose numbers nobody can read
  const auto is_figure = [](const points::Field& f) {
    const bool digits = ranges::any_of(f.text, [](char c) { return c >= '0' && c <= '9'; });
    return digits && f.text.find_first_of(":/") == std::string_view::npos &&
           ranges::none_of(f.text, [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }) &&
           ranges::count(f.text, '-') < 2;
  };
  for (const char separator : {';', '\t', ',', ' '}) {
    const std::vector<points::Field> fields = points::fields_of(line, separator);
    if (fields.size() >= 2 && ranges::all_of(fields, is_figure))
      scanner.fail("this looks like a point, but " + printable(fields.front().text) + " is no number",
                   fields.front().column, "write numbers with '-' and '.', without brackets, units or blanks within");
  }
  // no title: a number that went wrong
  if (!is_letter(line[start]) && line[start] != '[' && line[start] != '(') to_number(scanner, word);
}

/// Columns with names, of which others than those of the coordinates may hold words: labels, times.
class NamedColumns {
 public:
  /// profile: of several side by side the one with this number.
  static std::optional<NamedColumns> in(const KeptLine& line, int profile) {
    for (const char separator : {';', '\t', ','}) {
      if (line.line().find(separator) == std::string_view::npos) continue;
      const std::vector<std::string> names = points::names_in(line.line(), separator);
      const std::vector<ColumnRoles> found = profiles_of(names, line);
      const auto number = static_cast<std::size_t>(std::max(profile, 1));
      if (number <= found.size()) return NamedColumns(found[number - 1], separator, names.size());
    }
    return std::nullopt;
  }

  bool hold_for(std::string_view line) const {
    const std::vector<points::Field> fields = points::fields_of(line, separator_);
    const auto is_number = [&](int column) {
      double value = 0.0;
      return points::parse_number(fields[static_cast<std::size_t>(column)].text, separator_ != ',', value);
    };
    return fields.size() == count_ && is_number(roles_.y) && is_number(roles_.z);
  }

 private:
  NamedColumns(ColumnRoles roles, char separator, std::size_t count)
      : roles_(std::move(roles)), separator_(separator), count_(count) {}

  ColumnRoles roles_;
  char separator_;
  std::size_t count_;
};

/// A row whose first value was not measured: a void word, and numbers or such words behind it.
bool is_row_of_voids(const std::string& line) {
  for (const char separator : {';', '\t', ',', ' '}) {
    if (separator != ' ' && line.find(separator) == std::string::npos) continue;
    const std::vector<points::Field> fields = points::fields_of(line, separator);
    if (fields.size() < 2) return false;
    return ranges::all_of(fields, [](const points::Field& f) {
      double value = 0.0;
      return points::is_void_word(f.text) || points::parse_number(f.text, true, value);
    });
  }
  return false;
}

/// A line that has a name for each column, though not those of a profile.
struct ForeignNames {
  const KeptLine* line = nullptr;
  std::vector<std::string> names;
};

/// Words in comments or between blanks are a title or prose, unless all are as short as symbols and one is known.
ForeignNames foreign_names(const std::vector<KeptLine>& words, const std::vector<KeptLine>& comments, char separator,
                           std::size_t columns) {
  constexpr std::size_t kSymbol = 4;
  for (const std::vector<KeptLine>* lines : {&words, &comments})
    for (auto line = lines->rbegin(); line != lines->rend(); ++line)
      for (const char s : {separator, ';', '\t', ','}) {
        std::vector<std::string> names = names_for(line->line(), s, columns);
        if (names.size() < 2) continue;
        const bool marked = lines == &words && s != ' ', usual = s == separator || s == '\t';
        const bool symbols = ranges::all_of(names, [](std::string_view name) {
          points::take_unit(name);
          return name.size() <= kSymbol;
        });
        if (coordinates_among(names) > 0 ? marked || symbols : marked && usual) return {&*line, std::move(names)};
      }
  return {};
}

/// What is said of columns that were taken for y and z by their place, and of those beside them.
void judge_columns(const ColumnTable& table, const points::FieldStyle& style, const ColumnRoles& roles,
                   const ForeignNames& names, ProfileSource& source) {
  const ColumnTable::Others others = table.others(roles, style);
  const auto word = [&](int column) {
    return names.line != nullptr ? printable(names.names[static_cast<std::size_t>(column)])
                                 : fmt::format("{}", column + 1);
  };
  std::string unused;
  for (const int column : others.varying) unused += (unused.empty() ? "" : ", ") + word(column);
  const std::string taken = fmt::format("column {} was taken as y, column {} as z", word(roles.y), word(roles.z)),
                    advice = "name them in a line before, for example: y;z";
  const std::size_t known = names.line != nullptr ? coordinates_among(names.names) : 0;
  // "Distance; Height"
  const bool told = known == 1 && names.names.size() == 2 && is_height(names.names[static_cast<std::size_t>(roles.z)]);
  if (names.line != nullptr && ((known > 0 && !told) || !others.varying.empty()))
    source.doubts.push_back(
        {"columns", fmt::format("line {} names {} columns, and they are not known as y and z of a profile: {}; {}",
                                names.line->number(), names.names.size(), taken, advice)});
  else if (others.like_z)
    source.doubts.push_back(
        {"columns", fmt::format("column {} runs as column {} does: are there several profiles side by side? {}; {}",
                                word(*others.like_z), word(roles.z), taken, advice)});
  else if (names.line != nullptr)
    source.notes.push_back(fmt::format("line {} does not name both y and z: {}", names.line->number(), taken));
  if (!unused.empty()) source.notes.push_back("columns not used: " + unused);
}

}  // namespace

ColumnContent parse_plain_columns(std::string_view text, const std::string& file, int profile) {
  LineScanner scanner(text, file);
  ColumnContent content;
  ColumnTable table(file);
  std::vector<KeptLine> words, comments;
  points::UnitFinder unit;
  std::optional<NamedColumns> names;
  while (scanner.next_line()) {
    const std::string line = plain_line(scanner.line());
    points::LineKind kind = points::kind_of_line(line);
    if (kind == points::LineKind::words && (is_row_of_voids(line) || (names && names->hold_for(line))))
      kind = points::LineKind::numbers;
    if (kind == points::LineKind::numbers) {
      table.add(scanner.number(), line);
      continue;
    }
    const bool empty = scanner.line().find_first_not_of(" \t\v\f") == std::string_view::npos;
    if (kind != points::LineKind::words) {
      if (empty || !table.empty()) continue;
      const std::string_view comment = points::comment_text(scanner.line());
      unit.look_at(comment);
      comments.emplace_back(file, scanner.number(), std::string(comment));
      continue;
    }
    if (!table.empty()) {
      const std::size_t start = line.find_first_not_of(" \t\v\f");
      scanner.fail("a number is expected, this is " + printable(std::string_view(line).substr(start)),
                   static_cast<int>(start + 1), "does a second profile begin here? keep one in a file");
    }
    check_title(scanner, line);
    words.emplace_back(file, scanner.number(), line);
    if (std::optional<NamedColumns> found = NamedColumns::in(words.back(), profile)) names = std::move(found);
  }
  ProfileSource& source = content.source;
  content.points.file = file;
  source.kind = "columns y z";
  if (table.empty()) {
    if (!words.empty())
      words.front().fail("numbers are expected, this is " + printable(words.front().line()), 1, "is it a profile?");
    return content;
  }
  table.drop_count(source.notes);
  const points::FieldStyle style = table.style();
  table.turn_two_lines(style, source.notes);
  const std::size_t columns = table.columns(style.separator);
  std::optional<ColumnRoles> roles;
  const KeptLine* header = nullptr;
  for (const std::vector<KeptLine>* lines : {&words, &comments})
    for (auto line = lines->rbegin(); line != lines->rend() && !roles; ++line) {
      roles = roles_in(*line, line->line(), style.separator, columns, profile);
      if (roles) header = &*line;
    }
  const ForeignNames foreign = roles ? ForeignNames{} : foreign_names(words, comments, style.separator, columns);
  for (const KeptLine& line : words)
    if (&line != header && &line != foreign.line)
      source.notes.push_back(fmt::format("line {} holds no point: {}", line.number(), printable(line.line())));
  if (!roles) {
    if (profile > 1)
      throw Error(ErrorKind::input_data, fmt::format("there is no profile {} in the file", profile), {file, 0, 0},
                  "name the columns of each in a line before them, for example: y1;z1;y2;z2");
    roles = table.assume_roles(style, source.notes);
    judge_columns(table, style, *roles, foreign, source);
  } else if (!roles->in_words.empty()) {
    source.notes.push_back("columns not used: " + roles->in_words);
  }
  source.unit = roles->unit ? roles->unit : unit.unit();
  source.unknown_unit = roles->unknown_unit;
  if (!source.unit && !source.unknown_unit) source.unknown_unit = unit.unknown();
  source.kind = fmt::format("columns y z {}, {}", roles->named ? "by their names" : "without names", style.in_words());
  content.radius_factor = roles->radius_factor;
  content.points = table.points(*roles, style, !roles->named, source.notes);
  return content;
}

}  // namespace treadmark::io::profiles
