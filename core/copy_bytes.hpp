// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

namespace treadmark {

/// Writes what a file of our own holds into a target, in the manner of OutputFile: what pipes, devices and linked files
/// get, which cannot be renamed. Errors: Error(configuration) naming the target.
void copy_bytes(const std::filesystem::path& made, const std::filesystem::path& target);

}  // namespace treadmark
