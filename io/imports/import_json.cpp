// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/twelve_digits.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/imports/import_words.hpp"

namespace treadmark::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMilli2 = 1e6, kMilli3 = 1e9;
constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Twelve digits, so that changes of unit leave no tail of nines; what is not finite is null.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return twelve_digits(value) + 0.0;  // no negative zero
}

/// In full precision.
Json exact(double value) { return std::isfinite(value) ? Json(value + 0.0) : Json(); }

Json exact(const Vec3& v, double factor) {
  return Json::array({exact(factor * v.x()), exact(factor * v.y()), exact(factor * v.z())});
}

Json vector(const Vec3& v, double factor) {
  return Json::array({number(factor * v.x()), number(factor * v.y()), number(factor * v.z())});
}

std::string dump(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

/// Place along the band: u_deg of a wheel, u_mm of a rail.
void add_place(Json& out, const ImportReport& report, double u, double y, double s) {
  if (report.body == Body::wheel)
    out["u_deg"] = number(kDegrees * u);
  else
    out["u_mm"] = number(kMilli * u);
  out["y_mm"] = number(kMilli * y);
  out["s_mm"] = number(kMilli * s);
}

Json frame(const ImportReport& report) {
  if (report.from_map) return nullptr;
  const Pose& X = report.X_CS;
  Json matrix = Json::array();
  for (int i = 0; i < 3; ++i)
    matrix.push_back(
        {exact(X.rotation(i, 0)), exact(X.rotation(i, 1)), exact(X.rotation(i, 2)), exact(kMilli * X.origin[i])});
  Json passes = Json::array();
  for (const ImportReport::Pass& pass : report.passes)
    passes.push_back({{"pass", pass.pass},
                      {"points", pass.points},
                      {"shift_mm", vector(pass.shift_S, kMilli)},
                      {"turn_mrad", vector(pass.turn_S, kMilli)}});
  return {{"origin_mm", exact(X.origin, kMilli)},
          {"x_axis", exact(X.rotation.col(0), 1.0)},
          {"y_axis", exact(X.rotation.col(1), 1.0)},
          {"z_axis", exact(X.rotation.col(2), 1.0)},
          {"matrix", matrix},
          {"nominal_profile", report.nominal},
          {"nominal_radius_mm", number(kMilli * report.nominal_radius)},
          {"axis_position_error_mm", number(kMilli * report.axis_position_error)},
          {"axis_direction_error_mrad", number(kMilli * report.axis_direction_error)},
          {"scatter_mm", number(kMilli * report.scatter)},
          {"undamaged_percent", number(100.0 * report.undamaged)},
          {"match_residual_mm", number(kMilli * report.match_residual)},
          {"match_agreeing_percent", number(100.0 * report.match_agreeing)},
          {"turned", report.turned},
          {"zero", report.zero},
          {"passes", passes},
          {"pass_distance_before_mm", number(kMilli * report.pass_before)},
          {"pass_distance_after_mm", number(kMilli * report.pass_after)}};
}

Json coverage(const ImportReport& report) {
  Json holes = Json::array();
  for (const ImportReport::Hole& hole : report.holes) {
    Json one = Json::object();
    add_place(one, report, hole.u, hole.y, hole.s);
    one["diameter_mm"] = number(kMilli * hole.diameter);
    one["area_mm2"] = number(kMilli2 * hole.area);
    one["filled"] = hole.filled;
    holes.push_back(one);
  }
  return {{"spacing_mm", number(kMilli * report.spacing)},
          {"gap_a_mm", number(kMilli * report.gap_a)},
          {"gap_s_mm", number(kMilli * report.gap_s)},
          {"area_mm2", number(kMilli2 * report.area)},
          {"hole_area_mm2", number(kMilli2 * report.hole_area)},
          {"hole_limit_mm", number(kMilli * report.hole_limit)},
          {"holes", holes}};
}

Json fit(const ImportReport& report) {
  Json levels = Json::array();
  for (const ImportReport::Level& level : report.levels)
    levels.push_back({{"knot_a_mm", number(kMilli * level.knot_a)},
                      {"knot_s_mm", number(kMilli * level.knot_s)},
                      {"functions", level.functions},
                      {"used", level.used},
                      {"iterations", level.iterations}});
  Json sections;
  if (report.sections)
    sections = {{"count", report.sections->count},
                {"fewest_points", report.sections->fewest_points},
                {"most_points", report.sections->most_points},
                {"least_gap_mm", number(kMilli * report.sections->least_gap)},
                {"widest_gap_mm", number(kMilli * report.sections->widest_gap)},
                {"spread_mm", number(kMilli * report.sections->spread)},
                {"smoothing_lambda_mm3", number(kMilli3 * report.sections->smoothing)}};
  return {{"kept_sections", sections},
          {"levels", levels},
          {"fitted_points", report.fitted_points},
          {"held_out_points", report.held_out_points},
          {"held_out_rms_mm", number(kMilli * report.held_out_rms)},
          {"held_out_error_mm", number(kMilli * report.held_out_error)},
          {"histogram_range_mm", number(kMilli * report.residual_range)},
          {"histogram", report.residual_histogram}};
}

Json damage(const ImportReport& report) {
  Json list = Json::array();
  for (const ImportReport::Damage& part : report.damage) {
    Json one = Json::object();
    add_place(one, report, part.u, part.y, part.s);
    one["length_mm"] = number(kMilli * part.length);
    one["width_mm"] = number(kMilli * part.width);
    one["depth_mm"] = number(kMilli * part.depth);
    one["volume_mm3"] = number(kMilli3 * part.volume);
    list.push_back(one);
  }
  return list;
}

Json range(const ImportReport& report) {
  Json out = {{"closed", report.closed}};
  const bool wheel = report.body == Body::wheel;
  const double factor = wheel ? kDegrees : kMilli;
  out[wheel ? "u_deg" : "u_mm"] = Json::array({number(factor * report.u_min), number(factor * report.u_max)});
  out["y_mm"] = Json::array({number(kMilli * report.y_min), number(kMilli * report.y_max)});
  return out;
}

/// Reasons that come twice are counted together, so that no count is lost.
void add_removed(Json& out, const ImportReport& report) {
  Json counts = Json::object(), why = Json::object();
  for (const ImportReport::Removed& removed : report.removed) {
    const bool again = counts.contains(removed.reason);
    counts[removed.reason] = removed.count + (again ? counts[removed.reason].get<std::size_t>() : 0);
    why[removed.reason] = again && why[removed.reason] != removed.why
                              ? why[removed.reason].get<std::string>() + "; " + removed.why
                              : removed.why;
  }
  out["removed"] = counts;
  out["removed_why"] = why;
}

Json seconds(const ImportReport& report) {
  Json out = Json::object();
  for (const ImportReport::Step& step : report.steps) {
    const double before = out.contains(step.name) && out[step.name].is_number() ? out[step.name].get<double>() : 0.0;
    out[step.name] = number(before + step.seconds);
  }
  return out;
}

}  // namespace

