// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/app/pages/overlay_parts.hpp"
#include "treadmark/io/results/result_model.hpp"

namespace treadmark::app::pages {

/// Report of runs laid over each other, cases matched by their numbers as compare_results does. Errors:
/// Error(configuration) for less than two.
report::Page run_overlay_page(std::vector<Overlaid<io::RunResult>>&& runs);

struct NamedRun {
  std::string name;
  std::shared_ptr<const io::RunResult> result;  ///< never nullptr
};

/// Moves the surfaces of a run to those of a page, under names that begin with a prefix.
void take_surfaces(io::RunResult& run, const std::string& prefix, std::vector<io::SampledSurface>& all);

/// Gives a page the contact of runs, whose surfaces were taken: sets of frames, patches side by side, and the bodies of
/// all in one section. steps: names of the cases of all, by growing numbers.
void add_overlaid_contact(report::Page& page, report::Section& section, const std::vector<NamedRun>& runs,
                          const std::vector<std::string>& steps, std::vector<io::SampledSurface> surfaces);

}  // namespace treadmark::app::pages
