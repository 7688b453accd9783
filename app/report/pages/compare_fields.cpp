// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/compare_fields.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/report/pages/case_figures.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/results/comparison_store.hpp"

namespace treadmark::app::report {
namespace {

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw Error(ErrorKind::input_data, "the fields do not belong to the comparison: " + what, {file, 0, 0},
              "give a folder that one comparison wrote, or take the file of the fields away");
}

bool same(const io::ComparisonCandidate& stored, const ComparedCandidate& candidate) {
  constexpr double kMilli = 1e3, kClose = 1e-9;
  if (stored.name != candidate.backend) return false;
  if (candidate.as_given()) return !(stored.resolution > 0.0);
  return std::fabs(kMilli * stored.resolution - candidate.resolution_mm) <= kClose * candidate.resolution_mm;
}

io::CaseResult without_result(int number) {
  io::CaseResult result;
  result.number = number;
  result.status = Status::failed;
  result.message = "This representation has no result of this case.";
  return result;
}

/// The results in the order of the cases of the comparison; what is missing becomes a failure.
std::shared_ptr<const io::RunResult> in_order(std::vector<io::CaseResult> results, const std::vector<int>& cases) {
  auto run = std::make_shared<io::RunResult>();
  for (const int number : cases) {
    const auto found = std::ranges::find(results, number, &io::CaseResult::number);
    run->cases.push_back(found == results.end() ? without_result(number) : std::move(*found));
  }
  run->cases_total = static_cast<int>(run->cases.size());
  return run;
}

}  // namespace

ComparedFields compared_fields(std::vector<io::ComparisonCandidate> stored, const ComparedCandidates& all,
                               const std::string& file) {
  ComparedFields out;
  std::vector<std::string> frame_names;
  for (const ComparedCandidate& candidate : all.candidates) {
    if (candidate.solved == 0) continue;
    const auto found =
        std::ranges::find_if(stored, [&](const io::ComparisonCandidate& c) { return same(c, candidate); });
    if (found == stored.end()) refuse(file, fmt::format("there are none of {}", candidate.label));
    const auto run = in_order(std::move(found->results), all.cases);
    const bool truth = &candidate == all.truth();
    if (truth) {
      out.truth = run;
      out.surfaces = std::move(found->surfaces);
    }
    FrameSet set = frames_of(run, candidate.label + (truth ? " (truth)" : ""));
    // the truth's cases give the steps their names; a case without a result has no position of its own
    if (frame_names.empty())
      for (const Frame& frame : set.frames) frame_names.push_back(frame.name);
    else
      for (std::size_t i = 0; i < set.frames.size(); ++i) set.frames[i].name = frame_names[i];
    stored.erase(found);
    out.sets.push_back(std::move(set));
  }
  if (!out.truth) refuse(file, "there are none of the truth");
  return out;
}

ComparedFields read_compared_fields(const std::filesystem::path& file, const ComparedCandidates& all) {
  return compared_fields(io::read_comparison_fields(file).candidates, all, file.string());
}

}  // namespace treadmark::app::report
