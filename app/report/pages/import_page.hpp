// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// Report of a folder of `treadmark import --report`: report.json and, as far as they are there, times.json, maps.h5,
/// the pictures, settings.toml and summary.txt. Errors: Error(input_data) for files that are broken or lack keys, and
/// without report.json. Not to be called from two threads at once (HDF5).
Page import_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::report
