// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/step_text.hpp"

#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io::cad {
namespace {

constexpr int kEnd = std::char_traits<char>::eof();

bool is_digit(int c) { return c >= '0' && c <= '9'; }
bool is_letter(int c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; }

/// The characters of a file with their places.
class StepText {
 public:
  explicit StepText(const std::filesystem::path& file) : in_(file, std::ios::binary), at_{file.string(), 1, 0} {
    next();
  }

  int now() const { return now_; }
  const SourcePosition& at() const { return at_; }
  void next() {
    if (now_ == '\n') {
      ++at_.line, at_.column = 0;
      check_cancelled();
    }
    now_ = in_.rdbuf()->sbumpc();
    ++at_.column;
  }
  void skip_blanks_and_comments() {
    for (;; next()) {
      if (now_ == '/' && in_.rdbuf()->sgetc() == '*') {
        for (int before = 0; now_ != kEnd && !(before == '*' && now_ == '/'); next()) before = now_;
      } else if (now_ != ' ' && now_ != '\t' && now_ != '\r' && now_ != '\n') {
        return;
      }
    }
  }
  void skip_text(int quote) {
    do next();
    while (now_ != quote && now_ != kEnd);
    next();
  }

 private:
  std::ifstream in_;
  SourcePosition at_;
  int now_ = 0;
};

bool is_number(std::string_view word) {
  if (word.starts_with('+') || word.starts_with('-')) word.remove_prefix(1);
  double value = 0.0;
  return !word.empty() && is_digit(word.front()) &&
         from_chars(word.data(), word.data() + word.size(), value).ptr == word.data() + word.size();
}

}  // namespace

void require_step_numbers(const std::filesystem::path& file) {
  StepText text(file);
  int before = 0;
  for (text.skip_blanks_and_comments(); text.now() != kEnd; text.skip_blanks_and_comments()) {
    const int c = text.now();
    if (c == '\'' || c == '"') {
      text.skip_text(c);
    } else if ((before == '(' || before == ',') && (is_digit(c) || is_letter(c) || c == '+' || c == '-')) {
      const SourcePosition at = text.at();
      std::string word;
      for (int w = c; is_digit(w) || is_letter(w) || w == '+' || w == '-' || w == '.'; w = text.now()) {
        word += static_cast<char>(w);
        text.next();
      }
      text.skip_blanks_and_comments();
      const int behind = text.now();
      const bool sound = is_letter(c) ? behind == '(' : is_number(word) && (behind == ',' || behind == ')');
      if (!sound)
        throw Error(ErrorKind::input_data, fmt::format("{} is no number", profiles::printable(word)), at,
                    "is the file damaged? export it again");
    } else {
      text.next();
    }
    before = c;
  }
}

}  // namespace treadmark::io::cad
