// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/cases/read_toml.hpp"

namespace treadmark::io {

/// Reads a case file of either kind, chosen by its extension: .toml (Treadmark) or .inp (CONTACT).
/// overrides: "key.path=value" with the keys of the Treadmark case file, applied to every case of either kind.
/// Throws Error (configuration). Safe to call from several threads.
CaseFile read_any_case(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// The same, but the rows of a table (cases_file) stay in their file: for any number of them.
ListedCases read_listed_cases(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Whole content of a text file; throws Error (configuration) when it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace treadmark::io
