// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io {

/// The ending of a file's name in small letters, with its dot.
inline std::string extension_of(const std::filesystem::path& file) {
  return profiles::lower(file.extension().string());
}

}  // namespace treadmark::io
