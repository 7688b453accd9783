// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/read_json.hpp"
#include "treadmark/io/tables/schema_of.hpp"

namespace treadmark::io {
namespace {

constexpr const char* kImportSchema =
#include "treadmark/io/imports/import.schema.json.in"
    ;

constexpr double kMilli2 = 1e6;
constexpr double kDegrees = 180.0 / kPi;

Json in_full(std::initializer_list<double> values) { return numbers(values, Digits::all); }

/// The functions below name what is in the file once for writing and reading: what they tell a writer to put under a
/// key a reader takes from there. Factors are from SI to the unit of the key.
struct ImportWriter {
  static constexpr bool kReads = false;
  Json& out;

  template <class T>
  void value(const char* key, const T& value) const {
    out[key] = value;
  }
  void number(const char* key, double value, double factor) const { out[key] = io::number(factor * value); }
  void numbers(const char* key, std::initializer_list<double> values, double factor) const {
    Json& list = out[key] = Json::array();
    for (const double value : values) list.push_back(io::number(factor * value));
  }
  void vector(const char* key, const Vec3& v, double factor) const { numbers(key, {v.x(), v.y(), v.z()}, factor); }
  template <class Vector>
  void exact_vector(const char* key, const Vector& v, double factor) const {
    out[key] = in_full({factor * v.x(), factor * v.y(), factor * v.z()});
  }
  template <class Row>
  void row(const Row& row) const {
    add_all(out, row);
  }
  template <class Fields>
  void object(const char* key, Fields fields) const {
    Json node = Json::object();
    fields(ImportWriter{node});
    out[key] = std::move(node);
  }
  template <class T, class Fields>
  void list(const char* key, const std::vector<T>& items, Fields fields) const {
    Json nodes = Json::array();
    for (const T& item : items) {
      nodes.push_back(Json::object());
      fields(ImportWriter{nodes.back()}, item);
    }
    out[key] = std::move(nodes);
  }
};

struct ImportReader {
  static constexpr bool kReads = true;
  JsonTree in;

