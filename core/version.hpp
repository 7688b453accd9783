// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark {

std::string version();       ///< "0.2.0"
std::string git_revision();  ///< short commit hash of the sources, "unknown" outside a repository

}  // namespace treadmark
