// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/import/scan_surface.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string_view>
#include <system_error>

#include "treadmark/app/import/layout_line.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/line_scanner.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/io/tables/number.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {

namespace {

std::string vector_text(const Vec3& v, double factor, int digits) {
  return fmt::format("({:.{}f}, {:.{}f}, {:.{}f})", factor * v.x(), digits, factor * v.y(), digits, factor * v.z(),
                     digits);
}

}  // namespace

Scanned scan_surface(const std::filesystem::path& surface, const std::filesystem::path& cloud,
                     const ScanRequest& request, const Progress& progress) {
  io::require_written_scan(cloud);
  const CancellationScope scope(progress.stop);
  check_cancelled();
  const NaturalSurface natural = named_surface(surface, request.surface);
  Scanned out{surface, cloud, request.surface, request.scanner, request.unit, request.line, {}};
  out.settings.body = natural.spec.body;
  out.settings.nominal_radius = natural.spec.nominal_radius;
  const Region part = part_of(natural.spec.body, request.range_x, request.range_theta);
  out.settings.u_min = part.u_min;
  out.settings.u_max = part.u_max;
  if (!request.line.empty()) {
    if (natural.spec.body == Body::wheel)
      throw Error(ErrorKind::configuration, "a wheel does not lie along the line of a track", {request.line.string()},
                  "leave --line out");
    out.settings.line = layout_line(request.line).frames;
  }
  const Box3 box = natural.surface->bounds();
  if (natural.spec.body == Body::rail && !request.range_x && (std::isinf(box.min.x()) || std::isinf(box.max.x())))
    throw Error(ErrorKind::configuration, "this rail has no ends", {surface.string()},
                "say which part is scanned: --range-mm FROM,TO");
  out.scan = scans::scan_surface(*natural.surface, out.settings, progress);
  io::write_scan(cloud, out.scan.cloud, request.unit);
  return out;
}

std::string summary(const Scanned& scanned) {
  const scans::ScannerTruth& truth = scanned.scan.truth;
  std::string text = fmt::format(
      "{}: {} points of a {} in {}, {:.4g} mm apart on {:.6g} mm^2, {} {}, seed {}\n", scanned.cloud.string(),
      scanned.scan.cloud.points.size(), body_name(scanned.settings.body), symbol(scanned.unit), kMilli * truth.spacing,
      kMicro * truth.area, truth.passes.size(), truth.passes.size() == 1 ? "pass" : "passes", scanned.settings.seed);
  text += fmt::format("on the surface {}, outliers {}; lost: {} in holes, {} dropped out, {} too steep",
                      truth.on_surface, truth.outliers, truth.lost_holes, truth.lost_drop_outs, truth.lost_occlusion);
  text += scanned.settings.stands.empty() ? "\n" : fmt::format(", {} in shadow\n", truth.lost_shadow);
  if (!scanned.line.empty()) text += fmt::format("along the line of {}\n", scanned.line.string());
  const Mat3& R = truth.X_CS.rotation;
  text += fmt::format("surface in the cloud: origin {} mm, x axis {}, y axis {}, z axis {}\n",
                      vector_text(truth.X_CS.origin, kMilli, 6), vector_text(R.col(0), 1.0, 9),
                      vector_text(R.col(1), 1.0, 9), vector_text(R.col(2), 1.0, 9));
  return text;
}

namespace {

using io::Json;
using io::number;

constexpr double kDeg = 180.0 / std::numbers::pi;

Json vector(const Vec3& v, double factor) { return {factor * v.x(), factor * v.y(), factor * v.z()}; }

/// In full precision: as three rows of (x axis, y axis, z axis, origin) and one by one.
Json pose(const Pose& X) {
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i)
    rows.push_back({X.rotation(i, 0), X.rotation(i, 1), X.rotation(i, 2), kMilli * X.origin[i]});
  return {{"rows_mm", rows},
          {"origin_mm", vector(X.origin, kMilli)},
          {"x_axis", vector(X.rotation.col(0), 1.0)},
          {"y_axis", vector(X.rotation.col(1), 1.0)},
          {"z_axis", vector(X.rotation.col(2), 1.0)}};
}

/// null: all there is.
Json range(double low, double high, double factor) {
  if (std::isinf(low) && std::isinf(high)) return nullptr;
  return {number(factor * low), number(factor * high)};
}

