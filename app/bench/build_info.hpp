// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace treadmark::app {

/// Compiler with version and kind of build: "GNU 12.2.0, Release".
std::string compiler_name();

/// Name and version of the libraries that this program was built with.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace treadmark::app