  void value(const char* key, std::string& value) const { value = in.text(key); }
  void value(const char* key, bool& value) const { value = in.flag(key); }
  void value(const char* key, std::size_t& value) const { value = in.count(key); }
  void value(const char* key, std::vector<std::string>& value) const { value = in.at(key).texts(); }
  void value(const char* key, std::vector<std::size_t>& value) const {
    for (const JsonTree& item : in.at(key).items()) value.push_back(item.count());
  }
  void number(const char* key, double& value, double factor) const { value = in.number(key) / factor; }
  std::vector<double> several(const char* key, std::size_t count) const {
    std::vector<double> out = in.at(key).numbers();
    if (out.size() != count) in.at(key).refuse(fmt::format("has {} numbers where {} are expected", out.size(), count));
    return out;
  }
  template <class Vector>
  void vector(const char* key, Vector&& v, double factor) const {
    const std::vector<double> values = several(key, 3);
    for (int i = 0; i < 3; ++i) v[i] = values[static_cast<std::size_t>(i)] / factor;
  }
  template <class Vector>
  void exact_vector(const char* key, Vector&& v, double factor) const {
    vector(key, v, factor);
  }
  template <class Row>
  void row(Row& row) const {
    read_json(in, row);
  }
  template <class Fields>
  void object(const char* key, Fields fields) const {
    fields(ImportReader{in.at(key)});
  }
  template <class T, class Fields>
  void list(const char* key, std::vector<T>& items, Fields fields) const {
    for (const JsonTree& node : in.at(key).items()) fields(ImportReader{node}, items.emplace_back());
  }
};

/// What rows of a table say of a part by themselves.
constexpr auto kRows = [](const auto& file, auto& part) { file.row(part); };

/// Place along the band: u_deg of a wheel, u_mm of a rail.
template <class File, class Part>
void place(const File& file, Body body, Part& part) {
  if (body == Body::wheel)
    file.number("u_deg", part.u, kDegrees);
  else
    file.number("u_mm", part.u, kMilli);
  file.number("y_mm", part.y, kMilli);
  file.number("s_mm", part.s, kMilli);
}

/// What place writes, and the rows of a part that has one.
template <class Part>
SchemaRows placed_rows() {
  SchemaRows out{{"u_deg", "number", true, false, "along the circumference of a wheel"},
                 {"u_mm", "number", true, false, "along a rail; one of u_deg and u_mm is there"},
                 {"y_mm", "number", true, true, "across, of the profile"},
                 {"s_mm", "number", true, true, "along the section, as in the maps; null where only y is known"}};
  for (auto& row : schema_rows<Part>()) out.push_back(std::move(row));
  return out;
}

/// A list that older files lack.
template <class File, class Items, class Fields>
void later_list(const File& file, const char* key, Items& items, Fields fields) {
  if constexpr (File::kReads)
    if (!file.in.find(key)) return;
  file.list(key, items, fields);
}

template <class File, class Report>
void frame(const File& file, Report& report) {
  auto& X = report.X_CS;
  file.exact_vector("origin_mm", X.origin, kMilli);
  file.exact_vector("x_axis", X.rotation.col(0), 1.0);
  file.exact_vector("y_axis", X.rotation.col(1), 1.0);
  file.exact_vector("z_axis", X.rotation.col(2), 1.0);
  if constexpr (!File::kReads) {
    Json& matrix = file.out["matrix"] = Json::array();
    for (int i = 0; i < 3; ++i)
      matrix.push_back(in_full({X.rotation(i, 0), X.rotation(i, 1), X.rotation(i, 2), kMilli * X.origin[i]}));
  }
  file.value("nominal_profile", report.nominal);
  file.number("nominal_radius_mm", report.nominal_radius, kMilli);
  if constexpr (File::kReads) {
    if (file.in.find("nominal_radius_error_mm")) file.number("nominal_radius_error_mm", report.radius_error, kMilli);
  } else {
    file.number("nominal_radius_error_mm", report.radius_error, kMilli);
  }
  file.number("axis_position_error_mm", report.axis_position_error, kMilli);
  file.number("axis_direction_error_mrad", report.axis_direction_error, kMilli);
  file.number("scatter_mm", report.scatter, kMilli);
  file.number("undamaged_percent", report.undamaged, 100.0);
  file.number("match_residual_mm", report.match_residual, kMilli);
  file.number("match_agreeing_percent", report.match_agreeing, 100.0);
  file.value("turned", report.turned);
  file.value("zero", report.zero);
  file.list("passes", report.passes, [](const File& node, auto& pass) {
    node.row(pass);
    node.vector("shift_mm", pass.shift_S, kMilli);
    node.vector("turn_mrad", pass.turn_S, kMilli);
  });
  file.number("pass_distance_before_mm", report.pass_before, kMilli);
  file.number("pass_distance_after_mm", report.pass_after, kMilli);
  later_list(file, "registrations", report.registrations, [](const File& node, auto& one) {
    node.row(one);
    node.vector("shift_mm", one.shift, kMilli);
    node.vector("turn_mrad", one.turn, kMilli);
  });
}

template <class File, class Report>
void coverage(const File& file, Report& report) {
  file.number("spacing_mm", report.spacing, kMilli);
  file.number("gap_a_mm", report.gap_a, kMilli);
  file.number("gap_s_mm", report.gap_s, kMilli);
  file.number("area_mm2", report.area, kMilli2);
  file.number("hole_area_mm2", report.hole_area, kMilli2);
  file.number("hole_limit_mm", report.hole_limit, kMilli);
  file.list("holes", report.holes, [&](const File& node, auto& hole) {
    place(node, report.body, hole);
    node.row(hole);
  });
}

/// An object that may be null, or missing in older files.
template <class File, class Part, class Fields>
void optional(const File& file, const char* key, Part& part, Fields fields) {
  if constexpr (File::kReads) {
    if (!file.in.find(key)) return;
    part = typename Part::value_type{};
  } else if (!part) {
    file.value(key, nullptr);
    return;
  }
  file.object(key, [&](const File& node) { fields(node, *part); });
}

template <class File, class Truth>
void truth(const File& file, Body body, Truth& truth) {
  file.value("file", truth.file);
  file.value("surface", truth.surface);
  file.value("from_scan", truth.from_scan);
  file.value("places", truth.places);
  file.value("beside", truth.beside);
  file.object("placed", [&](const File& node) { node.row(truth.placed); });
  file.object("shape", [&](const File& node) { node.row(truth.shape); });
  if (body == Body::wheel)
    file.number("along_deg", truth.along, kDegrees);
  else
    file.number("along_mm", truth.along, kMilli);
  file.value("reversed", truth.reversed);
  file.vector("shift_um", truth.shift_S, kMicro);
  file.vector("turn_urad", truth.turn_S, kMicro);
}

template <class File, class Report>
void fit(const File& file, Report& report) {
  optional(file, "kept_sections", report.sections, kRows);
  file.list("levels", report.levels, kRows);
  file.value("fitted_points", report.fitted_points);
  file.value("held_out_points", report.held_out_points);
  file.number("held_out_rms_mm", report.held_out_rms, kMilli);
  file.number("held_out_error_mm", report.held_out_error, kMilli);
  optional(file, "surface_errors", report.errors, kRows);
  later_list(file, "noise_classes", report.noise_classes, kRows);
  later_list(file, "error_sources", report.error_parts, kRows);
  file.number("histogram_range_mm", report.residual_range, kMilli);
  file.value("histogram", report.residual_histogram);
  optional(file, "residuals", report.residuals, [](const File& node, auto& residuals) {
    node.row(residuals.distances);
    node.value("below", residuals.below);
    node.value("above", residuals.above);
  });
}

template <class File, class Report>
void range(const File& file, Report& report) {
  file.value("closed", report.closed);
  const bool wheel = report.body == Body::wheel;
  const auto ends = [&](const char* key, auto& from, auto& to, double factor) {
    if constexpr (File::kReads) {
      const std::vector<double> both = file.several(key, 2);
      from = both[0] / factor;
      to = both[1] / factor;
    } else {
      file.numbers(key, {from, to}, factor);
    }
  };
  ends(wheel ? "u_deg" : "u_mm", report.u_min, report.u_max, wheel ? kDegrees : kMilli);
  ends("y_mm", report.y_min, report.y_max, kMilli);
}

/// Two objects: counts and rules by reason.
template <class File, class Report>
void removed(const File& file, Report& report) {
  if constexpr (File::kReads) {
    for (const auto& [reason, count] : file.in.at("removed").entries())
      report.removed.push_back({reason, count.count(), file.in.at("removed_why").text(reason)});
  } else {
    Json counts = Json::object(), why = Json::object();
    for (const ImportReport::Removed& one : removed_by_reason(report)) {
      counts[one.reason] = one.count;
      why[one.reason] = one.why;
    }
    file.out["removed"] = std::move(counts);
    file.out["removed_why"] = std::move(why);
  }
}

template <class File, class Report>
void audit(const File& file, Report& report) {
  file.object("treadmark", [&](const File& node) { node.value("version", report.version); });
  if constexpr (File::kReads)
    report.body = file.in.at("body").one_of({"wheel", "rail"}) == 0 ? Body::wheel : Body::rail;
  else
    file.value("body", body_name(report.body));
  file.value("from_map", report.from_map);
  if constexpr (!File::kReads) {
    file.value("input", report.inputs.empty() ? "" : report.inputs.front().file);
    file.value("sha256", report.inputs.empty() ? "" : report.inputs.front().sha256);
  }
  file.list("inputs", report.inputs, kRows);
  file.value("unit", report.unit);
  file.value("unit_from", report.unit_from);
  file.value("points_read", report.points_read);
  file.value("points_used", report.points_used);
  removed(file, report);
  file.value("warnings", report.warnings);
  file.number("noise_mm", report.noise, kMilli);
  file.number("residual_rms_mm", report.residual_rms, kMilli);
  file.number("residual_max_mm", report.residual_max, kMilli);
  if (!report.from_map)
    file.object("frame", [&](const File& node) { frame(node, report); });
  else if constexpr (!File::kReads)
    file.value("frame", nullptr);
  optional(file, "line", report.line, [](const File& node, auto& line) {
    node.row(line);
    node.list("places", line.places, kRows);
  });
  optional(file, "track", report.track, [](const File& node, auto& track) {
    node.row(track);
    node.list("places", track.places, kRows);
    if constexpr (File::kReads) {
      auto left = std::make_shared<ImportReport>();
      node.object("left_rail", [&](const File& rail) { audit(rail, *left); });
      track.left = std::move(left);
    } else {
      node.object("left_rail", [&](const File& rail) { audit(rail, *track.left); });
    }
  });
  file.object("coverage", [&](const File& node) { coverage(node, report); });
  file.object("fit", [&](const File& node) { fit(node, report); });
  file.number("damage_threshold_mm", report.damage_threshold, kMilli);
  file.list("damage", report.damage, [&](const File& node, auto& part) {
    place(node, report.body, part);
    node.row(part);
  });
  file.object("range", [&](const File& node) { range(node, report); });
  optional(file, "truth", report.truth, [&](const File& node, auto& known) { truth(node, report.body, known); });
  file.list("outputs", report.outputs, kRows);
  file.value("settings_toml", report.settings_toml);
}

template <class File, class Report>
void times(const File& file, Report& report) {
  file.list("steps", report.steps, kRows);
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

std::vector<ImportReport::Removed> removed_by_reason(const ImportReport& report) {
  std::vector<ImportReport::Removed> out;
  for (const ImportReport::Removed& one : report.removed) {
    const auto known = ranges::find(out, one.reason, &ImportReport::Removed::reason);
    if (known == out.end()) {
      out.push_back(one);
      continue;
    }
    known->count += one.count;
    if (known->why != one.why) known->why += "; " + one.why;
  }
  return out;
}

std::string import_json(const ImportReport& report, bool with_seconds) {
  Json out = Json::object();
  audit(ImportWriter{out}, report);
  if (with_seconds) out["seconds"] = seconds(report);
  return dumped(out) + "\n";
}

std::string import_report_schema() {
  using Report = ImportReport;
  const auto never_null = [](SchemaRow& row) { row.or_null = false; };
  return filled_schema(kImportSchema, {{"input", schema_rows<Report::Input>()},
                                       {"pass", schema_rows<Report::Pass>()},
                                       {"line", schema_rows<Report::Line>()},
                                       {"line_place", schema_rows<Report::LinePlace>()},
                                       {"track", schema_rows<Report::Track>()},
                                       {"track_place", schema_rows<Report::TrackPlace>()},
                                       {"noise_class", schema_rows<Report::NoiseClass>()},
                                       {"registration", schema_rows<Report::Registration>()},
                                       {"hole", placed_rows<Report::Hole>()},
                                       {"sections", changed(schema_rows<Report::Sections>(), never_null)},
                                       {"level", schema_rows<Report::Level>()},
                                       {"errors", changed(schema_rows<ErrorSize>(), never_null)},
                                       {"error_part", schema_rows<Report::ErrorPart>()},
                                       {"residuals", changed(schema_rows<Report::Distances>(), never_null)},
                                       {"distances", schema_rows<Report::Distances>()},
                                       {"damage", placed_rows<Report::Damage>()},
                                       {"output", schema_rows<Report::Output>()}});
}

std::string import_times_json(const ImportReport& report) {
  Json out = Json::object();
  times(ImportWriter{out}, report);
  return dumped(out) + "\n";
}

ImportReport read_import_json(const std::filesystem::path& file) {
  ImportReport out;
  audit(ImportReader{read_json_file(file)}, out);
  return out;
}

void read_import_times(const std::filesystem::path& file, ImportReport& report) {
  times(ImportReader{read_json_file(file)}, report);
}

}  // namespace treadmark::io
