// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <optional>

#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/profiles/parse_points.hpp"

namespace treadmark::io::profiles {
namespace {

constexpr std::string_view kCommentCharacters = "!\"%#";

void drop_comment(LineScanner& scanner) {
  const std::size_t start = scanner.line().find_first_of(kCommentCharacters);
  if (start != std::string_view::npos) scanner.cut(start);
}

/// Which columns (from 0) hold y and z.
struct Columns {
  int y = 0, z = 1;
};

void add_row(LineScanner& scanner, const Word& first, const Columns& columns, bool numbers_only, RawPoints& points) {
  std::optional<double> y, z;
  std::optional<Word> word = first;
  for (int column = 0; word; ++column, word = scanner.next_word()) {
    if (column == columns.y)
      y = to_number(scanner, *word);
    else if (column == columns.z)
      z = to_number(scanner, *word);
    else if (numbers_only && !looks_numeric(word->text))
      to_number(scanner, *word);
  }
  if (!y || !z)
    scanner.fail("a point needs a lateral and a vertical position, the line has too few numbers", first.column,
                 "is the file truncated?");
  points.add(*y, *z, scanner.number());
}

/// "X,Y,A,C,N,K": X lateral, Y vertical; what else stands there is skipped.
Columns column_definition(const LineScanner& scanner, std::string_view list, int where) {
  Columns columns{-1, -1};
  for (int column = 0;; ++column) {
    const std::size_t comma = list.find(',');
    std::string name = lower(list.substr(0, comma));
    std::erase_if(name, is_blank);
    int* const target = name == "x" ? &columns.y : name == "y" ? &columns.z : nullptr;
    if (target != nullptr) {
      if (*target >= 0) scanner.fail("ColumnDef names " + name + " twice", where);
      *target = column;
    }
    if (comma == std::string_view::npos) break;
    list.remove_prefix(comma + 1);
  }
  if (columns.y < 0 || columns.z < 0)
    scanner.fail("ColumnDef must name the columns X and Y", where, "for example ColumnDef=X,Y,A,C,N");
  return columns;
}

}  // namespace

ColumnContent parse_miniprof(std::string_view text, const std::string& file) {
  LineScanner scanner(text, file);
  ColumnContent content;
  content.points.file = file;
  Columns columns;
  bool in_header = true;
  bool header_seen = false;
  while (scanner.next_line()) {
    const bool empty_line = scanner.line().find_first_not_of(" \t") == std::string_view::npos;
    if (in_header && header_seen && empty_line) in_header = false;
    drop_comment(scanner);
    const std::optional<Word> first = scanner.next_word();
    if (!first) continue;
    if (looks_numeric(first->text)) in_header = false;
    if (!in_header) {
      add_row(scanner, *first, columns, false, content.points);
      continue;
    }
    const std::size_t sign = scanner.line().find('=');
    if (sign == std::string_view::npos)
      scanner.fail("'Key=value' or numbers are expected, this is " + printable(first->text), first->column);
    header_seen = true;
    const auto start = static_cast<std::size_t>(first->column - 1);
    std::string key = lower(scanner.line().substr(start, sign - start));
    std::erase_if(key, is_blank);
    scanner.set_offset(sign + 1);
    if (key == "columndef") {
      columns = column_definition(scanner, scanner.line().substr(sign + 1), static_cast<int>(sign + 2));
    } else if (key == "xoffset" || key == "yoffset") {
      const std::optional<Word> word = scanner.next_word();
      if (!word) continue;
      (key == "xoffset" ? content.offset_y : content.offset_z) = to_number(scanner, *word);
    }
  }
  return content;
}

ColumnContent parse_two_column(std::string_view text, const std::string& file) {
  LineScanner scanner(text, file);
  ColumnContent content;
  content.points.file = file;
  while (scanner.next_line()) {
    drop_comment(scanner);
    if (const std::optional<Word> first = scanner.next_word()) add_row(scanner, *first, {}, true, content.points);
  }
  return content;
}

}  // namespace treadmark::io::profiles
