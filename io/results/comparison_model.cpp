// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::io {

namespace {

double worse(const ComparisonCandidate& candidate, double SurfaceDifference::*value) {
  double out = kNaN;
  for (const RepresentedBody* body : {&candidate.wheel, &candidate.rail})
    if (body->difference.points > 0) out = std::fmax(out, body->difference.*value);  // fmax passes NaN over
  return out;
}

double largest(const ComparisonCandidate& candidate, double ComparisonRow::*value) {
  double out = kNaN;
  for (const ComparisonRow& row : candidate.rows)
    if (row.comparable && std::isfinite(row.*value)) out = std::fmax(out, std::abs(row.*value));
  return out;
}

double mean(const ComparisonCandidate& candidate, double ComparisonRow::*value) {
  double sum = 0.0;
  int count = 0;
  for (const ComparisonRow& row : candidate.rows) {
    if (!std::isfinite(row.*value)) continue;
    sum += row.*value;
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

}  // namespace

CandidateDigest digest(const ComparisonCandidate& candidate) {
  CandidateDigest out;
  out.height_max = worse(candidate, &SurfaceDifference::height_max);
  out.height_rms = worse(candidate, &SurfaceDifference::height_rms);
  out.slope_max = worse(candidate, &SurfaceDifference::slope_max);
  out.curvature_max = worse(candidate, &SurfaceDifference::curvature_max);
  out.pmax_error = largest(candidate, &ComparisonRow::pmax_error);
  out.mean_pressure_error = largest(candidate, &ComparisonRow::mean_pressure_error);
  out.area_error = largest(candidate, &ComparisonRow::area_error);
  out.force_error = largest(candidate, &ComparisonRow::force_error);
  out.position_error = largest(candidate, &ComparisonRow::position_error);
  out.search_s = mean(candidate, &ComparisonRow::search_s);
  out.distance_s = mean(candidate, &ComparisonRow::distance_s);
  out.build_s = candidate.wheel.build_seconds + candidate.rail.build_seconds;
  out.memory_bytes = candidate.wheel.memory_bytes + candidate.rail.memory_bytes;
  out.total = static_cast<int>(candidate.rows.size());
  for (const ComparisonRow& row : candidate.rows) out.ok += row.status == Status::ok;
  return out;
}

JudgedPressure judged_pressure(const Comparison& comparison) {
  const bool limited = cases_without_limit(comparison).empty() ||
                       ranges::any_of(comparison.candidates, [&](const ComparisonCandidate& c) {
                         return &c != comparison.candidates.data() && std::isfinite(digest(c).pmax_error);
                       });
  return limited ? JudgedPressure{"pmax", "largest pressure", &CandidateDigest::pmax_error}
                 : JudgedPressure{"pmean", "mean pressure", &CandidateDigest::mean_pressure_error};
}

std::vector<int> cases_without_limit(const Comparison& comparison) {
  std::vector<int> out;
  for (const ComparisonCandidate& candidate : comparison.candidates)
    for (const ComparisonRow& row : candidate.rows)
      if (row.comparable && std::isnan(row.pmax_error)) out.push_back(row.case_number);
  ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::string candidate_label(const ComparisonCandidate& candidate) {
  if (!std::isfinite(candidate.resolution) || candidate.resolution == 0.0) return candidate.name;
  return fmt::format("{} {:.4g} mm", candidate.name, candidate.resolution * 1e3);
}

std::string candidate_label(const Comparison& comparison, std::size_t index) {
  return candidate_label(comparison.candidates[index]) + (index == 0 ? " (reference)" : "");
}

}  // namespace treadmark::io
