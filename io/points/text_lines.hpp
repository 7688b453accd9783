// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io::points {

/// What the lines of a text of numbers are: one set of rules for profiles, clouds and maps.

enum class LineKind { empty, comment, words, numbers };
LineKind kind_of_line(std::string_view line);

/// The text of a comment without the signs before it.
std::string_view comment_text(std::string_view line);

/// Comments may stand behind the numbers; a word with such a sign within ("1.#QNAN") is none.
std::string_view without_comment(std::string_view line);

/// The names in a header line. In a header separated by blanks a unit in brackets belongs to the name before it.
std::vector<std::string> names_in(std::string_view line, char separator);

/// The line with minus signs of typesetters (U+2212, en dash) and hard blanks as plain ones, and numbers in brackets as
/// negative ones, as spreadsheets of accountants write them: "(36.1)". Empty where nothing changes.
std::string plain_signs(std::string_view line);

/// Whether a word stands for a value that was not measured: "", "NaN", "N/A", "--", "1.#QNAN", "null" ...
bool is_void_word(std::string_view word);

/// Numbers in quotes as numbers in the same columns; a decimal comma in quotes becomes a point where commas may
/// separate. False where nothing changes.
bool unquote_numbers(std::string_view line, std::string& plain);

}  // namespace treadmark::io::points
