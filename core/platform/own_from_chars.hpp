// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <locale.h>
#include <stdlib.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>

/// std::from_chars for doubles where the standard library has it for whole numbers only.
namespace treadmark::platform {

/// The letters at the start of a text that say infinity or nan, as many as belong to it; 0 where there are none.
inline std::size_t not_finite_length(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto begins = [&](std::string_view word) {
    return text.size() >= word.size() && std::equal(word.begin(), word.end(), text.begin(),
                                                    [&](char w, char c) { return is_letter(c) && (c | 0x20) == w; });
  };
  if (begins("infinity")) return 8;
  if (begins("inf")) return 3;
  if (!begins("nan")) return 0;
  std::size_t end = 3;
  if (end == text.size() || text[end] != '(') return end;
  do ++end;
  while (end < text.size() && (is_letter(text[end]) || (text[end] >= '0' && text[end] <= '9') || text[end] == '_'));
  return end < text.size() && text[end] == ')' ? end + 1 : 3;
}

/// The same answers as the standard's for texts of its format "general", to the last bit.
inline std::from_chars_result from_chars(const char* first, const char* last, double& value) {
  const auto is_digit = [last](const char* c) { return c != last && *c >= '0' && *c <= '9'; };
  const bool negative = first != last && *first == '-';
  const char* at = first + (negative ? 1 : 0);
  const auto signed_value = [negative](double size) { return negative ? -size : size; };

  // The first digits as a whole number, and by what power of ten it counts.
  constexpr std::uint64_t kRoom = 100'000'000'000'000'000;  // for two more digits at least
  std::uint64_t digits = 0;
  int power = 0;
  bool any = false, all = true;
  const auto take_digits = [&](int behind_point) {
    for (; is_digit(at); ++at) {
      any = true;
      if (digits < kRoom) {
        digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
        power -= behind_point;
      } else {
        all = false;
      }
    }
  };
  take_digits(0);
  if (at != last && *at == '.') {
    ++at;
    take_digits(1);
  }
  if (!any) {
    at = first + (negative ? 1 : 0);
    const std::size_t length = not_finite_length({at, static_cast<std::size_t>(last - at)});
    if (length == 0) return {first, std::errc::invalid_argument};
    value = signed_value((*at | 0x20) == 'i' ? std::numeric_limits<double>::infinity()
                                             : std::numeric_limits<double>::quiet_NaN());
    return {at + length, {}};
  }
  if (at != last && (*at == 'e' || *at == 'E')) {
    const char* exponent = at + 1;
    const bool down = exponent != last && *exponent == '-';
    if (exponent != last && (*exponent == '-' || *exponent == '+')) ++exponent;
    if (is_digit(exponent)) {
      constexpr int kLong = 100'000'000;
      int size = 0;
      for (; is_digit(exponent); ++exponent) size = std::min(10 * size + (*exponent - '0'), kLong);
      all = all && size < kLong;
      power += down ? -size : size;
      at = exponent;
    }
  }

  // Both the digits and the power of ten are doubles: one rounding (Clinger 1990).
  constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  constexpr std::uint64_t kExact = std::uint64_t{1} << 53;
  constexpr int kMost = 22;
  if (all && digits <= kExact && std::abs(power) <= kMost) {
    const double whole = static_cast<double>(digits);
    value = signed_value(power < 0 ? whole / kPowers[-power] : whole * kPowers[power]);
    return {at, {}};
  }

  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  const double read = strtod_l(std::string(first, at).c_str(), nullptr, plain);
  if (std::isinf(read) || (read == 0.0 && digits != 0)) return {at, std::errc::result_out_of_range};
  value = read;
  return {at, {}};
}

}  // namespace treadmark::platform
