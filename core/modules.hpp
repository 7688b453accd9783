// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace treadmark {

/// Folders in which modules lie: programs and libraries with what few need and many would have to load. First the one
/// that is taken: of $TREADMARK_MODULES that alone, else below the folder of the program's, beside the shared library
/// that this is part of, where Treadmark was built, where it was to be installed.
std::vector<std::filesystem::path> module_folders();

/// How a module is put where it is missing or of another version. part: a key of parts() whose Debian package has it.
std::string module_advice(std::string_view part);

}  // namespace treadmark
