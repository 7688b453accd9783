// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// The page of a folder of an evolution, finished or not: numbers over generations, sections and contacts of the
/// generation that is chosen. Errors: Error(input_data) for files that cannot be read.
Page evolution_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::report
