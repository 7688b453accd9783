// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io {

/// A number for people: so many decimals, negative: five digits; without the sign of zero. "-" for what is not finite.
std::string shown_number(double value, int decimals);
/// "12.3 mm", "0.17 +- 0.01"; an uncertainty of 0 or NaN is left out.
std::string with_unit(const std::string& value, double uncertainty, std::string_view unit);
std::string text_line(std::string_view label, std::size_t width, const std::string& text);

/// Adds a column to the lines of a table, two blanks before it: numbers to the right, texts to the left.
void add_column(std::vector<std::string>& lines, const std::vector<std::string>& cells, bool texts);
/// Without blanks at the ends of lines.
std::string joined_lines(const std::vector<std::string>& lines);

}  // namespace treadmark::io
