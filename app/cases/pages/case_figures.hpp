// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Views and tables of cases that pages of runs, simulations and comparisons share.

/// A frame a case; the frames keep the run alive. name: of the set.
report::FrameSet frames_of(const std::shared_ptr<const io::RunResult>& run, std::string name);

/// What varies from case to case: pitch, position ... in the order in which people would choose it; the number of the
/// case comes last.
std::vector<report::Axis> case_axes(const io::RunResult& run);

/// A step a case.
report::Timeline case_timeline(const io::RunResult& run);

/// Largest pressure, forces, contact area and approach over the steps of case_timeline.
report::ChartView case_chart(const io::RunResult& run);

/// A line a case, and a line a patch.
report::Table case_table(const io::RunResult& run);
report::Table patch_table(const io::RunResult& run);
report::Table uncertainty_table(const io::RunResult& run);

/// Of the patches of a case; NaN without any.
double largest(const io::CaseResult& result, double io::PatchResult::*member);

/// What a TrackView shows.
constexpr const char* kTrackNote =
    "Pressure from above where it acts in the track, over wheel and rail cut through the most loaded patch (line); "
    "dots: "
    "contact references. A click chooses the step.";

/// Both bodies of the first set of frames: cut at the contact, and in space. name: what they are.
std::vector<report::Block> body_figures(const std::string& name);

/// Whether any patch of the run has contact fields.
bool has_fields(const io::RunResult& run);

/// Of all cases: "case 3", and the value of the first axis that varies.
std::vector<std::string> step_names(const io::RunResult& run);

}  // namespace treadmark::app::pages
