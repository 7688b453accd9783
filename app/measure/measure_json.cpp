// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/schema_of.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

using io::Json;
using io::number;
using io::text_or_null;

constexpr const char* kMeasureSchema =
#include "treadmark/app/measure/measure.schema.json.in"
    ;

/// What numbers_json and stations_json write.
template <class Numbers>
void add_tables(io::SchemaTables& tables, const std::string& body) {
  io::SchemaRows known;
  for (const auto& row : number_rows(Numbers{})) known.push_back(io::schema_row<Numbers>(row));
  tables[body] = io::changed(known, [](io::SchemaRow& row) { row.always = true; });
  tables[body + ", reasons"] = io::changed(known, [](io::SchemaRow& row) { row.type = "string", row.or_null = false; });
  tables[body + ", sections"] = io::listed(known);
  tables[body + ", known"] = std::move(known);
}

template <class Numbers>
Json numbers_json(const Numbers& numbers) {
  Json out, uncertainty = Json::object(), reasons = Json::object();
  for (const auto& row : number_rows(numbers)) {
    const std::string key(row.key);
    out[key] = io::value_of(numbers, row);
    if (row.known(numbers))
      uncertainty[key] = number(row.uncertainty_in_file(numbers));
    else
      reasons[key] = row.access.reason(numbers);
  }
  out["uncertainty"] = std::move(uncertainty);
  out["reasons"] = std::move(reasons);
  return out;
}

/// Functions of the position: a list a number that is known somewhere.
template <class Numbers>
Json stations_json(const std::vector<MeasuredStation<Numbers>>& stations, const char* u) {
  Json out;
  out[u] = Json::array();
  for (const auto& station : stations) out[u].push_back(number(station.u));
  for (const auto& row : number_rows(Numbers{}))
    if (ranges::any_of(stations, [&](const auto& station) { return row.known(station.numbers); }))
      for (const auto& station : stations) out[std::string(row.key)].push_back(io::value_of(station.numbers, row));
  return out;
}

Json wheel_json(const MeasuredFile& file) {
  const WheelNumbers& n = std::get<WheelNumbers>(file.numbers);
  Json out = numbers_json(n);
  out["reprofiled_to"] = text_or_null(n.reprofiled_to);
  out["alignment"] = n.back_seen ? "flange_back" : "none";
  if (file.revolution) {
    const measures::RoundMeasures& round = *file.revolution;
    out["scatter_mm"] = number(1e3 * round.scatter);
    out["missing_part"] = number(round.gaps);
    out["flats"] = Json::array();
    for (const measures::RoundFlat& f : round.flats)
      out["flats"].push_back({{"theta_rad", number(f.theta)},
                              {"length_mm", number(1e3 * f.length.value)},
                              {"length_uncertainty_mm", number(1e3 * f.length.uncertainty)},
                              {"depth_mm", number(1e3 * f.depth.value)},
                              {"depth_uncertainty_mm", number(1e3 * f.depth.uncertainty)},
                              {"chord_length_mm", number(1e3 * f.chord_length)},
                              {"rounded_length_mm", number(1e3 * f.rounded_length)}});
    out["orders"] = Json::array();
    out["level_db"] = Json::array();
    for (const measures::RoundOrder& o : round.orders) {
      out["orders"].push_back({{"order", o.order},
                               {"amplitude_mm", number(1e3 * o.amplitude)},
                               {"uncertainty_mm", number(1e3 * o.uncertainty)},
                               {"phase_rad", number(o.phase)},
                               {"wavelength_mm", number(1e3 * o.wavelength)},
                               {"level_db", number(o.level)}});
      out["level_db"].push_back(number(o.level));
    }
    out["bands"] = Json::array();
    for (const auto& band : round.bands)
      out["bands"].push_back({{"wavelength_mm", number(1e3 * band.wavelength)}, {"level_db", number(band.level)}});
    out["runouts"] = Json::array();
    for (const auto& [y, runout] : file.further_runouts)
      out["runouts"].push_back({{"y_mm", number(1e3 * y)}, {"runout_mm", number(1e3 * runout.value)}});
  }
  if (file.round.size() > 1) out["round"] = stations_json(file.round, "theta_rad");
  return out;
}

