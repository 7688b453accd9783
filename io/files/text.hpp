// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io::profiles {

/// Files beyond this size are refused before anything is allocated.
inline constexpr std::uintmax_t kMaxBytes = 1'000'000'000;

/// A path as it stands in a file, with '\' taken as '/' too.
std::filesystem::path portable_path(std::string name);

/// The whole content of a regular file. `what` names its role in messages ("profile", "slices").
/// Throws Error(input_data) placed at referenced_from, or at the file itself where that is unknown.
std::string read_text(const std::filesystem::path& file, const std::string& what,
                      const SourcePosition& referenced_from);

/// The UTF-8 of a text in UTF-16 (RFC 2781), with a byte order mark or recognised by its zero bytes; empty for any
/// other text. What is no character becomes U+FFFD.
std::string from_utf16(std::string_view bytes);

}  // namespace treadmark::io::profiles

namespace treadmark::io {

/// The whole content of a file of settings, of a pipe too. what: its role, "file". Errors: Error(configuration), also
/// for devices, which may have no end, and for more than profiles::kMaxBytes.
std::string read_input(const std::filesystem::path& file, std::string_view what);

/// Bytes of the UTF-8 character (RFC 3629) at the start of a text that is not empty; 0 where there is none.
std::size_t utf8_length(std::string_view text);

/// Whether a byte of UTF-8 begins a character: it goes on with one in bytes 10xxxxxx.
constexpr bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }

/// Characters of a text in UTF-8, not bytes.
std::size_t characters_of(std::string_view text);

/// The start of a text in UTF-8 of at most so many bytes, without half a character at its end.
std::string_view cut_to_bytes(std::string_view text, std::size_t most);

/// Rounded, so that changes of unit leave no tail of nines. Zero has no sign. Thread-safe.
double rounded(double value, treadmark::Digits digits = treadmark::Digits::twelve);

/// In the units in which people read numbers, less than this is nothing but rounding and shown as 0.
inline constexpr double kShownAsZero = 1e-12;

/// Decimals with which a number, not 0, has so many significant digits; those it rounds up to count: 99.996 has one
/// less in four digits. Never below 0.
int decimals_of(double value, int digits);

/// Base64 text (RFC 4648) of some bytes, padded with '='.
std::string to_base64(std::span<const std::byte> bytes);

/// A text as a cell of a table with commas (RFC 4180): in quotes where it needs them, after an apostrophe where a
/// spreadsheet would take it for a formula. Thread-safe.
std::string csv_cell(const std::string& text);

/// The cells of a line of such a table without the blanks around them; a quoted cell may hold commas and doubled
/// quotes, no line ends. Thread-safe.
std::vector<std::string> csv_cells(std::string_view line);

/// The shortest number that reads back exactly, "nan", "inf" or "-inf". Thread-safe.
std::string csv_number(double value);
/// Rounded; empty where it is not finite.
std::string csv_cell(double value, treadmark::Digits digits = treadmark::Digits::twelve);

}  // namespace treadmark::io
