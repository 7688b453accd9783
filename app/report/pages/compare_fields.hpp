// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>

#include "treadmark/app/report/page.hpp"
#include "treadmark/app/report/pages/compared_candidates.hpp"

namespace treadmark::app::report {

/// Contact fields of a comparison: a set a candidate that was solved, the truth first, with a frame for every case of the comparison.
/// Where a candidate lacks a case its frame says so.
struct ComparedFields {
  std::vector<FrameSet> sets;
  std::shared_ptr<const io::RunResult> truth;  ///< cases of the first candidate, for the axes of the timeline
};

/// From the file of the fields. Errors: those of its reader; Error(input_data) where it does not belong to the comparison.
ComparedFields read_compared_fields(const std::filesystem::path& file, const ComparedCandidates& all);

}  // namespace treadmark::app::report
