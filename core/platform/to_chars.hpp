// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <charconv>
#include <version>

#include <fmt/format.h>

namespace treadmark {

namespace platform {

/// Writes a number with so many significant digits, shorter of fixed and scientific, without a zero at the end; returns
/// the end of what is written. Room for 32 characters is enough.
inline char* own_write_digits(char* first, char* last, double value, int digits) {
  return fmt::format_to_n(first, last - first, "{:.{}g}", value, digits).out;
}

}  // namespace platform

/// The same by the standard library, which libc++ before 14 has for whole numbers only.
inline char* write_digits(char* first, char* last, double value, int digits) {
#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 14000
  return platform::own_write_digits(first, last, value, digits);
#else
  return std::to_chars(first, last, value, std::chars_format::general, digits).ptr;
#endif
}

}  // namespace treadmark
