// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// A patch as the text file that the plotting tools of CONTACT load: six lines of head, each below a line of names that
/// begins with a percent sign, then a line an element, rows with growing s. All lines have as many columns as an
/// element, filled up with zeros; the last column of the first line is the format. Units mm, N/mm^2, mm/s, rad, s, deg
/// C; slip is relative (shift: mm). Numbers have 13 significant digits. all_elements: also those outside the contact,
/// NaN where a surface is missing. Thread-safe. Errors: Error(configuration) for fields that do not match their grid.
std::string patch_to_mat(const MatFileHead& head, const PatchResult& patch, bool all_elements);

/// Writes the text to a file that appears only when complete. Errors: as above, and when the file cannot be written.
void write_mat(const std::filesystem::path& path, const MatFileHead& head, const PatchResult& patch, bool all_elements);

/// "<stem>.0001a.mat" for case 1, patch 1 (a), extension "mat"; patch 0: no letter (a basic case).
/// Errors: Error(configuration) for a patch that has no letter.
std::string case_file_name(const std::string& stem, int case_number, int patch, const std::string& extension);

/// Columns of text as numerical tools load them: names behind a percent sign, numbers with 13 significant digits, whole
/// numbers without a fraction, columns of equal width.

/// "% NAME NAME ...", names over their columns.
std::string column_head(std::span<const std::string_view> names);

/// One line of numbers, filled up with zeros to `count` columns where there are fewer values.
std::string column_line(std::span<const double> values, std::size_t count = 0);

}  // namespace treadmark::io
