// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "treadmark/model/vehicle/running_limits.hpp"

namespace treadmark::io {

/// Reads a file of limits (TOML, docs/assessment.md). Which quantities there are is known to those who assess. Throws
/// Error(configuration) with file:line:column for unknown keys, values out of range, an edition without a name, and
/// limits that are none or hold nowhere. Thread-safe.
RunningLimits read_limits_file(const std::filesystem::path& file);

/// The same for text in memory; name serves for messages.
RunningLimits parse_limits_text(std::string_view text, const std::string& name);

}  // namespace treadmark::io
