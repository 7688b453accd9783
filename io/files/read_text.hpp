// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::io::profiles {

/// Files beyond this size are refused before anything is allocated.
inline constexpr std::uintmax_t kMaxBytes = 1'000'000'000;

/// A path as it stands in a file, with '\' taken as '/' too.
std::filesystem::path portable_path(std::string name);

/// The whole content of a regular file. `what` names its role in messages ("profile", "slices").
/// Throws Error(input_data) placed at referenced_from, or at the file itself where that is unknown.
std::string read_text(const std::filesystem::path& file, const std::string& what,
                      const SourcePosition& referenced_from);

}  // namespace treadmark::io::profiles
