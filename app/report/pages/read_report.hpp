// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// The report of whatever lies in a result folder: of treadmark run, compare, bench, import (its report folder),
/// simulate or sweep, finished or not. A file in such a folder stands for the folder. Errors: Error(input_data) for
/// folders without results and broken files. Not to be called from two threads at once.
Page read_report(const std::filesystem::path& folder);

}  // namespace treadmark::app::report
