// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace treadmark::cli {

/// Columns of the terminal that a descriptor is; 0: it is none.
std::size_t terminal_columns(int descriptor);

/// Whether it is a terminal that shows colours, and nobody has set NO_COLOR.
bool has_colours(int descriptor);

/// Lines that are longer go on below their last column, which begins behind two blanks. 0 columns: as it is.
std::string folded(std::string_view text, std::size_t columns);

/// The first so many characters of a line of UTF-8.
std::string_view cut(std::string_view line, std::size_t columns);

/// Text for people on standard output, folded where that is a terminal.
void print(const std::string& text);

}  // namespace treadmark::cli
