// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

namespace treadmark::io {

/// Whole content of a text file; throws Error (configuration) when it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace treadmark::io
