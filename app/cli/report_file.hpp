// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>

#include "treadmark/app/report/page.hpp"

namespace treadmark::cli {

/// Makes the page and writes it as a live report; an empty name: does nothing.
void write_report_file(const std::filesystem::path& file, const std::function<app::report::Page()>& page);

}  // namespace treadmark::cli
