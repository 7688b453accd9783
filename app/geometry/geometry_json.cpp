// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/tables/json_of.hpp"

namespace treadmark::app {
namespace {

using geometry::Conicity;
using io::Json;

Json json_mm(double metres) { return io::number(kMilli * metres); }

Json json_list(const std::vector<Conicity>& list, double (*value)(const Conicity&)) {
  Json out = Json::array();
  for (const Conicity& c : list) out.push_back(io::number(value(c)));
  return out;
}

Json json_conicity(const std::vector<Conicity>& list, double contact_distance, double radius) {
  Json out;
  out["amplitude_mm"] = json_list(list, [](const Conicity& c) { return kMilli * c.amplitude; });
  out["tan_gamma_e"] = json_list(list, [](const Conicity& c) { return c.tan_gamma; });
  Json waves = Json::array(), reasons = Json::array();
  for (const Conicity& c : list) {
    waves.push_back(json_mm(geometry::wavelength(c.tan_gamma, contact_distance, radius)));
    reasons.push_back(io::text_or_null(c.reason));
  }
  out["wavelength_mm"] = std::move(waves);
  out["turns_left_mm"] = json_list(list, [](const Conicity& c) { return kMilli * c.low; });
  out["turns_right_mm"] = json_list(list, [](const Conicity& c) { return kMilli * c.high; });
  out["reason"] = std::move(reasons);
  return out;
}

Json json_jump(const geometry::Jump& jump) {
  const geometry::Touch &before = jump.right ? jump.before.right : jump.before.left,
                        &after = jump.right ? jump.after.right : jump.after.left;
  return {{"y_mm", json_mm(0.5 * (jump.before.y + jump.after.y))},
          {"side", jump.right ? "right" : "left"},
          {"from_rail_y_mm", json_mm(before.rail_y)},
          {"to_rail_y_mm", json_mm(after.rail_y)},
          {"from_wheel_y_mm", json_mm(before.wheel_y)},
          {"to_wheel_y_mm", json_mm(after.wheel_y)},
          {"dr_before_mm", json_mm(jump.before.radius_difference())},
          {"dr_after_mm", json_mm(jump.after.radius_difference())}};
}

Json json_limit(const geometry::ShiftLimit& limit) {
  return {{"y_mm", json_mm(limit.y)}, {"limited", limit.limited}, {"reason", io::text_or_null(limit.reason)}};
}

Json json_sweep(const GaugeSweep& sweep) {
  Json out;
  Json gauges = Json::array(), amplitudes = Json::array(), at_3mm = Json::array(), map = Json::array(),
       reasons = Json::array();
  for (std::size_t g = 0; g < sweep.gauges.size(); ++g) {
    gauges.push_back(json_mm(sweep.gauges[g]));
    at_3mm.push_back(io::number(sweep.trouble[g].empty() ? sweep.at_3mm[g].tan_gamma : kNaN));
    map.push_back(json_list(sweep.conicity[g], [](const Conicity& c) { return c.tan_gamma; }));
    reasons.push_back(io::text_or_null(sweep.trouble[g]));
    if (amplitudes.empty())
      amplitudes = json_list(sweep.conicity[g], [](const Conicity& c) { return kMilli * c.amplitude; });
  }
  out["gauge_mm"] = std::move(gauges);
  out["tan_gamma_e_3mm"] = std::move(at_3mm);
  out["amplitude_mm"] = std::move(amplitudes);
  out["tan_gamma_e"] = std::move(map);
  out["reason"] = std::move(reasons);
  return out;
}

Json json_loaded_side(const geometry::LoadedSide& side) {
  return {{"normal_force_N", io::number(side.normal_force)},
          {"pressure_MPa", io::number(kMega * side.pressure)},
          {"semi_axis_x_mm", json_mm(side.semi_axis_x)},
          {"semi_axis_y_mm", json_mm(side.semi_axis_y)},
          {"approach_mm", json_mm(side.approach)},
          {"misfit", io::number(side.misfit)},
          {"shared", side.shared},
          {"reason", io::text_or_null(side.reason)}};
}

Json json_load(const geometry::LoadedFunctions& f) {
  const auto elastic = [](double shear_modulus, double poisson) -> Json {
    return {{"youngs_modulus_MPa", io::number(kMega * 2.0 * shear_modulus * (1.0 + poisson))},
            {"poisson", io::number(poisson)}};
  };
  const Material& m = f.load.material;
  return {{"axle_load_N", io::number(f.load.weight)},
          {"rail", elastic(m.shear_modulus_1, m.poisson_1)},
          {"wheel", elastic(m.shear_modulus_2, m.poisson_2)},
          {"y_mm", json_mm(f.middle)},
          {"right", json_loaded_side(f.at_middle.right)},
          {"left", json_loaded_side(f.at_middle.left)},
          {"holding_force_N", io::number(f.at_middle.holding_force)},
          {"lowering_mm", json_mm(f.at_middle.lowering)},
          {"elastic_roll_rad", io::number(f.at_middle.roll)},
          {"largest_pressure",
           {{"amplitude_mm", json_mm(f.amplitude)},
            {"pressure_MPa", io::number(kMega * f.largest.pressure)},
            {"misfit", io::number(f.largest.misfit)},
            {"shared", f.largest.shared},
            {"y_mm", json_mm(f.largest_y)},
            {"side", std::isnan(f.largest_y) ? Json() : Json(f.largest_right ? "right" : "left")}}}};
}

}  // namespace

std::string geometry_json(const GeometryResult& result, const GaugeSweep* sweep) {
  const geometry::Analysis& a = result.analysis;
  const GeometryRequest& r = result.request;
  const geometry::WheelsetOnTrack wheelset =
      geometry::place(result.right, result.left, result.placement, r.settings.roll, r.settings.yaw);
  const double radius = 0.5 * (a.radius_right + a.radius_left);
  Json g;
  g["profiles"] = {{"wheel_right", r.wheel},
                   {"wheel_left", r.wheel_left.empty() ? r.wheel : r.wheel_left},
                   {"rail_right", r.rail},
                   {"rail_left", r.rail_left.empty() ? r.rail : r.rail_left}};
  g["wheelset"] = {{"wheel_origins_mm", json_mm(a.wheel_origins)},
                   {"back_to_back_mm", json_mm(a.wheel_origins - 0.14)},
                   {"active_faces_mm", json_mm(a.active_faces)},
                   {"diameter_right_mm", json_mm(2.0 * a.radius_right)},
                   {"diameter_left_mm", json_mm(2.0 * a.radius_left)},
                   {"flange_thickness_right_mm", json_mm(a.flange_thickness_right)},
                   {"flange_thickness_left_mm", json_mm(a.flange_thickness_left)}};
  g["track"] = {{"gauge_mm", json_mm(a.gauge)},
                {"gauge_height_mm", json_mm(result.placement.gauge_height)},
                {"inclination", io::number(std::tan(result.right.cant))},
                {"rail_origin_right_mm", json_mm(a.rail_y_right)},
                {"rail_origin_left_mm", json_mm(a.rail_y_left)},
                {"clearance_mm", json_mm(a.gauge - a.active_faces)}};
  g["method"] = {{"roll", r.settings.roll == geometry::Roll::none ? "none" : "free"},
                 {"yaw_mrad", io::number(kMilli * r.settings.yaw)},
                 {"step_mm", json_mm(r.settings.step)},
                 {"smoothing_mm", 0.0},
                 {"pitch_deg", io::number(r.pitch * 180.0 / kPi)},
                 {"position_mm", json_mm(r.x)}};
  Json functions;
  std::vector<FunctionRow> rows;
  for (const geometry::Position& position : a.functions.rows) rows.push_back({position, wheelset});
  io::add_lists(functions, rows);
  if (result.load) {
    io::add_lists(functions, result.load->rows);
    g["load"] = json_load(*result.load);
  }
  g["functions"] = std::move(functions);
  g["limits"] = {{"left", json_limit(a.functions.to_left)}, {"right", json_limit(a.functions.to_right)}};
  g["jumps"] = Json::array();
  for (const geometry::Jump& jump : a.functions.jumps) g["jumps"].push_back(json_jump(jump));
  g["second_contacts"] = Json::array();
  for (const geometry::FurtherTouch& other : a.functions.others)
    g["second_contacts"].push_back({{"y_mm", json_mm(other.y)},
                                    {"side", other.right ? "right" : "left"},
                                    {"wheel_y_mm", json_mm(other.touch.wheel_y)},
                                    {"rail_y_mm", json_mm(other.touch.rail_y)},
                                    {"angle_rad", io::number(other.touch.angle)},
                                    {"gap_mm", json_mm(other.touch.gap)}});
  g["equilibrium_y_mm"] = a.equilibrium ? json_mm(*a.equilibrium) : Json();
  g["equilibrium_reason"] = io::text_or_null(a.no_equilibrium);
  g["conicity"] = json_conicity(a.conicity, a.wheel_origins, radius);
  if (!a.harmonic.empty()) {
    Json harmonic = Json::array();
    for (const double value : a.harmonic) harmonic.push_back(io::number(value));
    g["conicity"]["harmonic"] = std::move(harmonic);
  }
  g["conicity_at"] = {{"amplitude_mm", json_mm(a.single.amplitude)},
                      {"tan_gamma_e", io::number(a.single.tan_gamma)},
                      {"rule", a.rule},
                      {"reason", io::text_or_null(a.single.reason)}};
  g["conicity_3mm"] = io::number(a.at_3mm.tan_gamma);
  if (const auto& noise = result.noise) {
    Json list = Json::array();
    for (const double value : noise->of_amplitude) list.push_back(io::number(value));
    g["conicity"]["noise"] = std::move(list);
    g["conicity_at"]["noise"] = io::number(noise->single);
    g["conicity_3mm_noise"] = io::number(noise->at_3mm);
  }
  if (const auto& fresh = result.with_new) {
    const double mean = 0.5 * (fresh->radius_right + fresh->radius_left);
    g["with_new"] = {{"wheel", result.request.new_wheel},
                     {"rail", result.request.new_rail},
                     {"equilibrium_y_mm", json_mm(fresh->equilibrium.value_or(kNaN))},
                     {"conicity", json_conicity(fresh->conicity, fresh->wheel_origins, mean)},
                     {"conicity_3mm", io::number(fresh->at_3mm.tan_gamma)}};
  }
  g["nonlinearity_per_mm"] = io::number(kMillimetre * a.nonlinearity);
  g["greatest_amplitude_mm"] = json_mm(a.greatest_amplitude);
  g["contact_spread"] = {{"amplitude_mm", json_mm(a.spread.amplitude)},
                         {"contact_spread_rail_mm", json_mm(a.spread.rail)},
                         {"contact_spread_wheel_mm", json_mm(a.spread.wheel)},
                         {"rail_over_shift", io::number(a.spread.rail / (2.0 * a.spread.amplitude))},
                         {"wheel_over_shift", io::number(a.spread.wheel / (2.0 * a.spread.amplitude))}};
  g["steering"] = {{"delta_r_max_mm", json_mm(a.steering.largest_difference)},
                   {"smallest_steered_radius_m", io::number(a.steering.smallest_radius)}};
  g["gravitational_stiffness_per_weight_per_m"] = io::number(a.gravitational_stiffness);
  if (sweep != nullptr) g["gauge_sweep"] = json_sweep(*sweep);
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  out["geometry"] = std::move(g);
  out["notes"] = result.notes;
  return io::dumped(out) + "\n";
}

}  // namespace treadmark::app
