// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark::io {

/// Words and records of the input language of the reference program (CONTACT).
///
/// '%' starts a comment, blank lines are skipped, words are separated by blanks or one comma. A record starts on a new
/// line and may span several lines until its required values are there; optional values must stand on the line where
/// the required ones end; whatever follows on that line is ignored. Not thread-safe; the text must outlive the reader.
/// Every reading function throws Error (configuration) with file:line:column and the name of the value.
class ContactText {
 public:
  ContactText(std::string_view text, std::string file);

  /// No further word in the text.
  bool at_end();
  /// Drops the rest of the current line, if a word of it has been read.
  void drop_line();
  /// Starts a record: drops the rest of the line of the previous one. name is used in messages about a missing record.
  void begin_record(std::string_view name);

  /// Also a real without fraction (0.0, 1.).
  long integer(std::string_view name);
  double real(std::string_view name);
  /// A magnitude beyond the greatest one that is taken is refused.
  double real(std::string_view name, double greatest);
  /// Radians; suffix d = degrees, r = radians (the default).
  double angle(std::string_view name);
  double angle(std::string_view name, double greatest);
  std::string quoted(std::string_view name);

  std::optional<long> optional_integer();
  std::optional<double> optional_real();

  /// Position of the value read last; of the next word before the first one.
  const SourcePosition& where() const { return where_; }
  /// Characters of the word read last, as written; of an integer that is written as a real those before the point.
  int length_of_last_word() const { return last_length_; }
  [[noreturn]] void fail(std::string_view message, std::string advice = {}) const;

  /// A comment "%treadmark key = value".
  struct OwnSetting {
    std::string text;  ///< behind the word
    SourcePosition where;
  };
  /// Those of the lines that have been read since the last call.
  std::vector<OwnSetting> take_own_settings() { return std::exchange(own_settings_, {}); }

 private:
  struct Word {
    std::string_view text;
    bool quoted = false;
    bool closed = true;  ///< quoted only: the closing quote was found
  };
  bool next_line();
  std::optional<Word> peek_on_line();
  Word required(std::string_view name, std::string_view kind);
  void consume(const Word& word);
  [[noreturn]] void wrong_word(std::string_view name, std::string_view kind, const Word& word) const;

  std::string_view rest_;  ///< text behind the current line
  std::string_view line_;  ///< current line without comment
  std::size_t next_ = 0;   ///< offset of the next character in line_
  std::size_t word_end_ = 0;
  std::string file_;
  int line_number_ = 0;
  bool line_begun_ = false;  ///< a word of the current line has been read
  int last_length_ = 0;
  SourcePosition where_;
  std::string record_;
  std::vector<OwnSetting> own_settings_;
};

}  // namespace treadmark::io
