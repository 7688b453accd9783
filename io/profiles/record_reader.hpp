// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io::profiles {

/// Reads records of blank-separated values: '%' starts a comment, a record may span lines, words after its last value
/// are ignored up to the end of the line. Throws Error(input_data) where a value is missing or is not what is expected.
class RecordReader {
 public:
  RecordReader(std::string_view text, const std::string& file) : scanner_(text, file) {}

  /// `what` tells in messages which value is missing where the file ends.
  double number(const std::string& what);
  int integer(const std::string& what);
  /// A name in single quotes, on one line.
  std::string name(const std::string& what);
  /// Drops the rest of the line.
  void end_record();
  /// Whether values are left; the position is then at the first of them.
  bool more();

  /// Of the value read last or, after more(), of the next one.
  SourcePosition position() const { return scanner_.at(column_); }
  [[noreturn]] void fail(const std::string& message, const std::string& advice = {}) const {
    scanner_.fail(message, column_, advice);
  }

 private:
  Word next(const std::string& what);

  LineScanner scanner_;
  int column_ = 0;
};

}  // namespace treadmark::io::profiles
