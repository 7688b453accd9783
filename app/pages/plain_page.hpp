// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// The page of what has none of its own: single numbers and texts of a JSON text as facts, those of "input" as inputs,
/// and pictures. kind: "track". lead: what it is. Errors: Error(input_data) for a text that is no JSON.
report::Page plain_page(const std::string& kind, const std::string& lead, const std::string& json,
                        std::vector<report::Figure> pictures);

/// The same of a folder with all its pictures. json: the file with the numbers, "track.json". Errors also those of
/// readers.
report::Page plain_page(const std::filesystem::path& folder, const std::string& json, const std::string& lead);

}  // namespace treadmark::app::pages
