// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace treadmark::io {

/// SHA-256 digest of the bytes as 64 lower-case hexadecimal digits (FIPS 180-4). Thread-safe.
std::string sha256_hex(std::string_view bytes);

/// The same digest as base64 text, as content-security policies have it. Thread-safe.
std::string sha256_base64(std::string_view bytes);

/// SHA-256 digest of a file's content, read in pieces.
/// Throws Error(input_data) when the file cannot be read to its end.
std::string sha256_file(const std::filesystem::path& file);

}  // namespace treadmark::io
