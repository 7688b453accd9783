// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// Report of a folder of `treadmark compare`: compare.json and, as far as they are there, fields.h5 or pressures.svg.
/// Errors: Error(input_data) for files that are broken or lack keys, and without compare.json.
/// Not to be called from two threads at once (HDF5).
Page compare_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::report
