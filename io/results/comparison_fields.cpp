// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_fields.hpp"

#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/comparison_digest.hpp"

namespace treadmark::io {
namespace {

constexpr double kPercent = 1e2;

double resolution_mm(double resolution) { return resolution == 0.0 ? kNaN : resolution * kMilli; }

std::int64_t count(std::size_t value) { return static_cast<std::int64_t>(value); }

}  // namespace

std::vector<NamedField> candidate_fields(const ComparisonCandidate& candidate) {
  std::vector<NamedField> out{{"backend", candidate.name}, {"resolution_mm", resolution_mm(candidate.resolution)}};
  if (!candidate.failure.empty()) out.push_back({"failure", candidate.failure});
  return out;
}

std::vector<NamedField> body_fields(const RepresentedBody& body) {
  const SurfaceDifference& difference = body.difference;
  const auto measured = [&](double value) { return difference.points > 0 ? value : kNaN; };
  return {{"backend", body.backend},
          {"resolution_mm", resolution_mm(body.resolution)},
          {"build_s", body.build_seconds},
          {"memory_bytes", count(body.memory_bytes)},
          {"height_max_um", measured(difference.height_max * kMicro)},
          {"height_rms_um", measured(difference.height_rms * kMicro)},
          {"slope_max_mrad", measured(difference.slope_max * kMilli)},
          {"slope_rms_mrad", measured(difference.slope_rms * kMilli)},
          {"curvature_max_per_m", measured(difference.curvature_max)},
          {"curvature_rms_per_m", measured(difference.curvature_rms)},
          {"points", count(difference.points)},
          {"missing", count(difference.missing)},
          {"note", body.note}};
}

std::vector<NamedField> row_fields(const ComparisonCandidate& candidate, const ComparisonRow& row) {
  const CandidateDigest all = digest(candidate);
  const auto of_patch = [&](double value) { return row.patches > 0 ? value : kNaN; };
  const auto error = [&](double value) { return row.comparable ? FieldValue(value) : FieldValue(); };
  return {{"backend", candidate.name},
          {"wheel_backend", candidate.wheel.backend},
          {"rail_backend", candidate.rail.backend},
          {"resolution_mm", resolution_mm(candidate.resolution)},
          {"case", std::int64_t{row.case_number}},
          {"status", std::string(to_string(row.status))},
          {"height_max_um", all.height_max * kMicro},
          {"height_rms_um", all.height_rms * kMicro},
          {"slope_max_mrad", all.slope_max * kMilli},
          {"curvature_max_per_m", all.curvature_max},
          {"pmax_MPa", of_patch(row.pmax * kMega)},
          {"fn_N", of_patch(row.fn)},
          {"fx_N", of_patch(row.fx)},
          {"fs_N", of_patch(row.fs)},
          {"x_tr_mm", of_patch(row.x_tr * kMilli)},
          {"y_tr_mm", of_patch(row.y_tr * kMilli)},
          {"approach_mm", of_patch(row.approach * kMilli)},
          {"area_mm2", of_patch(row.area * kMicro)},
          {"ncon", std::int64_t{row.ncon}},
          {"patches", std::int64_t{row.patches}},
          {"search_s", row.search_s},
          {"distance_s", row.distance_s},
          {"build_s", all.build_s},
          {"memory_bytes", count(all.memory_bytes)},
          {"pmax_error_percent", error(row.pmax_error * kPercent)},
          {"area_error_percent", error(row.area_error * kPercent)},
          {"approach_error_percent", error(row.approach_error * kPercent)},
          {"force_error_percent", error(row.force_error * kPercent)},
          {"position_error_mm", error(row.position_error * kMilli)}};
}

}  // namespace treadmark::io