std::string import_json(const ImportReport& report, bool with_seconds) {
  Json out = Json::object();
  out["treadmark"] = {{"version", report.version}};
  out["body"] = body_name(report.body);
  out["from_map"] = report.from_map;
  out["input"] = report.inputs.empty() ? "" : report.inputs.front().file;
  out["sha256"] = report.inputs.empty() ? "" : report.inputs.front().sha256;
  out["inputs"] = Json::array();
  for (const ImportReport::Input& input : report.inputs)
    out["inputs"].push_back({{"file", input.file},
                             {"sha256", input.sha256},
                             {"format", input.format},
                             {"points", input.points},
                             {"not_finite", input.not_finite}});
  out["unit"] = report.unit;
  out["unit_from"] = report.unit_from;
  out["points_read"] = report.points_read;
  out["points_used"] = report.points_used;
  add_removed(out, report);
  out["warnings"] = report.warnings;
  out["noise_mm"] = number(kMilli * report.noise);
  out["residual_rms_mm"] = number(kMilli * report.residual_rms);
  out["residual_max_mm"] = number(kMilli * report.residual_max);
  out["frame"] = frame(report);
  out["coverage"] = coverage(report);
  out["fit"] = fit(report);
  out["damage_threshold_mm"] = number(kMilli * report.damage_threshold);
  out["damage"] = damage(report);
  out["range"] = range(report);
  out["outputs"] = Json::array();
  for (const ImportReport::Output& output : report.outputs)
    out["outputs"].push_back({{"file", output.file},
                              {"kind", output.kind},
                              {"sha256", output.sha256},
                              {"bytes", output.bytes},
                              {"details", output.details},
                              {"height_max_um", number(kMicro * output.height_max)},
                              {"height_rms_um", number(kMicro * output.height_rms)}});
  out["settings_toml"] = report.settings_toml;
  if (with_seconds) out["seconds"] = seconds(report);
  return dump(out);
}

std::string import_times_json(const ImportReport& report) {
  Json list = Json::array();
  for (const ImportReport::Step& step : report.steps)
    list.push_back({{"step", step.name}, {"seconds", number(step.seconds)}});
  return dump({{"steps", list}});
}

}  // namespace treadmark::io
