// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/comparison_store.hpp"

#include <fmt/format.h>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/results/file_layout.hpp"
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
  AtomicFile target(path);
  Hdf5Writer file(target.temporary(), path.string());
  file.root().add(std::vector<Attribute>{{"format", std::string(kFormat)},
                                         {"units", "SI"},
                                         {"axes", std::string(kAxes)},
                                         {"version", comparison.version},
                                         {"git", comparison.git},
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
  file.close();
  target.commit();
}

Comparison read_comparison_fields(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const Hdf5GroupReader& root = file.root();
  require_format(root, kFormat);
  Comparison out;
  out.version = root.text("version");
  out.git = root.text("git");
  out.input_file = root.text("input");
  out.input_sha256 = root.text("sha256");
  out.settings = root.texts("settings");
  out.truth = root.text("truth");
  out.complete = root.integer("complete") != 0;
  for (std::string name = group_name(0); root.has(name); name = group_name(out.candidates.size()))
    out.candidates.push_back(read_candidate(root.open_group(name)));
  return out;
}

}  // namespace treadmark::io
