// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Report of a benchmark; document: its JSON text.
report::Page bench_page(const BenchReport& bench, std::string document);

/// Report of a folder of `treadmark bench`: its bench.json. Errors: Error(input_data) for a file that is missing,
/// broken or lacks keys.
report::Page bench_page(const std::filesystem::path& folder);

}  // namespace treadmark::app::pages
