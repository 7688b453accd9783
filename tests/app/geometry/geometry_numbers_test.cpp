// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Which number stands under which key: every one of geometry.json is written down here a second time, and a key without
// its line fails.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>

#include <nlohmann/json.hpp>

#include "treadmark/app/geometry/geometry_run.hpp"

namespace treadmark::app {
namespace {

using geometry::Analysis;
using geometry::LoadedPosition;
using geometry::LoadedSide;
using geometry::Position;
using nlohmann::json;

constexpr double kMm = 1e3, kMPa = 1e-6;

/// Nothing of it is the same on both sides.
GeometryResult uneven() {
  GeometryRequest r;
  r.wheel = "S1002", r.wheel_left = "EPS";
  r.rail = "60E1", r.rail_left = "54E1";
  r.cant = std::atan(1.0 / 40.0), r.gauge = 1.4357, r.gauge_height = 13e-3;
  r.wheel_origins = 1.5013, r.diameter = 0.92, r.diameter_left = 0.9207;
  r.axle_load = 120e3;
  r.x = 0.3, r.pitch = 0.7;
  r.settings.amplitudes = {1e-3, 2.5e-3, 4e-3};
  r.settings.step = 0.2e-3, r.settings.yaw = 2e-3;
  r.settings.second = 0.1e-3;
  r.new_wheel = "S1002", r.new_rail = "60E1";
  SectionStore store;
  GeometryResult result = run_geometry(r, store);
  result.noise = ConicityNoise{{1e-4, 2e-4, 3e-4}, 4e-4, 5e-4};
  return result;
}

using Numbers = std::map<std::string, double>;

/// The numbers of a document by their path, "functions/y_mm/7"; NaN where there is null.
void flatten(const json& at, const std::string& path, Numbers& out) {
  if (at.is_object()) {
    for (const auto& [key, value] : at.items()) flatten(value, path.empty() ? key : path + "/" + key, out);
  } else if (at.is_array()) {
    for (std::size_t i = 0; i < at.size(); ++i) flatten(at[i], path + "/" + std::to_string(i), out);
  } else if (at.is_number()) {
    out[path] = at.get<double>();
  } else if (at.is_null() && !path.ends_with("reason") && path.find("/reason/") == std::string::npos &&
             path.find("/no_pressure_") == std::string::npos) {
    out[path] = std::nan("");
  }
}

void add_conicity(Numbers& out, const std::string& path, const Analysis& a) {
  const double radius = 0.5 * (a.radius_right + a.radius_left);
  for (std::size_t i = 0; i < a.conicity.size(); ++i) {
    const geometry::Conicity& c = a.conicity[i];
    const std::string end = "/" + std::to_string(i);
    out[path + "amplitude_mm" + end] = kMm * c.amplitude;
    out[path + "tan_gamma_e" + end] = c.tan_gamma;
    // Klingel 1883: L = 2 pi sqrt(e r / (2 tan gamma))
    out[path + "wavelength_mm" + end] =
        kMm * 2.0 * std::acos(-1.0) * std::sqrt(a.wheel_origins * radius / (2.0 * c.tan_gamma));
    out[path + "turns_left_mm" + end] = kMm * c.low;
    out[path + "turns_right_mm" + end] = kMm * c.high;
  }
}

void add_side(Numbers& out, const std::string& path, const LoadedSide& side) {
  out[path + "normal_force_N"] = side.normal_force;
  out[path + "pressure_MPa"] = kMPa * side.pressure;
  out[path + "semi_axis_x_mm"] = kMm * side.semi_axis_x;
  out[path + "semi_axis_y_mm"] = kMm * side.semi_axis_y;
  out[path + "approach_mm"] = kMm * side.approach;
  out[path + "misfit"] = side.misfit;
}

Numbers expected_of(const GeometryResult& r) {
  const Analysis& a = r.analysis;
  Numbers out{{"wheelset/wheel_origins_mm", 1501.3},
              {"wheelset/back_to_back_mm", 1361.3},
              {"wheelset/active_faces_mm", kMm * a.active_faces},
              {"wheelset/diameter_right_mm", 920.0},
              {"wheelset/diameter_left_mm", 920.7},
              {"wheelset/flange_thickness_right_mm", kMm * a.flange_thickness_right},
              {"wheelset/flange_thickness_left_mm", kMm * a.flange_thickness_left},
              {"track/gauge_mm", 1435.7},
              {"track/gauge_height_mm", 13.0},
              {"track/inclination", 0.025},
              {"track/rail_origin_right_mm", kMm * a.rail_y_right},
              {"track/rail_origin_left_mm", kMm * a.rail_y_left},
              {"track/clearance_mm", 1435.7 - kMm * a.active_faces},
              {"method/yaw_mrad", 2.0},
              {"method/step_mm", 0.2},
              {"method/smoothing_mm", 0.0},
              {"method/pitch_deg", 0.7 * 180.0 / std::acos(-1.0)},
              {"method/position_mm", 300.0},
              {"limits/left/y_mm", kMm * a.functions.to_left.y},
              {"limits/right/y_mm", kMm * a.functions.to_right.y},
              {"equilibrium_y_mm", kMm * a.equilibrium.value()},
              {"conicity_at/amplitude_mm", kMm * a.single.amplitude},
              {"conicity_at/tan_gamma_e", a.single.tan_gamma},
              {"conicity_at/noise", 4e-4},
              {"conicity_3mm", a.at_3mm.tan_gamma},
              {"conicity_3mm_noise", 5e-4},
              {"with_new/equilibrium_y_mm", kMm * r.with_new->equilibrium.value()},
              {"with_new/conicity_3mm", r.with_new->at_3mm.tan_gamma},
              {"nonlinearity_per_mm", 1e-3 * a.nonlinearity},
              {"greatest_amplitude_mm", kMm * a.greatest_amplitude},
              {"contact_spread/amplitude_mm", 3.0},
              {"contact_spread/contact_spread_rail_mm", kMm * a.spread.rail},
              {"contact_spread/contact_spread_wheel_mm", kMm * a.spread.wheel},
              {"contact_spread/rail_over_shift", kMm * a.spread.rail / 6.0},
              {"contact_spread/wheel_over_shift", kMm * a.spread.wheel / 6.0},
              {"steering/delta_r_max_mm", kMm * a.steering.largest_difference},
              {"steering/smallest_steered_radius_m", a.steering.smallest_radius},
              {"gravitational_stiffness_per_weight_per_m", a.gravitational_stiffness}};
  add_conicity(out, "conicity/", a);
  add_conicity(out, "with_new/conicity/", *r.with_new);
  for (std::size_t i = 0; i < 3; ++i) {
    out["conicity/harmonic/" + std::to_string(i)] = a.harmonic[i];
    out["conicity/noise/" + std::to_string(i)] = 1e-4 * static_cast<double>(i + 1);
  }
  for (std::size_t i = 0; i < a.functions.jumps.size(); ++i) {
    const geometry::Jump& jump = a.functions.jumps[i];
    const geometry::Touch &from = jump.right ? jump.before.right : jump.before.left,
                          &to = jump.right ? jump.after.right : jump.after.left;
    const std::string path = "jumps/" + std::to_string(i) + "/";
    out[path + "y_mm"] = kMm * 0.5 * (jump.before.y + jump.after.y);
    out[path + "from_rail_y_mm"] = kMm * from.rail_y;
    out[path + "to_rail_y_mm"] = kMm * to.rail_y;
    out[path + "from_wheel_y_mm"] = kMm * from.wheel_y;
    out[path + "to_wheel_y_mm"] = kMm * to.wheel_y;
    out[path + "dr_before_mm"] = kMm * (jump.before.right.radius - jump.before.left.radius);
    out[path + "dr_after_mm"] = kMm * (jump.after.right.radius - jump.after.left.radius);
  }
  for (std::size_t i = 0; i < a.functions.others.size(); ++i) {
    const geometry::FurtherTouch& other = a.functions.others[i];
    const std::string path = "second_contacts/" + std::to_string(i) + "/";
    out[path + "y_mm"] = kMm * other.y;
    out[path + "wheel_y_mm"] = kMm * other.touch.wheel_y;
    out[path + "rail_y_mm"] = kMm * other.touch.rail_y;
    out[path + "angle_rad"] = other.touch.angle;
    out[path + "gap_mm"] = kMm * other.touch.gap;
  }
  const std::map<std::string, std::function<double(const Position&)>> functions{
      {"y_mm", [](const Position& p) { return kMm * p.y; }},
      {"delta_r_mm", [](const Position& p) { return kMm * (p.right.radius - p.left.radius); }},
      {"radius_right_mm", [](const Position& p) { return kMm * p.right.radius; }},
      {"radius_left_mm", [](const Position& p) { return kMm * p.left.radius; }},
      {"wheel_y_right_mm", [](const Position& p) { return kMm * p.right.wheel_y; }},
      {"wheel_y_left_mm", [](const Position& p) { return kMm * p.left.wheel_y; }},
      {"rail_y_right_mm", [](const Position& p) { return kMm * p.right.rail_y; }},
      {"rail_y_left_mm", [](const Position& p) { return kMm * p.left.rail_y; }},
      {"angle_right_rad", [](const Position& p) { return p.right.angle; }},
      {"angle_left_rad", [](const Position& p) { return p.left.angle; }},
      {"delta_tan_gamma", [](const Position& p) { return std::tan(p.right.angle) - std::tan(p.left.angle); }},
      {"wheel_curvature_right_per_m", [](const Position& p) { return p.right.wheel_curvature; }},
      {"wheel_curvature_left_per_m", [](const Position& p) { return p.left.wheel_curvature; }},
      {"rail_curvature_right_per_m", [](const Position& p) { return p.right.rail_curvature; }},
      {"rail_curvature_left_per_m", [](const Position& p) { return p.left.rail_curvature; }},
      {"roll_rad", [](const Position& p) { return p.roll; }},
      {"z_mm", [](const Position& p) { return kMm * p.z; }}};
  const geometry::WheelsetOnTrack wheelset =
      geometry::place(r.right, r.left, r.placement, r.request.settings.roll, r.request.settings.yaw);
  for (std::size_t i = 0; i < a.functions.rows.size(); ++i) {
    const std::string end = "/" + std::to_string(i);
    for (const auto& [key, value] : functions) out["functions/" + key + end] = value(a.functions.rows[i]);
    out["functions/holding_force_over_weight" + end] = wheelset.holding_force(a.functions.rows[i]);
    const LoadedPosition& l = r.load->rows[i];
    out["functions/holding_force_N" + end] = l.holding_force;
    out["functions/lowering_mm" + end] = kMm * l.lowering;
    out["functions/elastic_roll_rad" + end] = l.roll;
    for (const bool right : {true, false}) {
      Numbers side;
      add_side(side, "", right ? l.right : l.left);
      for (const auto& [key, value] : side) {
        const std::size_t unit = key == "misfit" ? key.size() : key.rfind('_');
        out["functions/" + key.substr(0, unit) + (right ? "_right" : "_left") + key.substr(unit) + end] = value;
      }
      const LoadedSide& s = right ? l.right : l.left;
      out[std::string("functions/shared_") + (right ? "right" : "left") + end] = !s.reason.empty() ? std::nan("")
                                                                                 : s.shared        ? 1.0
                                                                                                   : 0.0;
    }
  }
  const geometry::LoadedFunctions& f = *r.load;
  add_side(out, "load/right/", f.at_middle.right);
  add_side(out, "load/left/", f.at_middle.left);
  out["load/axle_load_N"] = 120e3;
  for (const char* body : {"rail", "wheel"}) {
    out[std::string("load/") + body + "/youngs_modulus_MPa"] = 2.0 * 82e3 * 1.28;
    out[std::string("load/") + body + "/poisson"] = 0.28;
  }
  out["load/y_mm"] = kMm * f.middle;
  out["load/holding_force_N"] = f.at_middle.holding_force;
  out["load/lowering_mm"] = kMm * f.at_middle.lowering;
  out["load/elastic_roll_rad"] = f.at_middle.roll;
  out["load/largest_pressure/amplitude_mm"] = kMm * f.amplitude;
  out["load/largest_pressure/pressure_MPa"] = kMPa * f.largest.pressure;
  out["load/largest_pressure/misfit"] = f.largest.misfit;
  out["load/largest_pressure/y_mm"] = kMm * f.largest_y;
  return out;
}

TEST(GeometryNumbers, EveryKeyHasItsOwnNumber) {
  const GeometryResult result = uneven();
  ASSERT_FALSE(result.analysis.functions.jumps.empty());
  ASSERT_FALSE(result.analysis.functions.others.empty());
  Numbers found;
  flatten(json::parse(geometry_json(result))["geometry"], "", found);
  const Numbers expected = expected_of(result);
  EXPECT_GT(expected.size(), 1000u);
  for (const auto& [path, value] : found) {
    const auto at = expected.find(path);
    if (at == expected.end()) {
      ADD_FAILURE() << path << " = " << value << " is expected nowhere";
    } else if (std::isnan(value)) {
      EXPECT_FALSE(std::isfinite(at->second)) << path;
    } else {
      EXPECT_NEAR(value, at->second, 1e-9 * std::fabs(at->second) + 1e-12) << path;
    }
  }
  for (const auto& [path, value] : expected) EXPECT_EQ(found.count(path), 1u) << path;
}

TEST(GeometryNumbers, OfSweepsOverTheGauge) {
  GeometryResult result = uneven();
  GaugeSweep& sweep = result.sweep.emplace();
  sweep.gauges = {1.434, 1.435};
  sweep.trouble = {"", "too wide"};
  sweep.at_3mm = {{3e-3, 0.11, -3e-3, 3e-3, {}}, {}};
  sweep.conicity = {{{1e-3, 0.12, -1e-3, 1e-3, {}}, {2e-3, 0.13, -2e-3, 2e-3, {}}}, {}};
  const json s = json::parse(geometry_json(result))["geometry"]["gauge_sweep"];
  EXPECT_EQ(s["gauge_mm"], json({1434.0, 1435.0}));
  EXPECT_EQ(s["tan_gamma_e_3mm"], json({0.11, nullptr}));
  EXPECT_EQ(s["amplitude_mm"], json({1.0, 2.0}));
  EXPECT_EQ(s["tan_gamma_e"], json({json({0.12, 0.13}), json::array()}));
  EXPECT_EQ(s["reason"], json({nullptr, "too wide"}));
}

/// The same numbers on the terminal.
TEST(GeometryNumbers, OfTheText) {
  GeometryResult r = uneven();
  r.analysis.spread = {3e-3, 21.24e-3, 24.68e-3};
  r.analysis.steering = {5.4321e-3, 127.4};
  r.analysis.nonlinearity = 12.3461;
  r.analysis.gravitational_stiffness = 67.8912;
  const std::string text = geometry_text(r);
  for (const char* words : {"rail 21.24 mm, wheel 24.68 mm for 3 mm to both sides", "127 m radius, delta r 5.432 mm",
                            "0.01235 1/mm", "gauge                 1435.700 mm"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
}

}  // namespace
}  // namespace treadmark::app
