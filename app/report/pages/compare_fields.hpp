// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/app/report/page.hpp"
#include "treadmark/app/report/pages/compared_candidates.hpp"
#include "treadmark/io/results/comparison_model.hpp"

namespace treadmark::app::report {

/// Contact fields of a comparison: a set a candidate that was solved, the truth first, with a frame for every case of
/// the comparison. Where a candidate lacks a case its frame says so.
struct ComparedFields {
  std::vector<FrameSet> sets;
  std::vector<io::SampledSurface> surfaces;    ///< that the frames name; may be empty
  std::shared_ptr<const io::RunResult> truth;  ///< cases of the first candidate, for the axes of the timeline
};

/// From candidates with their results, and from the file of them. Errors: those of its reader; Error(input_data),
/// naming the file, where it does not belong to the comparison: a solved candidate or a case of the truth is missing.
ComparedFields compared_fields(std::vector<io::ComparisonCandidate> stored, const ComparedCandidates& all,
                               const std::string& file);
ComparedFields read_compared_fields(const std::filesystem::path& file, const ComparedCandidates& all);

}  // namespace treadmark::app::report
