// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_settings.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string_view>
#include <variant>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/nearest_key.hpp"

namespace treadmark::io {
namespace {

constexpr double kMost = std::numeric_limits<double>::max();

struct NumberKey {
  std::function<double&(ImportSettings&)> place;
  double least = 0.0, most = kMost;
};
struct FlagKey {
  std::function<bool&(ImportSettings&)> place;
};
struct WordKey {
  std::function<std::string&(ImportSettings&)> place;
  std::vector<std::string> choices;  // empty: any text
};
struct DirectionKey {
  std::function<std::vector<double>&(ImportSettings&)> place;
};

struct Key {
  std::string table, name, doc;
  std::variant<NumberKey, FlagKey, WordKey, DirectionKey> kind;
};

#define TREADMARK_PLACE(type, table, name) [](ImportSettings& s) -> type& { return s.table.name; }

const std::vector<Key>& keys() {
  static const std::vector<Key> kKeys{
      {"scan", "body", "wheel or rail; auto: by the extension of the surface file",
       WordKey{TREADMARK_PLACE(std::string, scan, body), {"auto", "wheel", "rail"}}},
      {"scan", "unit", "of the coordinates; auto: what the file says, else what makes it a wheel or rail",
       WordKey{TREADMARK_PLACE(std::string, scan, unit), {"auto", "m", "mm", "um", "in"}}},
      {"scan", "pass_steps", "align the passes of the scanner to each other where they overlap",
       FlagKey{TREADMARK_PLACE(bool, scan, pass_steps)}},
      {"placement", "nominal", "standard profile, profile file or none; auto: S1002 for wheels, 60E1 for rails",
       WordKey{TREADMARK_PLACE(std::string, placement, nominal), {}}},
      {"placement", "nominal_radius_mm", "of a wheel, at profile z = 0; 0: from the scan",
       NumberKey{TREADMARK_PLACE(double, placement, nominal_radius_mm)}},
      {"placement", "up", "direction out of a rail's head in the scan's frame, roughly; empty: found",
       DirectionKey{TREADMARK_PLACE(std::vector<double>, placement, up)}},
      {"placement", "forward",
       "direction of +x of a rail, of +y (flange to field side) of a wheel, roughly; empty: found",
       DirectionKey{TREADMARK_PLACE(std::vector<double>, placement, forward)}},
      {"placement", "zero",
       "what lies at theta = 0 or x = 0: the largest defect, the scan's own axes (origin), or a direction",
       WordKey{TREADMARK_PLACE(std::string, placement, zero), {"defect", "scan", "direction"}}},
      {"placement", "zero_direction", "from the axle (wheel), in the scan's frame, for zero = \"direction\"",
       DirectionKey{TREADMARK_PLACE(std::vector<double>, placement, zero_direction)}},
      {"placement", "zero_deg", "theta that it gets",
       NumberKey{TREADMARK_PLACE(double, placement, zero_deg), -360.0, 360.0}},
      {"placement", "zero_mm", "x that it gets", NumberKey{TREADMARK_PLACE(double, placement, zero_mm), -1e6, 1e6}},
      {"clean", "strays", "remove outliers and small clusters among thinned points before anything else",
       FlagKey{TREADMARK_PLACE(bool, clean, strays)}},
      {"clean", "stray_distance",
       "mean distance to neighbours from which a point is stray, over the size to which points are thinned; 0: 4 times "
       "the usual one",
       NumberKey{TREADMARK_PLACE(double, clean, stray_distance)}},
      {"clean", "stray_cluster", "clusters with less than this part of the largest one are stray",
       NumberKey{TREADMARK_PLACE(double, clean, stray_cluster), 0.0, 1.0}},
      {"clean", "farthest_mm", "points farther from the section are removed",
       NumberKey{TREADMARK_PLACE(double, clean, farthest_mm), 0.01, 50.0}},
      {"clean", "outlier_factor", "standard deviations from the surroundings that make an outlier; 0: none are",
       NumberKey{TREADMARK_PLACE(double, clean, outlier_factor)}},
      {"clean", "edge_share", "where more of the surroundings would be outliers they are an edge and stay",
       NumberKey{TREADMARK_PLACE(double, clean, edge_share), 0.0, 1.0}},
      {"clean", "hole_limit_mm",
       "holes up to this diameter are filled, larger ones stay; 0: 10, or twice the distance of the lines",
       NumberKey{TREADMARK_PLACE(double, clean, hole_limit_mm)}},
      {"clean", "least_filled", "lateral positions that are covered along less of the band are left out",
       NumberKey{TREADMARK_PLACE(double, clean, least_filled), 0.0, 1.0}},
      {"fit", "resolution_mm", "distance of the surface's points",
       NumberKey{TREADMARK_PLACE(double, fit, resolution_mm), 0.02, 20.0}},
      {"fit", "finest_mm", "smallest distance of the spline's knots; 0: 0.5, or the distance of the points",
       NumberKey{TREADMARK_PLACE(double, fit, finest_mm), 0.0, 50.0}},
      {"fit", "significance", "how far details must stand out of the noise; above 1 smooths more",
       NumberKey{TREADMARK_PLACE(double, fit, significance), 0.05, 20.0}},
      {"fit", "follow", "lower the significance step by step while points held out are met better",
       FlagKey{TREADMARK_PLACE(bool, fit, follow)}},
      {"fit", "held_out", "part of the points that the fit does not see, which judge it",
       NumberKey{TREADMARK_PLACE(double, fit, held_out), 0.0, 0.5}},
      {"fit", "tolerance_um",
       "changes along the band below this need no slices of their own; 0: a fiftieth of the noise, 0.02 to 0.5",
       NumberKey{TREADMARK_PLACE(double, fit, tolerance_um)}},
      {"fit", "sections",
       "points that lie in cross-sections: keep (slices with their own points) or fit; auto: keep those with points at "
       "the same places across",
       WordKey{TREADMARK_PLACE(std::string, fit, sections), {"auto", "keep", "fit"}}},
      {"fit", "sections_along", "splines along the band through kept sections: approximate or interpolate",
       WordKey{TREADMARK_PLACE(std::string, fit, sections_along), {"approximate", "interpolate"}}},
      {"fit", "smoothing_lambda_mm3",
       "smoothing across kept sections before triangles or offsets are made of them; slices stay as measured",
       NumberKey{TREADMARK_PLACE(double, fit, smoothing_lambda_mm3)}},
      {"fit", "base", "section below offsets: fitted or nominal",
       WordKey{TREADMARK_PLACE(std::string, fit, base), {"fitted", "nominal"}}},
      {"fit", "mesh", "band: Delaunay over the unrolled band; free: advancing front through the cleaned points",
       WordKey{TREADMARK_PLACE(std::string, fit, mesh), {"band", "free"}}},
      {"fit", "decimate_um", "leave out nodes that triangles do not need to this tolerance; 0: keep all",
       NumberKey{TREADMARK_PLACE(double, fit, decimate_um)}},
      {"damage", "threshold_mm", "depth from which damage is listed; 0: from the noise",
       NumberKey{TREADMARK_PLACE(double, damage, threshold_mm)}},
      {"map", "height_unit", "of the deviations of a gridded map; auto: what the file says, else scan.unit",
       WordKey{TREADMARK_PLACE(std::string, map, height_unit), {"auto", "m", "mm", "um", "in"}}},
      {"map", "angles_deg", "positions of a gridded map round the wheel are degrees, not lengths",
       FlagKey{TREADMARK_PLACE(bool, map, angles_deg)}},
  };
  return kKeys;
}

SourcePosition at(const toml::node& node, const std::string& file) {
  const toml::source_region& source = node.source();
  return {file, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

[[noreturn]] void fail(const std::string& message, const SourcePosition& where, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, message, where, advice);
}

double number_of(const toml::node& node, const std::string& name, const SourcePosition& where) {
  const auto value = node.value<double>();
  if (!value || !node.is_number() || !std::isfinite(*value)) fail(fmt::format("'{}' must be a number", name), where);
  return *value;
}

void set(ImportSettings& settings, const Key& key, const toml::node& node, const SourcePosition& where) {
  const std::string name = key.table + '.' + key.name;
  if (const auto* number = std::get_if<NumberKey>(&key.kind)) {
    const double value = number_of(node, name, where);
    if (value < number->least || value > number->most)
      fail(number->most < kMost
               ? fmt::format("'{}' must be between {:g} and {:g}, not {:g}", name, number->least, number->most, value)
               : fmt::format("'{}' must be at least {:g}, not {:g}", name, number->least, value),
           where);
    number->place(settings) = value;
  } else if (const auto* flag = std::get_if<FlagKey>(&key.kind)) {
    const auto value = node.value_exact<bool>();
    if (!value) fail(fmt::format("'{}' must be true or false", name), where);
    flag->place(settings) = *value;
  } else if (const auto* word = std::get_if<WordKey>(&key.kind)) {
    const auto value = node.value_exact<std::string>();
    if (!value || value->empty()) fail(fmt::format("'{}' must be a text", name), where);
    if (!word->choices.empty() && std::find(word->choices.begin(), word->choices.end(), *value) == word->choices.end())
      fail(fmt::format("'{}' cannot be \"{}\"", name, *value), where,
           fmt::format("choose {}", fmt::join(word->choices, ", ")));
    word->place(settings) = *value;
  } else {
    const toml::array* list = node.as_array();
    if (list == nullptr || (!list->empty() && list->size() != 3))
      fail(fmt::format("'{}' must be a list of three numbers, or empty", name), where);
    std::vector<double> values;
    double square = 0.0;
    for (const toml::node& entry : *list) {
      values.push_back(number_of(entry, name, where));
      square += values.back() * values.back();
    }
    if (!values.empty() && !(square > 0.0))
      fail(fmt::format("'{}' is no direction: all its numbers are zero", name), where);
    std::get<DirectionKey>(key.kind).place(settings) = values;
  }
}

[[noreturn]] void unknown(const std::string& name, const SourcePosition& where) {
  std::vector<std::string> known;
  for (const Key& key : keys()) known.push_back(key.table + '.' + key.name);
  const std::string nearest = nearest_key(name, known);
  fail(fmt::format("there is no setting '{}'", name), where,
       nearest.empty() ? "treadmark import --list-settings shows all" : fmt::format("did you mean '{}'?", nearest));
}

void read(const toml::table& document, const std::string& file, ImportSettings& settings) {
  for (const auto& [table_name, table_node] : document) {
    const toml::table* table = table_node.as_table();
    if (table == nullptr) unknown(std::string(table_name.str()), at(table_node, file));
    for (const auto& [name, node] : *table) {
      const auto found = std::find_if(
          keys().begin(), keys().end(),
          [&, t = table_name.str(), n = name.str()](const Key& key) { return key.table == t && key.name == n; });
      if (found == keys().end()) unknown(std::string(table_name.str()) + '.' + std::string(name.str()), at(node, file));
      set(settings, *found, node, at(node, file));
    }
  }
}

std::string text_of(ImportSettings& settings, const Key& key) {
  if (const auto* number = std::get_if<NumberKey>(&key.kind)) return fmt::format("{}", number->place(settings));
  if (const auto* flag = std::get_if<FlagKey>(&key.kind)) return flag->place(settings) ? "true" : "false";
  if (const auto* word = std::get_if<WordKey>(&key.kind)) {
    std::ostringstream quoted;
    quoted << toml::value<std::string>(word->place(settings));
    return quoted.str();
  }
  return fmt::format("[{}]", fmt::join(std::get<DirectionKey>(key.kind).place(settings), ", "));
}

}  // namespace

void read_import_settings(const std::filesystem::path& file, ImportSettings& settings) {
  try {
    read(toml::parse_file(file.string()), file.string(), settings);
  } catch (const toml::parse_error& error) {
    throw Error(
        ErrorKind::configuration, std::string(error.description()),
        {file.string(), static_cast<int>(error.source().begin.line), static_cast<int>(error.source().begin.column)});
  }
}

void set_import_setting(ImportSettings& settings, const std::string& assignment) {
  const std::size_t equals = assignment.find('='), point = assignment.find('.');
  if (equals == std::string::npos || point == std::string::npos || point > equals)
    fail(fmt::format("'{}' is no setting", assignment), {}, "write table.key=value");
  const std::string table = assignment.substr(0, point), name = assignment.substr(point + 1, equals - point - 1),
                    value = assignment.substr(equals + 1);
  const auto found = std::find_if(keys().begin(), keys().end(),
                                  [&](const Key& key) { return key.table == table && key.name == name; });
  if (found == keys().end()) unknown(table + '.' + name, {});
  // a bare word is a text; numbers, flags and lists stand as in TOML
  const bool bare = std::holds_alternative<WordKey>(found->kind) && (value.empty() || value.front() != '"');
  if (bare) {
    set(settings, *found, toml::value<std::string>(value), {});
    return;
  }
  try {
    const toml::table parsed = toml::parse("value = " + value);
    if (parsed.size() != 1) fail(fmt::format("'{}.{}' takes one value", table, name), {});
    set(settings, *found, *parsed.get("value"), {});
  } catch (const toml::parse_error&) {
    fail(fmt::format("the value in '{}' cannot be read", assignment), {}, "write it as in TOML");
  }
}

std::string import_settings_toml(const ImportSettings& settings) {
  ImportSettings copy = settings;
  std::string out = "# Settings of treadmark import; lengths in mm or um as the names say.\n", table;
  for (const Key& key : keys()) {
    if (key.table != table) out += fmt::format("\n[{}]\n", key.table);
    table = key.table;
    std::string choices;
    if (const auto* word = std::get_if<WordKey>(&key.kind); word != nullptr && !word->choices.empty())
      choices = fmt::format(" ({})", fmt::join(word->choices, ", "));
    out += fmt::format("{} = {}  # {}{}\n", key.name, text_of(copy, key), key.doc, choices);
  }
  return out;
}

}  // namespace treadmark::io
