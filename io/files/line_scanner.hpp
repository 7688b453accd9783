// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::io::profiles {

/// A file with more lines is refused.
inline constexpr int kMaxLines = 10'000'000;

/// A blank-separated piece of the current line; the column counts from 1.
struct Word {
  std::string_view text;
  int column = 0;
};

/// A word fit for a message: at most 40 characters, what cannot be printed replaced by '?'.
std::string printable(std::string_view text);

/// Lower-case copy (ASCII).
std::string lower(std::string_view text);

bool is_blank(char c);

/// The line of a text that is being read.
class TextLine {
 public:
  std::string_view line() const { return line_; }
  const std::string& file() const { return file_; }
  int number() const { return number_; }  ///< of the line, from 1

  SourcePosition at(int column = 0) const { return {file_, number_, column}; }

  [[noreturn]] void fail(const std::string& message, int column = 0, const std::string& advice = {}) const;

 protected:
  explicit TextLine(std::string file, int number = 0) : file_(std::move(file)), number_(number) {}

  std::string file_;
  std::string_view line_;
  int number_;
};

/// Walks over a text line by line (LF, CR LF or CR) and over the words of a line. Holds views: the text must outlive
/// it.
class LineScanner : public TextLine {
 public:
  /// Throws Error(input_data) at the first NUL byte, which no text file has. A UTF-8 byte order mark is skipped.
  LineScanner(std::string_view text, std::string file);

  /// Moves to the next line; false at the end. Throws Error(input_data) after kMaxLines lines.
  bool next_line();

  /// Keeps only the first characters of the current line, to drop a comment.
  void cut(std::size_t length) { line_ = line_.substr(0, length); }

  /// Next word of the current line, nothing at its end.
  std::optional<Word> next_word();

  std::size_t offset() const { return offset_; }  ///< of the next character to look at in line()
  void set_offset(std::size_t offset) { offset_ = offset; }

 private:
  std::string_view rest_;
  std::size_t offset_ = 0;
};

/// Whether the whole word is a decimal number, finite or not.
bool looks_numeric(std::string_view word);

/// The finite value of a word. Exponents e, E, d and D, a leading '+' and a trailing point are accepted.
/// Throws Error(input_data) at the word for anything else, NaN and infinities included.
double to_number(const TextLine& line, const Word& word);

/// As to_number for a whole number of magnitude up to 1e9.
int to_integer(const TextLine& line, const Word& word);

}  // namespace treadmark::io::profiles
