// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/read_clouds.hpp"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::app {

Clouds read_clouds(const ImportRequest& request, io::ImportReport& report, const Progress& progress) {
  Clouds out;
  std::size_t not_finite = 0, withheld = 0;
  std::map<std::pair<std::size_t, std::uint16_t>, std::uint16_t> pass_number;
  Progress quiet;
  quiet.stop = progress.stop;
  for (std::size_t file = 0; file < request.scans.size(); ++file) {
    io::ScanReadOptions options;
    options.asked_by = {request.scans[file].string()};
    io::Scan scan = io::read_scan(request.scans[file], options, quiet);
    report.inputs.push_back({request.scans[file].filename().string(), io::sha256_file(request.scans[file]), scan.format,
                             scan.points_in_file, scan.not_finite});
    not_finite += scan.not_finite;
    withheld += scan.withheld;
    if (file > 0 && scan.unit != out.unit)
      throw Error(ErrorKind::input_data, "the scans are in different units", {request.scans[file].string()},
                  "say the unit of all of them with --unit, or convert them first");
    out.unit = scan.unit;
    const std::size_t before = out.cloud.points.size();
    if (file == 0) {
      out.cloud = std::move(scan.cloud);
    } else {
      out.cloud.points.insert(out.cloud.points.end(), scan.cloud.points.begin(), scan.cloud.points.end());
    }
    if (request.scans.size() > 1) {
      // a pass of a file is a pass of its own
      const std::vector<std::uint16_t> own = file == 0 ? std::move(out.cloud.passes) : std::move(scan.cloud.passes);
      if (file == 0) out.cloud.passes.clear();
      for (std::size_t i = before; i < out.cloud.points.size(); ++i) {
        const auto key = std::pair{file, own.empty() ? std::uint16_t{0} : own[i - before]};
        out.cloud.passes.push_back(
            pass_number.emplace(key, static_cast<std::uint16_t>(pass_number.size())).first->second);
      }
    }
  }
  out.cloud.normals.clear();  // surfaces tell their own
  out.cloud.normals.shrink_to_fit();
  out.cloud.name = request.scans.front().string();
  report.points_read = out.cloud.points.size() + not_finite + withheld;
  if (not_finite > 0)
    report.removed.push_back(
        {"not finite", not_finite, "coordinates that are no numbers, as scanners write for lost points"});
  if (withheld > 0) report.removed.push_back({"withheld", withheld, "marked as deleted in the file"});
  return out;
}

}  // namespace treadmark::app
