// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string>

#include <fmt/format.h>

#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/surface_check.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::app {

bool is_cloud_file(const std::filesystem::path& file) { return io::is_scan_file(file) && !is_profile_file(file); }

CheckedProfile check_cloud(const std::filesystem::path& file) {
  const io::Scan scan = io::read_scan(file);
  CheckedProfile out;
  out.name = "points " + file.string();
  auto& facts = out.judgement.facts;
  facts.emplace_back("kind", "points of a scanner, " + scan.format);
  facts.emplace_back("points",
                     fmt::format("{}{}", scan.cloud.points.size(), scan.cloud.normals.empty() ? "" : ", with normals"));
  const std::string unit = scan.unit         ? fmt::format("{} (the file says it)", symbol(*scan.unit))
                           : scan.usual_unit ? fmt::format("{} (usual for such files)", symbol(*scan.usual_unit))
                                             : "not said: treadmark import judges it by the size, or takes --unit";
  facts.emplace_back("unit", unit);
  if (!scan.reference.empty()) facts.emplace_back("coordinates", scan.reference);
  if (!scan.cloud.points.empty()) {
    Vec3 low = scan.cloud.points.front(), high = low;
    for (const Vec3& p : scan.cloud.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const char* const axes[] = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis)
      facts.emplace_back(axes[axis], fmt::format("{:.7g} .. {:.7g} in the unit of the file", low[axis], high[axis]));
  }
  if (!scan.cloud.passes.empty()) {
    const auto [first, last] = ranges::minmax_element(scan.cloud.passes);
    facts.emplace_back("passes", fmt::format("{} .. {}", *first, *last));
  }
  if (scan.not_finite > 0)
    out.judgement.notes.push_back(
        fmt::format("{} of {} points are no numbers and left out", scan.not_finite, scan.points_in_file));
  if (scan.withheld > 0)
    out.judgement.notes.push_back(fmt::format("{} points are marked as deleted and left out", scan.withheld));
  out.judgement.notes.emplace_back(
      "place, side and noise are found by treadmark import, which makes a surface of them");
  return out;
}

}  // namespace treadmark::app
