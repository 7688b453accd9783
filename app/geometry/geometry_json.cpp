// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <utility>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/schema_of.hpp"

namespace treadmark::app {
namespace {

using geometry::Conicity;
using io::Json;

constexpr const char* kGeometrySchema =
#include "treadmark/app/geometry/geometry.schema.json.in"
    ;

/// The settings that results repeat.
io::SchemaRows echoed_rows() {
  io::SchemaRows out;
  for (const io::SettingKey<GeometryRequest>& key : geometry_keys().rows)
    if ((key.factors & kEchoed) != 0) out.push_back({"method." + key.info.path, "number", true, true, key.info.doc});
  return out;
}

/// Of the contact functions, those that only a load makes behind the rest.
io::SchemaRows function_rows() {
  io::SchemaRows out = io::schema_rows<FunctionRow>();
  for (io::SchemaRow& row : io::schema_rows<geometry::LoadedPosition>()) {
    row.always = false;
    out.push_back(std::move(row));
  }
  return io::listed(std::move(out));
}

Json lists_of(const std::vector<ConicityRow>& rows) {
  Json out;
  io::add_lists(out, rows);
  return out;
}

Json json_sweep(const GaugeSweep& sweep) {
  Json out;
  for (const char* key : {"gauge_mm", "tan_gamma_e_3mm", "amplitude_mm", "tan_gamma_e", "reason"})
    out[key] = Json::array();
  for (std::size_t g = 0; g < sweep.gauges.size(); ++g) {
    out["gauge_mm"].push_back(io::number(kMilli * sweep.gauges[g]));
    out["tan_gamma_e_3mm"].push_back(io::number(sweep.trouble[g].empty() ? sweep.at_3mm[g].tan_gamma : kNaN));
    Json& row = out["tan_gamma_e"].emplace_back(Json::array());
    for (const Conicity& c : sweep.conicity[g]) row.push_back(io::number(c.tan_gamma));
    out["reason"].push_back(io::text_or_null(sweep.trouble[g]));
    if (out["amplitude_mm"].empty())
      for (const Conicity& c : sweep.conicity[g]) out["amplitude_mm"].push_back(io::number(kMilli * c.amplitude));
  }
  return out;
}

Json json_load(const geometry::LoadedFunctions& f) {
  Json out = io::json_of(f);
  out["right"] = io::json_of(f.at_middle.right);
  out["left"] = io::json_of(f.at_middle.left);
  return out;
}

}  // namespace

std::string geometry_json(const GeometryResult& result) {
  const geometry::Analysis& a = result.analysis;
  const geometry::ContactFunctions& f = a.functions;
  const GeometryRequest& r = result.request;
  const geometry::WheelsetOnTrack wheelset =
      geometry::place(result.right, result.left, result.placement, r.settings.roll, r.settings.yaw);
  Json g = io::json_of(result);
  for (const io::SettingKey<GeometryRequest>& key : geometry_keys().rows)
    if ((key.factors & kEchoed) != 0) g["method"][key.info.path] = io::number(key.get(r));
  std::vector<FunctionRow> rows;
  for (const geometry::Position& position : f.rows) rows.push_back({position, wheelset});
  io::add_lists(g["functions"], rows);
  if (result.load) {
    io::add_lists(g["functions"], result.load->rows);
    g["load"] = json_load(*result.load);
  }
  g["limits"] = {{"left", io::json_of(f.to_left)}, {"right", io::json_of(f.to_right)}};
  g["jumps"] = io::json_of(f.jumps);
  g["second_contacts"] = io::json_of(f.others);
  g["conicity"] = lists_of(conicity_rows(a, &result));
  if (const auto& fresh = result.with_new)
    g["with_new"] = {{"wheel", r.new_wheel},
                     {"rail", r.new_rail},
                     {"equilibrium_y_mm", io::number(kMilli * fresh->equilibrium.value_or(kNaN))},
                     {"conicity", lists_of(conicity_rows(*fresh, nullptr))},
                     {"conicity_3mm", io::number(fresh->at_3mm.tan_gamma)}};
  if (result.sweep) g["gauge_sweep"] = json_sweep(*result.sweep);
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  out["geometry"] = std::move(g);
  out["notes"] = result.notes;
  return io::dumped(out) + "\n";
}

std::string geometry_schema() {
  using io::schema_rows;
  io::SchemaRows numbers = schema_rows<GeometryResult>();
  for (auto& row : echoed_rows()) numbers.push_back(std::move(row));
  return io::filled_schema(kGeometrySchema, {{"geometry", std::move(numbers)},
                                             {"functions", function_rows()},
                                             {"conicity", io::listed(schema_rows<ConicityRow>())},
                                             {"jump", schema_rows<geometry::Jump>()},
                                             {"second contact", schema_rows<geometry::FurtherTouch>()},
                                             {"limit", schema_rows<geometry::ShiftLimit>()},
                                             {"load", schema_rows<geometry::LoadedFunctions>()},
                                             {"loaded side", schema_rows<geometry::LoadedSide>()}});
}

}  // namespace treadmark::app
