// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/app/assessment/assess_result.hpp"
#include "treadmark/app/report/page.hpp"

namespace treadmark::app::report {

/// What runs say against limits, and their spectra, as sections of a page.
std::vector<Section> assessment_sections(std::span<const AssessedRun> runs);

/// Runs over each other: channels (patterns) over the distance, a colour a run, the assessment side by side. Errors:
/// Error(configuration) for channels that a run does not have.
Page assessment_page(std::span<const AssessedRun> runs, std::span<const std::string> channels);

}  // namespace treadmark::app::report
