// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

namespace treadmark::cli {

/// So that nobody finds out after hours of work: Error(configuration) for a page that shall be a .pdf where there is no
/// Chromium, which prints it, or a picture or document of another kind.
void check_page_name(const std::filesystem::path& file);

/// Writes a page as HTML, or as PDF by its name. Errors: those of core/output_file.hpp;
/// Error(input_data) where Chromium makes no PDF.
void write_page(const std::filesystem::path& file, const std::string& html);

/// Opens the page in the user's browser, without waiting; does nothing where there is no screen.
void open_page(const std::filesystem::path& file);

}  // namespace treadmark::cli
