// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/read_clouds.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::app {
namespace {

/// The least and the next value along an axis, seen one way or the other, and how many share the first.
struct FarEnd {
  double first = std::numeric_limits<double>::infinity(), second = first;
  std::size_t count = 0;

  void look_at(double value) {
    if (value == first) {
      ++count;
    } else if (value < first) {
      second = first;
      first = value;
      count = 1;
    } else {
      second = std::min(second, value);
    }
  }
};

/// Leaves out points whose coordinate says that there is none: many share it, and it is far from all others.
void drop_no_data(PointCloud& cloud, io::ImportReport& report) {
  constexpr std::size_t kMostValues = 6;
  constexpr double kFewest = 10.0, kLeastShare = 1e-4, kFar = 10.0;
  std::vector<Vec3>& points = cloud.points;
  for (std::size_t round = 0; round < kMostValues; ++round) {
    std::array<FarEnd, 3> low, high;
    for (const Vec3& p : points)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = p[static_cast<Eigen::Index>(axis)];
        low[axis].look_at(value);
        high[axis].look_at(-value);
      }
    const auto no_data = [&](const FarEnd& end, const FarEnd& other) {
      const double rest = -other.first - end.second;
      return static_cast<double>(end.count) >= std::max(kFewest, kLeastShare * static_cast<double>(points.size())) &&
             std::isfinite(end.second) && rest > 0.0 && end.second - end.first > kFar * rest;
    };
    std::optional<std::pair<std::size_t, double>> found;
    for (std::size_t axis = 0; axis < 3 && !found; ++axis) {
      if (no_data(low[axis], high[axis]))
        found = {axis, low[axis].first};
      else if (no_data(high[axis], low[axis]))
        found = {axis, -high[axis].first};
    }
    if (!found) return;
    const std::size_t axis = found->first;
    const double value = found->second;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i][static_cast<Eigen::Index>(axis)] == value) continue;
      points[kept] = points[i];
      if (!cloud.passes.empty()) cloud.passes[kept] = cloud.passes[i];
      ++kept;
    }
    report.removed.push_back({"no data", points.size() - kept,
                              fmt::format("{} = {:g}, far from all others", std::string_view("xyz")[axis], value)});
    points.resize(kept);
    if (!cloud.passes.empty()) cloud.passes.resize(kept);
  }
}

}  // namespace

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
    out.usual_unit = scan.usual_unit;
    if (out.reference.empty()) out.reference = scan.reference;
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
  drop_no_data(out.cloud, report);
  if (withheld > 0) report.removed.push_back({"withheld", withheld, "marked as deleted in the file"});
  return out;
}

}  // namespace treadmark::app
