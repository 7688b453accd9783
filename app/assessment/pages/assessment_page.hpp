// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// What runs say against limits, and their spectra, as sections of a page.
std::vector<report::Section> assessment_sections(std::span<const AssessedRun> runs);

/// Runs over each other: channels (patterns) over the distance, a colour a run, the assessment side by side. Errors:
/// Error(configuration) for channels that a run does not have.
report::Page assessment_page(std::span<const AssessedRun> runs, std::span<const std::string> channels);

}  // namespace treadmark::app::pages
