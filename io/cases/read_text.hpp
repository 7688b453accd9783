// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace treadmark::io {

/// Whole content of a text file; throws Error (configuration) when it cannot be read.
std::string read_text(const std::filesystem::path& file);
/// SHA-256 of a text, hexadecimal.
std::string text_sha256(std::string_view text);

}  // namespace treadmark::io
