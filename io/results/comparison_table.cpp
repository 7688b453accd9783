// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/results/comparison_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "treadmark/core/output_file.hpp"
#include "treadmark/io/results/comparison_model.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/shown.hpp"

namespace treadmark::io {

namespace {

constexpr std::size_t kColumns = 16;
using Line = std::vector<std::string>;

const std::array<Line, 3> kHead{{
    {"backend", "resolution", "height", "height", "slope", "curvature", "pmax", "pmean", "force", "position", "area",
     "search", "distance", "build", "memory", "cases"},
    {"", "", "max", "rms", "max", "max", "error", "error", "error", "error", "error", "", "", "", "", "ok"},
    {"", "[mm]", "[um]", "[um]", "[mrad]", "[1/m]", "[%]", "[%]", "[%]", "[mm]", "[%]", "[ms]", "[ms]", "[s]", "[MB]",
     ""},
}};

/// On one line.
std::string flat(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

Line candidate_line(const ComparisonCandidate& candidate) {
  const CandidateDigest all = digest(candidate);
  Line line(kColumns);
  line[0] = flat(candidate.name);
  line[1] = candidate.resolution == 0.0 ? "-" : in_short(candidate.resolution * 1e3);
  if (!candidate.failure.empty()) {
    std::fill(line.begin() + 2, line.end(), std::string(1, '-'));
    line.back() = "failed";
    return line;
  }
  const double values[] = {all.height_max * 1e6,
                           all.height_rms * 1e6,
                           all.slope_max * 1e3,
                           all.curvature_max,
                           all.pmax_error * 1e2,
                           all.mean_pressure_error * 1e2,
                           all.force_error * 1e2,
                           all.position_error * 1e3,
                           all.area_error * 1e2,
                           all.search_s * 1e3,
                           all.distance_s * 1e3,
                           all.build_s,
                           static_cast<double>(all.memory_bytes) * 1e-6};
  std::transform(std::begin(values), std::end(values), line.begin() + 2, in_short);
  line.back() = fmt::format("{}/{}", all.ok, all.total);
  return line;
}

/// What the numbers above do not say: "mesh 0.5 mm, case 3: failed (why)".
std::string remarks(const ComparisonCandidate& candidate) {
  const std::string label = flat(candidate_label(candidate));
  std::string out;
  if (!candidate.failure.empty()) out += fmt::format("{}: failed: {}\n", label, flat(candidate.failure));
  for (const ComparisonRow& row : candidate.rows) {
    if (row.status == Status::ok) continue;
    out += fmt::format("{}, case {}: {}", label, row.case_number, to_string(row.status));
    out += row.message.empty() ? "\n" : fmt::format(" ({})\n", flat(row.message));
  }
  const auto note = [&](const char* name, const RepresentedBody& body) {
    if (!body.note.empty()) out += fmt::format("{}, {}: {}\n", label, name, flat(body.note));
    if (body.difference.missing > 0)
      out += fmt::format("{}, {}: no surface at {} points where the reference has one\n", label, name,
                         body.difference.missing);
  };
  note("wheel", candidate.wheel);
  note("rail", candidate.rail);
  return out;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  std::vector<Line> lines(kHead.begin(), kHead.end());
  for (const ComparisonCandidate& candidate : comparison.candidates) lines.push_back(candidate_line(candidate));

  std::string out = table_text(lines, {2, 6, 11});
  if (!comparison.candidates.empty())
    out += fmt::format("errors are those against the first, {}\n", flat(comparison.candidates.front().name));
  if (const std::vector<int> cases = cases_without_limit(comparison); !cases.empty())
    out += fmt::format(
        "case {}: the largest pressure has no limit (edge_pressure) and tells nothing of representations; force, mean "
        "pressure and area do\n",
        fmt::join(cases, ", "));
  for (const ComparisonCandidate& candidate : comparison.candidates) out += remarks(candidate);
  if (!comparison.complete) out += "interrupted: some candidates or cases are missing\n";
  return out;
}

std::string to_csv(const Comparison& comparison) {
  std::vector<ComparedRow> rows;
  for (const ComparisonCandidate& candidate : comparison.candidates)
    for (const ComparisonRow& row : candidate.rows) rows.push_back(compared_row(candidate, row));
  return csv_of(rows);
}

void write_csv(const std::filesystem::path& path, const Comparison& comparison) {
  write_file(path, to_csv(comparison));
}

}  // namespace treadmark::io
