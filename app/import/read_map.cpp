// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/read_map.hpp"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::app {

namespace {

/// How well deviations, averaged along the band, follow the section itself: correlation and slope over the section's
/// heights, that is of -z of a rail and of the radius of a wheel.
struct LikeSection {
  double correlation = 0.0, slope = 0.0;
};
LikeSection like_section(const OffsetMap& map, const scans::Section& section) {
  std::vector<Vec2> means;  // height of the section, mean deviation
  for (int iy = 0; iy < map.grid.ny; ++iy) {
    const double y = map.grid.y0 + map.grid.dy * iy;
    if (y < section.y_min() || y > section.y_max()) continue;
    double sum = 0.0, count = 0.0;
    for (int ix = 0; ix < map.grid.nx; ++ix) {
      const double value = map.offset[static_cast<std::size_t>(ix) +
                                      static_cast<std::size_t>(map.grid.nx) * static_cast<std::size_t>(iy)];
      if (std::isnan(value)) continue;
      sum += value;
      count += 1.0;
    }
    if (count > 0.0) means.emplace_back(section.v_at(y), sum / count);
  }
  LikeSection out;
  constexpr std::size_t kFewest = 8;
  if (means.size() < kFewest) return out;
  Vec2 mean = Vec2::Zero();
  for (const Vec2& p : means) mean += p;
  mean /= static_cast<double>(means.size());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const Vec2& p : means) {
    const Vec2 d = p - mean;
    xx += d.x() * d.x();
    xy += d.x() * d.y();
    yy += d.y() * d.y();
  }
  if (!(xx > 0.0) || !(yy > 0.0)) return out;
  return {xy / std::sqrt(xx * yy), xy / xx};
}

}  // namespace

PlacedScan read_map(const ImportRequest& request, io::ImportReport& report) {
  const io::ImportSettings& settings = request.settings;
  PlacedScan scan;
  scan.body = body_of(request);
  const bool wheel = scan.body == Body::wheel;
  read_nominal(request, scan);
  const SourcePosition where{request.scans.front().string()};
  if (scan.nominal.empty())
    throw Error(ErrorKind::configuration, "a map of deviations needs the profile that they deviate from", where,
                "say --nominal");
  const double radius = 1e-3 * settings.placement.nominal_radius_mm;
  if (wheel && !(radius > 0.0))
    throw Error(ErrorKind::configuration, "a map of a wheel needs its nominal radius", where, "say --nominal-radius");
  io::MapReadOptions how;
  how.body = scan.body;
  how.nominal_radius = radius;
  if (settings.scan.unit != "auto") how.unit = length_unit(settings.scan.unit);
  if (settings.map.height_unit != "auto") how.height_unit = length_unit(settings.map.height_unit);
  how.angles_deg = settings.map.angles_deg;
  how.asked_by = where;
  const OffsetMap map = io::read_deviation_map(request.scans.front(), how);
  report.from_map = true;
  report.unit = settings.scan.unit == "auto" ? "mm" : settings.scan.unit;
  report.unit_from = settings.scan.unit == "auto" ? "the file, or else mm" : "given";
  report.nominal = settings.placement.nominal;

  std::vector<Vec2> curve;
  for (const Vec2& p : scan.nominal) curve.emplace_back(p.x(), wheel ? p.y() + radius : -p.y());
  scan.placement.section = scans::Section(curve);
  scan.placement.nominal_radius = radius;
  constexpr double kAlike = 0.95, kLeastSlope = 0.3;
  if (const LikeSection like = like_section(map, scan.placement.section);
      std::fabs(like.correlation) > kAlike && std::fabs(like.slope) > kLeastSlope) {
    scan.doubts.push_back(
        {"heights", fmt::format("the deviations follow the section itself (correlation {:.3f}, {:.2g} times its "
                                "heights): are these heights? say map.values = heights then",
                                like.correlation, like.slope)});
    report.warnings.push_back(scan.doubts.back().text);
  }
  const Grid2& g = map.grid;
  std::size_t missing = 0, beside = 0;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const double value =
          map.offset[static_cast<std::size_t>(ix) + static_cast<std::size_t>(g.nx) * static_cast<std::size_t>(iy)];
      const double u = g.x0 + g.dx * ix, y = g.y0 + g.dy * iy;
      if (std::isnan(value)) {
        ++missing;
        continue;
      }
      if (y < scan.placement.section.y_min() || y > scan.placement.section.y_max()) {
        ++beside;
        continue;
      }
      // positive: along +z of a rail, into the material; along +r of a wheel, out of it
      const double v = scan.placement.section.v_at(y) + (wheel ? value : -value);
      scan.points.push_back(scans::from_natural(scan.body, {u, y, v}));
    }
  report.spacing = std::sqrt(g.dx * (wheel ? radius : 1.0) * g.dy);
  report.points_read = map.offset.size();
  report.inputs.push_back({request.scans.front().filename().string(), io::sha256_file(request.scans.front()),
                           fmt::format("map of {} x {} deviations", g.nx, g.ny), map.offset.size(), missing});
  if (missing > 0) report.removed.push_back({"no data", missing, "empty values of the map"});
  if (beside > 0)
    report.removed.push_back(
        {"beside the profile", beside, "at lateral positions that the nominal profile does not have"});
  return scan;
}

}  // namespace treadmark::app
