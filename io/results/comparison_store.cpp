// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_store.hpp"

#include <fmt/format.h>

#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/write_hdf5.hpp"

namespace treadmark::io {

namespace {

constexpr const char* kFormat = "treadmark comparison 1";

std::string group_name(std::size_t index) { return fmt::format("candidate_{:02}", index + 1); }

ComparisonCandidate read_candidate(const Hdf5GroupReader& group) {
  ComparisonCandidate c;
  c.name = group.text("name");
  c.resolution = group.number("resolution");
  c.failure = group.text("failure");
  c.results = read_cases(group);
  c.surfaces = read_surfaces(group);
  check_surface_names(group, c.results, c.surfaces);
  return c;
}

}  // namespace

void write_comparison_fields(const std::filesystem::path& path, const Comparison& comparison) {
  Hdf5Writer file(path);
  file.root().add(std::vector<Attribute>{{"format", std::string(kFormat)},
                                         {"units", "SI"},
                                         {"axes", std::string(kAxes)},
                                         {"version", comparison.version},
                                         {"git", comparison.git},
                                         {"title", comparison.title},
                                         {"input", comparison.input_file},
                                         {"sha256", comparison.input_sha256},
                                         {"settings", comparison.settings},
                                         {"truth", comparison.truth},
                                         {"complete", comparison.complete ? 1 : 0}});
  for (std::size_t i = 0; i < comparison.candidates.size(); ++i) {
    const ComparisonCandidate& c = comparison.candidates[i];
    const Hdf5GroupWriter group = file.root().make_group(group_name(i));
    group.add(std::vector<Attribute>{{"name", c.name}, {"resolution", c.resolution}, {"failure", c.failure}});
    for (const CaseResult& result : c.results)
      write_case(group.make_group(fmt::format("case_{:04}", result.number)), result, CaseTimes::written);
    write_surfaces(group, c.surfaces);
  }
  file.commit();
}

Comparison read_comparison_fields(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  require_format(root, kFormat);
  Comparison out;
  out.version = root.text("version");
  out.git = root.text("git");
  if (root.has_attribute("title")) out.title = root.text("title");
  out.input_file = root.text("input");
  out.input_sha256 = root.text("sha256");
  out.settings = root.texts("settings");
  out.truth = root.text("truth");
  out.complete = root.integer("complete") != 0;
  for (std::string name = group_name(0); root.has(name); name = group_name(out.candidates.size()))
    out.candidates.push_back(read_candidate(root.open_group(name)));
  return out;
}

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
  const auto add_error = [&](const NamedNumber<ComparisonRow>& error) {
    out.push_back({error.name, row.comparable ? FieldValue(row.*error.value * error.factor) : FieldValue()});
  };
  add_error(kMeanPressureError);
  for (const NamedNumber<ComparisonRow>& error : kRowErrors) add_error(error);
  return out;
}

}  // namespace treadmark::io
