// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace treadmark::io {

/// Tables, lists and dotted keys within each other, counted from the top of a file.
inline constexpr std::size_t kDeepestNesting = 100;

/// Whoever parses, walks through or destroys nested values calls itself for each of them, so that a short file could
/// exhaust the stack. Errors: Error(configuration) at the key or bracket where a TOML text goes deeper than
/// kDeepestNesting. Texts with syntax errors are judged up to the first one, where a parser stops.
void refuse_deep_toml(std::string_view text, const std::string& name);

/// Where the string in quotes that begins at `at` has ended; the end of the text where it is not closed.
std::size_t after_toml_string(std::string_view text, std::size_t at);

}  // namespace treadmark::io
