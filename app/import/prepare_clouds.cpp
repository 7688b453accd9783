// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/prepare_clouds.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/import/find_place.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/cleaning/register_scans.hpp"
#include "treadmark/scans/placement/band_frame.hpp"
#include "treadmark/scans/strays/mixed_points.hpp"

namespace treadmark::app {
namespace {

void drop_mixed_points(PointCloud& cloud, io::ImportReport& report) {
  if (cloud.stations.empty()) return;
  const scans::MixedPoints mixed = scans::find_mixed_points(cloud);
  report.removed.push_back({"mixed points", mixed.count,
                            mixed.in_order
                                ? "between two surfaces, both of which the laser's spot met, and at such edges"
                                : "not looked for: the points do not follow each other as the scanner saw them"});
  if (mixed.count > 0) keep_points(cloud, [&](std::size_t i) { return mixed.of_point[i] == 0; });
}

void lay_scans(Clouds& clouds, const io::ImportSettings& settings, io::ImportReport& report) {
  PointCloud& cloud = clouds.cloud;
  std::optional<LengthUnit> unit = clouds.unit ? clouds.unit : clouds.usual_unit;
  if (settings.scan.unit != "auto") unit = length_unit(settings.scan.unit);
  if (!unit)
    throw Error(ErrorKind::configuration, "laying scans on each other (scan.register_mm) needs their unit", {},
                "say it with --unit");
  const double factor = metres_per(*unit);
  std::vector<Vec3> points = cloud.points;
  for (Vec3& p : points) p *= factor;
  const std::vector<scans::ScanMotion> motions =
      scans::register_scans(points, cloud.passes, kMillimetre * settings.scan.register_mm);
  if (motions.empty())
    throw Error(ErrorKind::configuration, "scan.register_mm lays scans on each other, and this is one alone", {},
                "leave it out, or number the scans by a column pass or by files of their own");
  std::map<std::uint16_t, Pose> of_pass;
  for (const scans::ScanMotion& one : motions) {
    of_pass[one.pass] = Pose{one.motion.origin / factor, one.motion.rotation};
    report.registrations.push_back(
        {one.pass, one.points, one.overlap, one.apart, one.shift, one.turn, one.shift_error, one.turn_error, one.open});
    if (one.open > 0)
      report.warnings.push_back(fmt::format(
          "scan_open: where scan {} overlaps with others the points do not tell {} of the six directions in "
          "which it may be off, as a plain rail tells no shift along it: there it stays where its file has it",
          one.pass, one.open));
  }
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    cloud.points[i] = of_pass.at(cloud.passes[i]).apply(cloud.points[i]);
  for (auto& [pass, place] : cloud.stations)
    if (const auto found = of_pass.find(pass); found != of_pass.end()) place = found->second.apply(place);
}

constexpr std::size_t kAngles = 8, kIntensities = 8;  // classes

/// Angle between the beam and the surface, in eighths of a right angle.
scans::NoiseProperty angles_of(const PlacedScan& scan, const scans::Projection& projection) {
  scans::NoiseProperty out(scan.points.size(), 0);
  const scans::BandPoints& points = projection.points;
  const scans::Band& band = projection.band;
  constexpr std::size_t kBlock = 4096;
  parallel_blocks(points.size(), kBlock, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::uint32_t index = points.index[i];
      const Vec3* const station = station_of(scan.stations, scan.passes, index);
      if (station == nullptr) continue;
      Vec3 place = scan.points[index];
      const double u = (band.a_min + points.a[i]) / band.radius;
      Vec3 normal = scan.placement.X_CS.rotation * scans::direction(band.body, u, band.section.at(points.s[i]).normal);
      if (scan.straightened()) {
        const Pose frame = scan.line->line.at(place.x());
        place = frame.apply({0.0, place.y(), place.z()});
        normal = frame.rotation * normal;
      }
      const Vec3 beam = *station - place;
      const double angle = std::acos(std::clamp(normal.dot(beam) / std::max(beam.norm(), 1e-9), 0.0, 1.0));
      out[index] = to_whole<std::uint16_t>(2.0 * angle / kPi * kAngles, 0.0, kAngles - 1.0);
    }
  });
  return out;
}

/// Eighths of the points by their intensity; those without one among the weakest.
scans::NoiseProperty intensities_of(const PlacedScan& scan, const scans::BandPoints& points, std::vector<float>& ends) {
  std::vector<float> sorted;
  for (const std::uint32_t index : points.index)
    if (!std::isnan(scan.intensities[index])) sorted.push_back(scan.intensities[index]);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 1; k < kIntensities && !sorted.empty(); ++k)
    ends.push_back(sorted[k * (sorted.size() - 1) / kIntensities]);
  scans::NoiseProperty out(scan.points.size(), 0);
  for (const std::uint32_t index : points.index)
    if (const float own = scan.intensities[index]; !std::isnan(own))
      out[index] = static_cast<std::uint16_t>(std::lower_bound(ends.begin(), ends.end(), own) - ends.begin());
  return out;
}

}  // namespace

Clouds read_points(const ImportRequest& request, io::ImportReport& report, const Progress& progress) {
  Clouds out = read_clouds(request, report, progress);
  if (request.settings.clean.mixed_points) drop_mixed_points(out.cloud, report);
  if (request.settings.scan.register_mm > 0.0) lay_scans(out, request.settings, report);
  return out;
}

void weigh_points(const PlacedScan& scan, scans::Projection& projection, const scans::NoiseSettings& settings,
                  scans::LocalNoise& noise, io::ImportReport& report) {
  enum Kind { pass, angle, intensity };
  std::vector<Kind> kinds;
  std::vector<scans::NoiseProperty> properties;
  std::vector<float> ends;
  if (!scan.passes.empty()) kinds.push_back(pass), properties.push_back(scan.passes);
  if (!scan.stations.empty()) kinds.push_back(angle), properties.push_back(angles_of(scan, projection));
  if (!scan.intensities.empty())
    kinds.push_back(intensity), properties.push_back(intensities_of(scan, projection.points, ends));
  for (const scans::NoiseClass& one : scans::find_noise_factors(projection.points, properties, settings, noise)) {
    constexpr double kRight = 90.0;  // degrees
    const std::size_t k = one.number;
    const Kind kind = kinds[one.property];
    report.noise_classes.push_back(
        {kind == pass      ? fmt::format("pass {}", k)
         : kind == angle   ? fmt::format("{:g} to {:g} degrees to the beam", kRight * static_cast<double>(k) / kAngles,
                                         kRight * static_cast<double>(k + 1) / kAngles)
         : k == 0          ? fmt::format("intensity up to {:g}", ends.front())
         : k < ends.size() ? fmt::format("intensity {:g} to {:g}", ends[k - 1], ends[k])
                           : fmt::format("intensity beyond {:g}", ends.back()),
         one.points, one.factor});
  }
  noise.residual = {};
}

}  // namespace treadmark::app
