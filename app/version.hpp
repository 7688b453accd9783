// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::app {

std::string version();       ///< "0.1.0"
std::string git_revision();  ///< short commit hash of the sources, "unknown" outside a repository
/// Parts that are in and those left out (core/parts.hpp), and the licence that the binary thereby has, for --version.
std::string build_description();

}  // namespace treadmark::app
