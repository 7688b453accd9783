// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/compared_candidates.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark::app::report {
namespace {

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool belongs(const JsonTree& row, const ComparedCandidate& candidate) {
  return row.text("backend") == candidate.backend && same(row.number("resolution_mm"), candidate.resolution_mm) &&
         row.text("wheel_backend") == candidate.wheel.text("backend") &&
         row.text("rail_backend") == candidate.rail.text("backend");
}

/// fmax passes over what is not known.
double worse(const ComparedCandidate& candidate, const char* key) {
  return std::fmax(candidate.wheel.number(key), candidate.rail.number(key));
}

double largest(const ComparedCandidate& candidate, const char* key) {
  double most = ComparedCandidate::kNone;
  for (const auto& row : candidate.rows)
    if (row) most = std::fmax(most, std::fabs(row->number_or_nan(key)));
  return most;
}

double mean(const ComparedCandidate& candidate, const char* key) {
  double sum = 0.0, count = 0.0;
  for (const auto& row : candidate.rows) {
    const double value = row ? row->number(key) : ComparedCandidate::kNone;
    if (!std::isfinite(value)) continue;
    sum += value;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : ComparedCandidate::kNone;
}

ComparedCandidate read_candidate(const JsonTree& node) {
  ComparedCandidate out{node.text("backend"), {}, {}, node.number("resolution_mm"), node.at("wheel"),
                        node.at("rail"),      {}};
  if (out.resolution_mm == 0.0) out.resolution_mm = ComparedCandidate::kNone;
  out.label = out.as_given() ? out.backend : fmt::format("{} {:.4g} mm", out.backend, out.resolution_mm);
  if (const auto failure = node.find("failure")) out.failure = failure->text();
  return out;
}

void add_figures(ComparedCandidate& c) {
  c.pmax_error_percent = largest(c, "pmax_error_percent");
  c.area_error_percent = largest(c, "area_error_percent");
  c.force_error_percent = largest(c, "force_error_percent");
  c.position_error_mm = largest(c, "position_error_mm");
  c.mean_search_s = mean(c, "search_s");
  c.mean_distance_s = mean(c, "distance_s");
  for (const auto& row : c.rows)
    if (row) {
      ++c.solved;
      if (row->text("status") == "ok") ++c.ok;
    }
  if (!c.failure.empty()) return;  // what there is of it was not measured
  c.height_max_um = worse(c, "height_max_um");
  c.height_rms_um = worse(c, "height_rms_um");
  c.slope_max_mrad = worse(c, "slope_max_mrad");
  c.curvature_max_per_m = worse(c, "curvature_max_per_m");
  c.build_s = c.wheel.number("build_s") + c.rail.number("build_s");
  c.memory_bytes = static_cast<double>(c.wheel.count("memory_bytes") + c.rail.count("memory_bytes"));
}

}  // namespace

ComparedCandidates read_compared(const JsonTree& comparison) {
  ComparedCandidates out;
  for (const JsonTree& node : comparison.at("candidates").items()) out.candidates.push_back(read_candidate(node));
  const std::vector<JsonTree> rows = comparison.at("rows").items();
  for (const JsonTree& row : rows) out.cases.push_back(row.at("case").integer());
  std::ranges::sort(out.cases);
  out.cases.erase(std::unique(out.cases.begin(), out.cases.end()), out.cases.end());
  for (ComparedCandidate& candidate : out.candidates) candidate.rows.resize(out.cases.size());
  for (const JsonTree& row : rows) {
    const auto candidate =
        std::ranges::find_if(out.candidates, [&](const ComparedCandidate& c) { return belongs(row, c); });
    if (candidate == out.candidates.end()) row.refuse("belongs to none of the candidates");
    const auto place = std::ranges::lower_bound(out.cases, row.at("case").integer()) - out.cases.begin();
    candidate->rows[static_cast<std::size_t>(place)] = row;
  }
  for (ComparedCandidate& candidate : out.candidates) add_figures(candidate);
  return out;
}

}  // namespace treadmark::app::report
