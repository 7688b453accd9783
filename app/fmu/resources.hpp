// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/app/fmu/fmu_file.hpp"

namespace treadmark::fmi {

/// Puts the case or simulation with every file that it names into an empty folder, as open_model reads it. Returns what
/// it is, one line. Errors as write_fmu.
std::string write_resources(const FmuContent& content, const std::filesystem::path& folder);

}  // namespace treadmark::fmi
