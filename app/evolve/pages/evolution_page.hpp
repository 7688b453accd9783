// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// The page of a folder of an evolution, finished or not: numbers over generations, sections and contacts of the
/// generation that is chosen. Errors: Error(input_data) for files that cannot be read.
report::Page evolution_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::pages
