// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// Reads a case file of either kind, chosen by its extension: .toml (Treadmark) or .inp (CONTACT).
/// overrides: "key.path=value" with the keys of the Treadmark case file, applied to every case of either kind.
/// Throws Error (configuration). Safe to call from several threads.
CaseFile read_any_case(const std::filesystem::path& file, std::span<const std::string> overrides = {});

/// Whole content of a text file; throws Error (configuration) when it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace treadmark::io
