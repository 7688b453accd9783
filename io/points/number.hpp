// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <charconv>
#include <string_view>

namespace treadmark::io::points {

/// The number that a whole word says: exponents e, E, d and D, a leading '+', nan and infinities in the spellings of C,
/// and of Windows ("-1.#IND"); a decimal comma where asked for. Out of range counts as infinite. False for anything
/// else.
bool parse_number_slowly(std::string_view word, bool decimal_comma, double& value);

inline bool parse_number(std::string_view word, bool decimal_comma, double& value) {
  const char* const end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if (result.ptr == end && result.ec == std::errc{}) return true;
  return parse_number_slowly(word, decimal_comma, value);
}

/// A whole number that a double holds exactly.
bool is_whole(double value);

}  // namespace treadmark::io::points
