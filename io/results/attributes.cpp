// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/attributes.hpp"

#include <fmt/format.h>

#include <utility>

#include "treadmark/io/results/file_layout.hpp"

namespace treadmark::io {
namespace {

void add_loads(std::vector<Attribute>& list, const Loads& loads) {
  const std::pair<const char*, const Load&> sides[] = {
      {"track", loads.track}, {"rail", loads.rail}, {"wheelset", loads.wheelset}, {"wheel", loads.wheel}};
  for (const auto& [name, load] : sides) {
    list.push_back({std::string("load_force_") + name, load.force});
    list.push_back({std::string("load_moment_") + name, load.moment});
  }
}

}  // namespace

std::vector<Attribute> attributes_of(const PatchResult& patch) {
  std::vector<Attribute> list;
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  const Grid2& grid = patch.fields.grid;
  add("frame", "x, s, n: s along the rail profile, n into the rail; X_TC places it in track axes");
  add("X_TC_origin", patch.fields.X_TC.origin);
  add("X_TC_rotation", patch.fields.X_TC.rotation);
  add("nx", grid.nx);
  add("ny", grid.ny);
  add("shift", patch.shift ? 1 : 0);
  const std::pair<const char*, double> numbers[] = {{"x0", grid.x0},
                                                    {"s0", grid.y0},
                                                    {"dx", grid.dx},
                                                    {"ds", grid.dy},
                                                    {"fn", patch.fn},
                                                    {"fx", patch.fx},
                                                    {"fs", patch.fs},
                                                    {"mn", patch.mn},
                                                    {"xi", patch.xi},
                                                    {"eta", patch.eta},
                                                    {"phi", patch.phi},
                                                    {"approach", patch.approach},
                                                    {"pmax", patch.pmax},
                                                    {"elastic_energy", patch.elastic_energy},
                                                    {"frictional_power", patch.frictional_power},
                                                    {"shear_modulus", patch.shear_modulus},
                                                    {"fx_relative", patch.fx_relative},
                                                    {"fs_relative", patch.fs_relative}};
  for (const auto& [name, value] : numbers) add(name, value);
  add("elements_in_contact", patch.ncon);
  add("elements_in_adhesion", patch.nadh);
  add("elements_in_slip", patch.nslip);
  if (patch.max_temperature_1) add("max_temperature_1", *patch.max_temperature_1);
  if (patch.max_temperature_2) add("max_temperature_2", *patch.max_temperature_2);
  if (patch.has_rolling) {
    add("chi", patch.chi);
    add("dq", patch.dq);
    add("velocity", patch.velocity);
  }
  if (patch.has_reference) {
    add("reference_track", Vec3(patch.x_tr, patch.y_tr, patch.z_tr));
    add("reference_rail", Vec3(patch.x_rail, patch.y_rail, patch.z_rail));
    add("reference_wheel", Vec3(patch.x_wheel, patch.y_wheel, patch.z_wheel));
    add("reference_wheelset", Vec3(patch.x_wheelset, patch.y_wheelset, patch.z_wheelset));
    add("contact_angle", patch.angle);
    add("contact_angle_rail", patch.angle_rail);
    add("contact_angle_wheelset", patch.angle_wheelset);
    add("contact_angle_wheel", patch.angle_wheel);
    add("reference_x", patch.reference_x);
    add("reference_s", patch.reference_s);
    add("id", fmt::format("{}", patch.id));
    std::vector<std::string> from;
    for (const std::uint64_t one : patch.came_from) from.push_back(fmt::format("{}", one));
    add("came_from", from);
    add("s_rail", patch.s_rail);
  }
  if (patch.loads) add_loads(list, *patch.loads);
  if (patch.local) add("local_forces_x_s_n", Vec3(patch.local->fx, patch.local->fs, patch.local->fn));
  return list;
}

std::vector<Attribute> attributes_of(const CaseResult& result) {
  std::vector<Attribute> list;
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  add("number", result.number);
  add("status", std::string(to_string(result.status)));
  add("message", result.message);
  add("seconds", result.seconds);
  if (result.has_wheelset) {
    add("wheelset_position", Vec3(result.s, result.y, result.z));
    add("wheelset_roll_yaw_pitch", Vec3(result.roll, result.yaw, result.pitch));
    add("wheelset_velocity", Vec3(result.vs, result.vy, result.vz));
    add("wheelset_rates_roll_yaw_pitch", Vec3(result.vroll, result.vyaw, result.vpitch));
    add("force_on_rail_track", result.force_tr);
    add("force_on_rail_wheelset", result.force_ws);
    add("moment_on_rail_at_rail", result.moment_rail);
    add("moment_on_rail_at_wheel", result.moment_wheel);
  }
  if (result.loads) add_loads(list, *result.loads);
  if (result.rail_deflection) {
    add("rail_deflection_y", result.rail_deflection->x());
    add("rail_deflection_z", result.rail_deflection->y());
  }
  if (result.roller) {
    add("roller_nominal_radius", result.roller->nominal_radius);
    add("roller_pitch_rate", result.roller->pitch_rate);
  }
  if (result.bodies) {
    add("X_TA_origin", result.bodies->X_TA.origin);
    add("X_TA_rotation", result.bodies->X_TA.rotation);
    add("X_TS_origin", result.bodies->X_TS.origin);
    add("X_TS_rotation", result.bodies->X_TS.rotation);
  }
  if (!result.wheel_surface.empty()) add("wheel_surface", result.wheel_surface);
  if (!result.rail_surface.empty()) add("rail_surface", result.rail_surface);
  return list;
}

std::vector<Attribute> attributes_of(const RunResult& run) {
  std::vector<Attribute> list;
  const auto add = [&](std::string name, Attribute::Value value) {
    list.push_back({std::move(name), std::move(value)});
  };
  add("format", kResultFormat);
  add("units", "SI");
  add("axes", kAxes);
  add("version", run.version);
  add("git", run.git);
  add("threads", run.threads);
  add("seconds", run.seconds);
  add("input", run.input_file);
  add("sha256", run.input_sha256);
  std::vector<std::string> files, hashes;
  for (const auto& [name, hash] : run.geometry_sha256) {
    files.push_back(name);
    hashes.push_back(hash);
  }
  add("geometry_files", files);
  add("geometry_sha256", hashes);
  add("settings", run.settings);
  add("complete", run.complete ? 1 : 0);
  add("cases_total", run.cases_total);
  return list;
}

}  // namespace treadmark::io
