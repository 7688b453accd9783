// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/points/number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::io::points {

bool parse_number_slowly(std::string_view word, bool decimal_comma, double& value) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  char copy[400];
  if (word.empty() || word.size() > sizeof copy) return false;
  std::copy(word.begin(), word.end(), copy);
  char* const end = copy + word.size();
  if (decimal_comma && std::count(copy, end, ',') == 1) std::replace(copy, end, ',', '.');

  std::from_chars_result result = std::from_chars(copy, end, value);
  if (result.ptr != end && result.ptr != copy && (*result.ptr == 'd' || *result.ptr == 'D')) {
    *const_cast<char*>(result.ptr) = 'e';  // Fortran writes 1d-5
    result = std::from_chars(copy, end, value);
  }
  if (result.ptr == end && result.ec == std::errc::result_out_of_range) {
    // too small is as good as zero, too large is no number to go on with
    const std::string_view text(copy, word.size());
    const std::size_t exponent = text.find_first_of("eE");
    const bool small = exponent != std::string_view::npos ? text[exponent + 1] == '-'
                                                          : text.find_first_of("123456789") > text.find('.');
    value = small ? 0.0 : std::numeric_limits<double>::infinity();
    return true;
  }
  if (result.ptr == end && result.ec == std::errc{}) return true;
  std::string_view rest(copy, word.size());
  if (rest[0] == '-') rest.remove_prefix(1);
  if (rest == "1.#IND" || rest == "1.#QNAN" || rest == "1.#INF" || rest == "1.#SNAN" || rest == "1.#J") {
    value = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  return false;
}

bool is_whole(double value) { return std::abs(value) <= 9e15 && value == std::floor(value); }

}  // namespace treadmark::io::points