Json rail_json(const MeasuredFile& file) {
  const RailNumbers& n = std::get<RailNumbers>(file.numbers);
  Json out = numbers_json(n);
  out["alignment"] = name_of(n.alignment);
  out["alignment_residual_mm"] = number(1e3 * n.residual);
  const double tangent = std::tan(n.inclination.value);
  out["inclination"] = std::fabs(tangent) > 1e-4 ? Json(fmt::format("1:{:.1f}", 1.0 / tangent)) : Json(nullptr);
  if (file.roughness) {
    Json r;
    for (const char* key : {"wavelength_m", "level_db", "limit_db", "exceedance_db", "spread_db", "floor_db"})
      r[key] = Json::array();
    for (const measures::RoughnessBand& band : file.roughness->bands) {
      r["wavelength_m"].push_back(number(band.wavelength));
      r["level_db"].push_back(number(band.level));
      r["limit_db"].push_back(number(band.limit));
      r["exceedance_db"].push_back(number(band.level - band.limit));
      r["spread_db"].push_back(number(band.spread));
      r["floor_db"].push_back(number(band.floor));
    }
    r["length_m"] = number(file.roughness->length);
    r["step_m"] = number(file.roughness->step);
    r["segments"] = file.roughness->segments;
    r["spikes"] = file.roughness->spikes;
    out["roughness"] = std::move(r);
    out["waves"] = Json::array();
    for (const measures::WaveBand& w : file.roughness->waves)
      out["waves"].push_back({{"shortest_mm", number(1e3 * w.shortest)},
                              {"longest_mm", number(1e3 * w.longest)},
                              {"rms_mm", number(1e3 * w.rms)},
                              {"peak_to_peak_mm", number(1e3 * w.peak_to_peak)}});
  }
  if (file.along.size() > 1) out["along"] = stations_json(file.along, "x_m");
  return out;
}

Json file_json(const MeasuredFile& file) {
  Json out;
  out["file"] = file.file;
  out["kind"] = text_or_null(file.kind);
  out["status"] = file.error.empty() ? word_of(file.verdict()) : "failed";
  out["error"] = text_or_null(file.error);
  out["noise_mm"] = number(1e3 * file.noise);
  out["notes"] = file.notes;
  out["said"] = Json::object();
  for (const auto& [name, value] : file.said) out["said"][name] = value;
  if (file.error.empty()) {
    if (std::holds_alternative<WheelNumbers>(file.numbers))
      out["wheel"] = wheel_json(file);
    else
      out["rail"] = rail_json(file);
  }
  out["limits"] = Json::array();
  for (const LimitResult& l : file.limits)
    out["limits"].push_back({{"key", l.limit.key},
                             {"value", number(l.value)},
                             {"uncertainty", number(l.uncertainty)},
                             {"min", l.limit.min ? number(*l.limit.min) : Json(nullptr)},
                             {"max", l.limit.max ? number(*l.limit.max) : Json(nullptr)},
                             {"status", word_of(l.verdict)},
                             {"sure", l.sure}});
  return out;
}

Json head(const MeasureRequest& request) {
  Json out;
  out["treadmark"] = {{"version", version()}};
  out["body"] = body_name(request.body);
  out["nominal"] = text_or_null(request.nominal);
  out["limits_file"] = text_or_null(request.limits.file);
  return out;
}

}  // namespace

std::string measure_schema() {
  io::SchemaTables tables;
  add_tables<WheelNumbers>(tables, "wheel");
  add_tables<RailNumbers>(tables, "rail");
  return io::filled_schema(kMeasureSchema, tables);
}

std::string file_document(const MeasuredFile& file) { return io::dumped(file_json(file)); }

std::string measure_json(const MeasuredFile& file, const MeasureRequest& request) {
  Json out = head(request);
  out.update(file_json(file));
  return io::dumped(out) + '\n';
}

std::string measure_json(const ResultList& files, const MeasureRequest& request) {
  Json out = head(request);
  out["files"] = Json::array();
  for (const ListRow& row : files.rows) out["files"].push_back(Json::parse(row.document));
  return io::dumped(out) + '\n';
}

}  // namespace treadmark::app
