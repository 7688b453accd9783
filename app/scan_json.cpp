// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "treadmark/app/scan_surface.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDeg = 180.0 / std::numbers::pi;

/// Twelve digits, so that changes of unit leave no tail of nines; what is not finite is null.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return Json::parse(fmt::format("{:.12g}", value));
}

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
  out["cloud"] = {{"file", scanned.cloud.string()},
                  {"unit", symbol(scanned.unit)},
                  {"metres_per_unit", metres_per(scanned.unit)},
                  {"points", scanned.scan.cloud.points.size()}};
  out["seed"] = scanned.settings.seed;
  out["settings"] = settings_json(scanned.settings, wheel);
  out["surface_in_cloud"] = pose(truth.X_CS);
  out["counts"] = {{"on_surface", truth.on_surface},
                   {"outliers", truth.outliers},
                   {"lost_holes", truth.lost_holes},
                   {"lost_drop_outs", truth.lost_drop_outs},
                   {"lost_occlusion", truth.lost_occlusion}};
  out["spacing_mm"] = number(kMilli * truth.spacing);
  out["area_mm2"] = number(kMicro * truth.area);
  out["passes"] = passes_json(truth, wheel);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace treadmark::app
