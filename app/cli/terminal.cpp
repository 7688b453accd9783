// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "treadmark/io/files/text.hpp"

namespace treadmark::cli {
namespace {

constexpr std::size_t kUsual = 80;  // of a terminal that does not tell

/// Where the rest of a line goes on: below its last column, which begins behind two blanks, unless that is far right.
std::size_t indent_of(std::string_view line, std::size_t columns) {
  constexpr std::size_t kParagraph = 2, kListed = 8;
  const std::size_t text = std::min(line.find_first_not_of(' '), line.size()), gap = line.rfind("  ");
  const std::size_t last = gap == std::string_view::npos ? 0 : io::characters_of(line.substr(0, gap + 2));
  if (last > text && last <= 2 * columns / 3) return last;
  return text < kListed ? text + kParagraph : std::min(text, columns / 2);
}

std::string folded_line(std::string_view line, std::size_t columns) {
  std::string out;
  const std::string indent(indent_of(line, columns), ' ');
  for (std::size_t room = columns; io::characters_of(line) > room; room = columns - indent.size()) {
    const std::size_t most = cut(line, room + 1).size(), first = line.find_first_not_of(' ');
    std::size_t at = line.rfind(' ', most - 1);
    if (at == std::string_view::npos || at <= first) at = line.find(' ', most);  // a word that is too long
    if (at == std::string_view::npos) break;
    const std::size_t end = line.find_last_not_of(' ', at) + 1;
    out.append(line.substr(0, end)) += '\n' + indent;
    line.remove_prefix(end);
    if (!line.starts_with("  ")) line.remove_prefix(1);  // between columns blanks keep numbers below each other
  }
  return out.append(line);
}

}  // namespace

std::size_t terminal_columns(int descriptor) {
  if (isatty(descriptor) != 1) return 0;
  winsize size{};
  return ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

bool has_colours(int descriptor) {
  const char* const none = std::getenv("NO_COLOR");
  const char* const kind = std::getenv("TERM");
  return isatty(descriptor) == 1 && (none == nullptr || *none == '\0') && kind != nullptr &&
         std::string_view(kind) != "dumb";
}

std::string_view cut(std::string_view line, std::size_t columns) {
  std::size_t at = 0;
  for (; at < line.size(); ++at)
    if (io::begins_character(line[at]) && columns-- == 0) break;
  return line.substr(0, at);
}

std::string folded(std::string_view text, std::size_t columns) {
  if (columns == 0) return std::string(text);
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    out += folded_line(text.substr(0, end), columns);
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

void print(const std::string& text) { std::cout << folded(text, terminal_columns(STDOUT_FILENO)); }

}  // namespace treadmark::cli
