// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io {

/// A number for people: so many decimals, negative: five digits; without the sign of zero; with an exponent from 1e9
/// on.
/// "-" for what is not finite.
std::string shown_number(double value, int decimals);
/// So many significant digits, the zeros at their end too; with an exponent below `least` and from 1e9 on.
std::string significant(double value, int digits, double least);
/// Three significant digits, more before a point. "-" for what is not finite.
std::string in_short(double value);
/// "12.3 mm", "0.17 +- 0.01"; an uncertainty of 0 or NaN is left out.
std::string with_unit(const std::string& value, double uncertainty, std::string_view unit);
std::string text_line(std::string_view label, std::size_t width, const std::string& text);

/// Adds a column to the lines of a table, two blanks before it: numbers to the right, texts to the left.
void add_column(std::vector<std::string>& lines, const std::vector<std::string>& cells, bool texts);
/// A table by its lines of equally many cells: a column of texts, then columns of numbers. It is cut into blocks, one
/// below the other, that begin at these columns and where 80 characters are full; the columns before the first block
/// stand in front of each. Lines without a cell are left out.
std::string table_text(const std::vector<std::vector<std::string>>& lines, const std::vector<std::size_t>& blocks);
/// Without blanks at the ends of lines.
std::string joined_lines(const std::vector<std::string>& lines);

}  // namespace treadmark::io
