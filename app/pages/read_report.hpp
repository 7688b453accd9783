// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// The report of whatever lies in a result folder (a row of kKinds in read_report.cpp), finished or not. A file in such
/// a folder stands for the folder. Errors: Error(input_data) for
/// folders without results and broken files. Not to be called from two threads at once.
report::Page read_report(const std::filesystem::path& folder);

/// Results that a page lays over each other.
inline constexpr std::size_t kMostOverlaid = 4;

/// Several runs, or several simulations, laid over each other; the others are compared with the first. Errors:
/// Error(input_data) as read_report and for results of other kinds or of different ones, Error(configuration) for more
/// than kMostOverlaid.
report::Page read_overlay(const std::vector<std::filesystem::path>& folders);

}  // namespace treadmark::app::pages
