// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_fields.hpp"

#include "treadmark/io/results/comparison_digest.hpp"

namespace treadmark::io {
namespace {

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
  std::vector<NamedField> out{{"backend", body.backend},
                              {"resolution_mm", resolution_mm(body.resolution)},
                              {"build_s", body.build_seconds},
                              {"memory_bytes", count(body.memory_bytes)}};
  for (const auto& [name, value, factor] : kDifferenceNumbers)
    out.push_back({name, difference.points > 0 ? difference.*value * factor : kNaN});
  out.push_back({"points", count(difference.points)});
  out.push_back({"missing", count(difference.missing)});
  out.push_back({"note", body.note});
  return out;
}

std::vector<NamedField> row_fields(const ComparisonCandidate& candidate, const ComparisonRow& row) {
  const CandidateDigest all = digest(candidate);
  std::vector<NamedField> out{{"backend", candidate.name},
                              {"wheel_backend", candidate.wheel.backend},
                              {"rail_backend", candidate.rail.backend},
                              {"resolution_mm", resolution_mm(candidate.resolution)},
                              {"case", std::int64_t{row.case_number}},
                              {"status", std::string(to_string(row.status))},
                              {"height_max_um", all.height_max * kMicro},
                              {"height_rms_um", all.height_rms * kMicro},
                              {"slope_max_mrad", all.slope_max * kMilli},
                              {"curvature_max_per_m", all.curvature_max}};
  for (const auto& [name, value, factor] : kRowPatchNumbers)
    out.push_back({name, row.patches > 0 ? row.*value * factor : kNaN});
  out.push_back({"ncon", std::int64_t{row.ncon}});
  out.push_back({"patches", std::int64_t{row.patches}});
  for (const auto& [name, value, factor] : kRowTimes) out.push_back({name, row.*value * factor});
  out.push_back({"build_s", all.build_s});
  out.push_back({"memory_bytes", count(all.memory_bytes)});
  for (const auto& [name, value, factor] : kRowErrors)
    out.push_back({name, row.comparable ? FieldValue(row.*value * factor) : FieldValue()});
  return out;
}

}  // namespace treadmark::io
