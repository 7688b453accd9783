// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/twelve_digits.hpp"

namespace treadmark::io {
namespace {

using Json = nlohmann::ordered_json;

/// Rounded to 12 digits, so that changes of unit leave no tail of nines; not finite = null.
Json number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return twelve_digits(value);
}

Json hashes(const std::vector<std::pair<std::string, std::string>>& files) {
  Json list = Json::array();
  for (const auto& [file, sha256] : files) list.push_back({{"file", file}, {"sha256", sha256}});
  return list;
}

Json kinematics(const PatchResult& patch) {
  Json out = Json::object();
  if (patch.has_rolling) {
    out["chi_rad"] = number(patch.chi);
    out["dq_mm"] = number(patch.dq * kMilli);
    out["velocity_mm_s"] = number(patch.velocity * kMilli);
  }
  const double length = patch.shift ? kMilli : 1.0;
  out["xi"] = number(patch.xi * length);
  out["eta"] = number(patch.eta * length);
  out["phi"] = number(patch.shift ? patch.phi : patch.phi / kMilli);  // rad, rolling: rad/mm
  return out;
}

Json load_json(const Load& load) {
  return {{"fx_N", number(load.force.x())},
          {"fy_N", number(load.force.y())},
          {"fz_N", number(load.force.z())},
          {"mx_Nmm", number(load.moment.x() * kMilli)},
          {"my_Nmm", number(load.moment.y() * kMilli)},
          {"mz_Nmm", number(load.moment.z() * kMilli)}};
}

Json loads_json(const Loads& loads) {
  return {{"track", load_json(loads.track)},
          {"rail", load_json(loads.rail)},
          {"wheelset", load_json(loads.wheelset)},
          {"wheel", load_json(loads.wheel)}};
}

Json patch_json(const PatchResult& patch) {
  Json out = Json::object();
  if (patch.id != 0) {
    out["id"] = patch.id;
    out["came_from"] = patch.came_from;
  }
  if (patch.has_reference)
    out["reference"] = {{"x_tr_mm", number(patch.x_tr * kMilli)},       {"y_tr_mm", number(patch.y_tr * kMilli)},
                        {"z_tr_mm", number(patch.z_tr * kMilli)},       {"angle_rad", number(patch.angle)},
                        {"x_rail_mm", number(patch.x_rail * kMilli)},   {"y_rail_mm", number(patch.y_rail * kMilli)},
                        {"z_rail_mm", number(patch.z_rail * kMilli)},   {"s_rail_mm", number(patch.s_rail * kMilli)},
                        {"x_wheel_mm", number(patch.x_wheel * kMilli)}, {"y_wheel_mm", number(patch.y_wheel * kMilli)},
                        {"z_wheel_mm", number(patch.z_wheel * kMilli)}, {"x_ws_mm", number(patch.x_wheelset * kMilli)},
                        {"y_ws_mm", number(patch.y_wheelset * kMilli)}, {"z_ws_mm", number(patch.z_wheelset * kMilli)},
                        {"angle_rail_rad", number(patch.angle_rail)},   {"angle_ws_rad", number(patch.angle_wheelset)},
                        {"angle_wheel_rad", number(patch.angle_wheel)}};
  out["kinematics"] = kinematics(patch);
  out["xi"] = out["kinematics"]["xi"];
  out["eta"] = out["kinematics"]["eta"];

  out["fn_N"] = number(patch.fn);
  out["fx_N"] = number(patch.fx);
  out["fs_N"] = number(patch.fs);
  out["mn_Nmm"] = number(patch.mn * kMilli);
  out["elastic_energy_J"] = number(patch.elastic_energy);
  out["frictional_power_W"] = number(patch.frictional_power);
  if (patch.shift) out["frictional_work_J"] = number(patch.frictional_power);
  out["fn_over_g_mm2"] = number(patch.fn / patch.shear_modulus * kMilli * kMilli);
  out["fx_rel"] = number(patch.fx_relative);
  out["fs_rel"] = number(patch.fs_relative);
  out["approach_mm"] = number(patch.approach * kMilli);
  out["pmax_MPa"] = number(patch.pmax * kMega);

  if (patch.loads) out["loads"] = loads_json(*patch.loads);
  if (patch.local) {
    out["fn_tilde_N"] = number(patch.local->fn);
    out["fx_tilde_N"] = number(patch.local->fx);
    out["fs_tilde_N"] = number(patch.local->fs);
  }

  if (patch.sensitivities) {
    const auto& s = *patch.sensitivities;
    out["sensitivities"] = {{"fx_by_xi", number(s.by_creepage[0][0])},    {"fs_by_xi", number(s.by_creepage[0][1])},
                            {"fx_by_eta", number(s.by_creepage[1][0])},   {"fs_by_eta", number(s.by_creepage[1][1])},
                            {"fx_by_phi", number(s.by_creepage[2][0])},   {"fs_by_phi", number(s.by_creepage[2][1])},
                            {"fn_by_approach", number(s.by_approach[0])}, {"fx_by_approach", number(s.by_approach[1])},
                            {"fs_by_approach", number(s.by_approach[2])}};
  }
  if (patch.max_temperature_1) out["max_temperature_1_C"] = number(*patch.max_temperature_1);
  if (patch.max_temperature_2) out["max_temperature_2_C"] = number(*patch.max_temperature_2);

  out["elements"] = {{"npot", patch.npot}, {"ncon", patch.ncon}, {"nadh", patch.nadh}, {"nslip", patch.nslip}};
  const Grid2& grid = patch.fields.grid;
  out["grid"] = {{"mx", grid.nx},
                 {"my", grid.ny},
                 {"dx_mm", number(grid.dx * kMilli)},
                 {"ds_mm", number(grid.dy * kMilli)},
                 {"x0_mm", number(grid.x0 * kMilli)},
                 {"s0_mm", number(grid.y0 * kMilli)},
                 {"reference_x_mm", number(patch.reference_x * kMilli)},
                 {"reference_s_mm", number(patch.reference_s * kMilli)}};
  if (!patch.fields.row_angle.empty()) {
    Json angles = Json::array();
    for (const double angle : patch.fields.row_angle) angles.push_back(number(angle));
    out["grid"]["row_angle_rad"] = std::move(angles);
  }
  return out;
}

void add_wheelset(Json& out, const CaseResult& result) {
  out["wheelset"] = {{"s_mm", number(result.s * kMilli)}, {"y_mm", number(result.y * kMilli)},
                     {"z_mm", number(result.z * kMilli)}, {"roll_rad", number(result.roll)},
                     {"yaw_rad", number(result.yaw)},     {"pitch_rad", number(result.pitch)}};
  out["wheelset_velocity"] = {{"vx_mm_s", number(result.vs * kMilli)}, {"vy_mm_s", number(result.vy * kMilli)},
                              {"vz_mm_s", number(result.vz * kMilli)}, {"vroll_rad_s", number(result.vroll)},
                              {"vyaw_rad_s", number(result.vyaw)},     {"vpitch_rad_s", number(result.vpitch)}};
  Json forces = Json::object();
  const auto add = [&](const char* const(&names)[3], const Vec3& values, double factor) {
    for (int i = 0; i < 3; ++i) forces[names[i]] = number(values[i] * factor);
  };
  add({"fx_tr_N", "fy_tr_N", "fz_tr_N"}, result.force_tr, 1.0);
  add({"fx_ws_N", "fy_ws_N", "fz_ws_N"}, result.force_ws, 1.0);
  add({"mx_r_Nmm", "my_r_Nmm", "mz_r_Nmm"}, result.moment_rail, kMilli);
  add({"mx_w_Nmm", "my_w_Nmm", "mz_w_Nmm"}, result.moment_wheel, kMilli);
  out["force_on_rail"] = std::move(forces);
  if (result.loads) out["loads"] = loads_json(*result.loads);
  if (const auto& d = result.rail_deflection)
    out["rail_deflection"] = {{"y_mm", number(d->x() * kMilli)}, {"z_mm", number(d->y() * kMilli)}};
  if (const auto& r = result.roller)
    out["roller"] = {{"nominal_radius_mm", number(r->nominal_radius * kMilli)},
                     {"pitch_rate_rad_s", number(r->pitch_rate)}};
}

Json case_json(const CaseResult& result) {
  Json out = Json::object();
  out["case"] = result.number;
  out["status"] = std::string(to_string(result.status));
  out["message"] = result.message;
  out["seconds"] = number(result.seconds);
  if (result.has_wheelset) add_wheelset(out, result);
  out["timing"] = {{"search_s", number(result.search_s)},
                   {"distance_s", number(result.distance_s)},
                   {"normal_s", number(result.normal_s)},
                   {"tangential_s", number(result.tangential_s)},
                   {"total_s", number(result.seconds)}};
  out["counts"] = {{"searches", result.searches},
                   {"distances", result.distances},
                   {"normal_solves", result.normal_solves},
                   {"tangential_solves", result.tangential_solves}};
  out["force_iterations"] = Json::array();
  for (const auto& [z, fz] : result.force_iterations)
    out["force_iterations"].push_back(Json::array({number(z * kMilli), number(fz)}));
  out["npatch"] = result.patches.size();
  out["patches"] = Json::array();
  for (const PatchResult& patch : result.patches) out["patches"].push_back(patch_json(patch));
  return out;
}

Json surface_json(const SurfaceUse& use) {
  Json out = {{"body", use.body},
              {"backend", use.backend},
              {"resolution_mm", use.resolution > 0.0 ? Json(number(use.resolution * kMilli)) : Json()},
              {"build_s", number(use.build_seconds)},
              {"memory_bytes", use.memory_bytes}};
  if (use.fit.points > 0)
    out["fit"] = {{"points", use.fit.points},
                  {"missing", use.fit.missing},
                  {"height_max_um", number(use.fit.height_max * kMicro)},
                  {"height_rms_um", number(use.fit.height_rms * kMicro)},
                  {"slope_max_mrad", number(use.fit.slope_max * kMilli)},
                  {"curvature_max_per_m", number(use.fit.curvature_max)}};
  if (!use.note.empty()) out["note"] = use.note;
  return out;
}

}  // namespace

std::string to_json(const RunResult& run) {
  Json out = Json::object();
  out["treadmark"] = {
      {"version", run.version}, {"git", run.git}, {"threads", run.threads}, {"seconds", number(run.seconds)}};
  out["input"] = {{"file", run.input_file}, {"sha256", run.input_sha256}, {"geometry", hashes(run.geometry_sha256)}};
  out["surfaces"] = Json::array();
  for (const SurfaceUse& use : run.surfaces) out["surfaces"].push_back(surface_json(use));
  out["settings"] = run.settings;
  out["complete"] = run.complete;
  out["cases_total"] = run.cases_total;
  out["cases"] = Json::array();
  for (const CaseResult& result : run.cases) out["cases"].push_back(case_json(result));
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_json(const std::filesystem::path& path, const RunResult& run) { write_text_file(path, to_json(run)); }

}  // namespace treadmark::io
