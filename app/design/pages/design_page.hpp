// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// The page of a folder of a design: what was sought and found, and the runs before and after it overlaid, where the
/// folder has their fields. Errors: Error(input_data) for files that cannot be read.
report::Page design_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::pages
