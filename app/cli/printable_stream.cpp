// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/printable_stream.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::cli {
namespace {

constexpr std::size_t kLongestCharacter = 4;  // of UTF-8

bool is_plain(char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; }

/// Of a character that is not plain: U+0080 to U+009F are control characters as those of ASCII are.
bool is_control(std::string_view character) {
  return character.size() == 1 || (character[0] == '\xc2' && static_cast<unsigned char>(character[1]) < 0xa0);
}

/// How a terminal shows what lines begin with.
struct Label {
  std::string_view word, colour;
};
constexpr Label kLabels[] = {{"treadmark", "\x1b[1;31m"},
                             {"interrupted", "\x1b[1;33m"},
                             {"warning", "\x1b[1;33m"},
                             {"minor warning", "\x1b[33m"},
                             {"note", "\x1b[36m"}};

/// Labels end with a colon, in lists with two blanks: "treadmark run: ", "  warning  ".
std::string coloured(std::string_view line) {
  const std::size_t from = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t to = std::min({line.find(':', from), line.find("  ", from), line.size()});
  const std::string_view label = line.substr(from, to - from), rest = line.substr(to);
  const bool message = label.starts_with("treadmark ") && rest.starts_with(':');  // else it is a command
  for (const auto& [word, colour] : kLabels)
    if (!rest.empty() && (label == word || (message && word == "treadmark")))
      return fmt::format("{}{}{}\x1b[0m{}", line.substr(0, from), colour, label, rest);
  return std::string(line);
}

}  // namespace

/// Labels come in one piece.
bool PrintableStream::put(std::string_view printable) {
  held_.append(printable);
  const std::size_t whole = columns_ == 0 ? held_.size() : held_.rfind('\n') + 1;
  std::string out = folded(held_.substr(0, whole), columns_);
  held_.erase(0, whole);
  if (coloured_) {
    std::istringstream lines(std::exchange(out, {}));
    for (std::string line; std::getline(lines, line);) {
      out += line_begins_ ? coloured(line) : line;
      line_begins_ = !lines.eof();
      if (line_begins_) out += '\n';
    }
  }
  const auto size = static_cast<std::streamsize>(out.size());
  return to_->sputn(out.data(), size) == size;
}

/// all: nothing more will follow what may be the beginning of a character.
bool PrintableStream::pass(bool all) {
  const std::string_view text = waiting_;
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t plain = at;
    while (at < text.size() && is_plain(text[at])) ++at;
    out += text.substr(plain, at - plain);
    if (at == text.size()) break;
    const std::size_t length = io::utf8_length(text.substr(at));
    if (length == 0 && !all && text.size() - at < kLongestCharacter) break;
    if (length == 0 || is_control(text.substr(at, length)))
      out += '?';
    else
      out += text.substr(at, length);
    at += length > 0 ? length : 1;
  }
  waiting_.erase(0, at);
  return put(out);
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize size) {
  waiting_.append(text, static_cast<std::size_t>(size));
  return pass(false) ? size : 0;
}

PrintableStream::int_type PrintableStream::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char one = traits_type::to_char_type(c);
  return xsputn(&one, 1) == 1 ? c : traits_type::eof();
}

int PrintableStream::sync() { return pass(true) && to_->pubsync() == 0 ? 0 : -1; }

}  // namespace treadmark::cli
