// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <optional>

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
  // no title: a number that went wrong
  if (!is_letter(line[start]) && line[start] != '[' && line[start] != '(') to_number(scanner, word);
}

}  // namespace

ColumnContent parse_plain_columns(std::string_view text, const std::string& file) {
  LineScanner scanner(text, file);
  ColumnContent content;
  ColumnTable table(file);
  std::vector<KeptLine> words, comments;
  points::UnitFinder unit;
  while (scanner.next_line()) {
    const std::string line = plain_line(scanner.line());
    const points::LineKind kind = points::kind_of_line(line);
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
  }
  ProfileSource& source = content.source;
  content.points.file = file;
  source.kind = "columns y z";
  if (table.empty()) {
    if (!words.empty())
      words.front().fail("numbers are expected, this is " + printable(words.front().line()), 1, "is it a profile?");
    return content;
  }
  const points::FieldStyle style = table.style();
  std::optional<ColumnRoles> roles;
  const KeptLine* names = nullptr;
  for (const std::vector<KeptLine>* lines : {&words, &comments})
    for (auto line = lines->rbegin(); line != lines->rend() && !roles; ++line) {
      roles = roles_in(*line, line->line(), style.separator, table.columns(style.separator));
      if (roles) names = &*line;
    }
  for (const KeptLine& line : words)
    if (&line != names)
      source.notes.push_back(fmt::format("line {} holds no point: {}", line.number(), printable(line.line())));
  if (!roles) roles = table.assume_roles(style, source.notes);
  if (!roles->in_words.empty()) source.notes.push_back("columns not used: " + roles->in_words);
  source.unit = roles->unit ? roles->unit : unit.unit();
  source.kind = fmt::format("columns y z {}, {}", roles->named ? "by their names" : "without names", style.in_words());
  content.points = table.points(*roles, style, !roles->named);
  return content;
}

}  // namespace treadmark::io::profiles
