// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/cases/contact_program/contact_text.hpp"

namespace treadmark::io {

/// What the program does with one value of one control digit.
enum class DigitSupport {
  yes,
  conditional,  ///< supported in the circumstances that 'condition' names
  no_effect,    ///< read; does not change our results
  no,
};

/// One value of one control digit of the reference program's input; the whole list is the table of supported digits.
struct DigitValue {
  int module = 1;            ///< 1 wheel-rail, 3 basic
  std::string_view keyword;  ///< for example TANG
  int value = 0;
  DigitSupport support = DigitSupport::no;
  std::string_view meaning;
  std::string_view condition{};  ///< of a value that is not supported: what to use instead
  char letter = ' ';             ///< in the control word
};

/// All values of all digits, in the order of the control words.
std::span<const DigitValue> contact_digits();
/// The same as Markdown (docs/contact-input.md).
std::string contact_digit_table();

/// A decimal control word such as 1203100, letter by letter; leading zeros may be left out.
class ControlWord {
 public:
  enum class Name { problem, model, run };

  /// Reads the first integer of a record and checks that every digit has a value that exists in this module.
  ControlWord(ContactText& text, int module, Name name);

  int operator[](std::string_view keyword) const;
  SourcePosition where(std::string_view keyword) const;
  const DigitValue& described(std::string_view keyword) const;
  std::span<const std::string_view> keywords() const { return keywords_; }

 private:
  std::size_t index(std::string_view keyword) const;
  std::vector<std::string_view> keywords_;
  std::vector<int> values_;
  std::vector<SourcePosition> positions_;
  std::vector<const DigitValue*> described_;
};

}  // namespace treadmark::io
