// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark::io::recording {

/// The text of a recording as UTF-8, from UTF-16 or Latin-1 too, with ASCII signs for minus and blank.
std::string as_utf8(std::string_view text);

/// A piece of a line; quoted: it stood in quotes, which are gone.
struct Cell {
  std::string_view text;
  int column = 0;  ///< from 1
  bool quoted = false;
};

/// Separators in quotes separate nothing. Empty cells at the end count; ' ' is any number of blanks.
std::vector<Cell> cells_of(std::string_view line, char separator);

/// Takes empty cells at the end away.
void trim(std::vector<Cell>& cells);

/// Marks of nothing, as words.
bool is_mark(std::string_view text);
/// Marks of nothing, as numbers: -9999, 999.9, -99.99, and the ends of whole numbers.
bool is_mark(std::string_view text, double value);

/// Kilometres and metres, "44+123.4", "km 44+123,4", "K44 + 123": base times the first and the second number.
std::optional<double> with_plus(std::string_view text, double base);

}  // namespace treadmark::io::recording