Json settings_json(const scans::ScannerSettings& s, bool wheel) {
  Json out;
  out[wheel ? "range_deg" : "range_mm"] = range(s.u_min, s.u_max, wheel ? kDeg : kMilli);
  out["range_y_mm"] = range(s.y_min, s.y_max, kMilli);
  if (s.spacing > 0.0)
    out["spacing_mm"] = number(kMilli * s.spacing);
  else
    out["points"] = s.points;
  for (const Vec3& stand : s.stands) out["from_mm"].push_back(vector(stand, kMilli));
  out["noise_mm"] = number(kMilli * s.noise);
  out["noise_lateral_mm"] = number(kMilli * s.noise_lateral);
  out["outliers"] = number(s.outliers);
  out["holes"] = number(s.holes);
  out["hole_size_mm"] = number(kMilli * s.hole_size);
  out["drop_outs"] = number(s.drop_outs);
  out["most_incidence_deg"] = number(kDeg * s.most_incidence);
  out["passes"] = s.passes;
  out["registration_mm"] = number(kMilli * s.registration);
  out["frame"] = s.random_frame ? "random" : "identity";
  return out;
}

Json passes_json(const scans::ScannerTruth& truth, bool wheel) {
  Json list = Json::array();
  for (std::size_t i = 0; i < truth.passes.size(); ++i) {
    const scans::ScannerPass& pass = truth.passes[i];
    Json one;
    one[wheel ? "range_deg" : "range_mm"] = range(pass.u_min, pass.u_max, wheel ? kDeg : kMilli);
    one["range_y_mm"] = range(pass.y_min, pass.y_max, kMilli);
    one["lines"] = pass.lines;
    one["points"] = pass.points;
    one["middle_mm"] = vector(pass.middle_C, kMilli);
    one["error"] = pose(truth.X_pass[i]);
    list.push_back(one);
  }
  return list;
}

}  // namespace

std::string truth_json(const Scanned& scanned) {
  const scans::ScannerTruth& truth = scanned.scan.truth;
  const bool wheel = scanned.settings.body == Body::wheel;
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  out["surface"] = {{"file", scanned.surface.string()}, {"body", wheel ? "wheel" : "rail"}};
  if (wheel) out["surface"]["nominal_radius_mm"] = number(kMilli * scanned.settings.nominal_radius);
  if (std::error_code ignored; std::filesystem::is_regular_file(scanned.surface, ignored))
    out["surface"]["sha256"] = io::sha256_file(scanned.surface);
  if (scanned.named.scale_to_mm != 1.0) out["surface"]["scale_to_mm"] = scanned.named.scale_to_mm;
  if (!scanned.named.overrides.empty()) out["surface"]["set"] = scanned.named.overrides;
  out["cloud"] = {{"file", scanned.cloud.string()},
                  {"unit", symbol(scanned.unit)},
                  {"metres_per_unit", metres_per(scanned.unit)},
                  {"points", scanned.scan.cloud.points.size()}};
  out["seed"] = scanned.settings.seed;
  out["settings"] = settings_json(scanned.settings, wheel);
  out["surface_in_cloud"] = pose(truth.X_CS);
  if (!scanned.line.empty()) {
    out["line"] = {{"file", scanned.line.string()}, {"sha256", io::sha256_file(scanned.line)}};
    Json& stations = out["line"]["stations"] = Json::array();
    constexpr int kStations = 20;
    const double from = scanned.scan.truth.passes.front().u_min, to = scanned.scan.truth.passes.front().u_max;
    for (int k = 0; k <= kStations; ++k) {
      const double x = from + (to - from) * k / kStations;
      stations.push_back(pose(truth.X_CS * scanned.settings.line(x)));
      stations.back()["x_mm"] = number(kMilli * x);
    }
  }
  out["counts"] = {{"on_surface", truth.on_surface},         {"outliers", truth.outliers},
                   {"lost_holes", truth.lost_holes},         {"lost_drop_outs", truth.lost_drop_outs},
                   {"lost_occlusion", truth.lost_occlusion}, {"lost_shadow", truth.lost_shadow}};
  out["spacing_mm"] = number(kMilli * truth.spacing);
  out["area_mm2"] = number(kMicro * truth.area);
  out["passes"] = passes_json(truth, wheel);
  return io::dumped(out, 2) + "\n";
}

}  // namespace treadmark::app
