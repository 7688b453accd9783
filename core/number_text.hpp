// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <optional>
#include <string_view>
#include <system_error>

#include "treadmark/core/platform/from_chars.hpp"

namespace treadmark {

/// The number that is all of a text, with a decimal point in every locale; nothing where it is no number or not finite.
inline std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = from_chars(text.data(), end, value);
  return error == std::errc() && rest == end && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace treadmark
