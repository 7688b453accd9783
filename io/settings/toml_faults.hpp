// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

namespace treadmark::io {

/// What is wrong with a text, and what to write instead; an empty message: nothing is known.
struct TextFault {
  std::string message, advice;
};

/// Why a text is no number of TOML though one was meant: a decimal comma, separators of thousands, a unit behind it, an
/// exponent with D, a calculation, other minus signs, no digit before or behind the point, quotes. Thread-safe.
TextFault number_fault(std::string_view text);

/// The slip at which a parser of TOML stopped, at a line and column from 1; words: the parser's own. Thread-safe.
TextFault toml_fault(std::string_view text, int line, int column, std::string_view words);

}  // namespace treadmark::io
