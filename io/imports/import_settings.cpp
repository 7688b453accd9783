// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_settings.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/io/files/text.hpp"
#include "treadmark/io/settings/key_info.hpp"
#include "treadmark/io/settings/key_list.hpp"
#include "treadmark/io/settings/key_schema.hpp"

namespace treadmark::io {
namespace {

using S = ImportSettings;
using ImportKey = SettingKey<S>;
using ImportKeys = SettingKeys<S>;

template <class Table, class Member>
auto at(Table S::*table, Member Table::*member) {
  return [=](auto& settings) -> auto& { return settings.*table.*member; };
}

std::vector<ImportKey> listed_keys() {
  ImportKeys list(ImportKeys::Numbers::as_written);
  list.word("scan.body", {"auto", "wheel", "rail"}, "wheel or rail; auto: by the extension of the surface file",
            at(&S::scan, &S::Scan::body));
  list.word("scan.unit", {"auto", "m", "mm", "um", "in"},
            "of the coordinates; auto: what the file says, else what makes it a wheel or rail",
            at(&S::scan, &S::Scan::unit));
  list.direction("scan.box_from",
                 "least x, y and z of points that are read, in the scan's frame and unit; empty: all points are",
                 at(&S::scan, &S::Scan::box_from));
  list.direction("scan.box_to", "greatest x, y and z of these", at(&S::scan, &S::Scan::box_to));
  list.direction("scan.station",
                 "where the scanner stood, in the scan's frame and unit; empty: what the file says (PTX, E57)",
                 at(&S::scan, &S::Scan::station));
  list.number("scan.nearest", kNotNegative, "least distance from the scanner of points that are read, in their unit",
              at(&S::scan, &S::Scan::nearest));
  list.number("scan.farthest", kNotNegative, "greatest distance of these; 0: any", at(&S::scan, &S::Scan::farthest));
  list.number("scan.least_intensity", kNotNegative, "weakest echo of these, as the file has it; 0: any",
              at(&S::scan, &S::Scan::least_intensity));
  list.number(
      "scan.register_mm", {{}, 0.0, 1000.0},
      "how far scans (passes) may lie off each other, which are then laid on each other first; 0: they lie within "
      "millimetres already",
      at(&S::scan, &S::Scan::register_mm));
  list.flag("scan.pass_steps", "align the passes of the scanner to each other where they overlap",
            at(&S::scan, &S::Scan::pass_steps));
  list.word("scan.rails", {"one", "both"},
            "both: the two rails of a track, each to a file of its own (NAME-left, NAME-right), with gauge and cant",
            at(&S::scan, &S::Scan::rails));

  list.word("placement.nominal", {}, "standard profile, profile file or none; auto: S1002 for wheels, 60E1 for rails",
            at(&S::placement, &S::Placement::nominal));
  list.number("placement.nominal_radius_mm", kNotNegative, "of a wheel, at profile z = 0; 0: from the scan",
              at(&S::placement, &S::Placement::nominal_radius_mm));
  list.direction("placement.up", "direction out of a rail's head in the scan's frame, roughly; empty: found",
                 at(&S::placement, &S::Placement::up));
  list.direction("placement.forward",
                 "direction of +x of a rail, of +y (flange to field side) of a wheel, roughly; empty: found",
                 at(&S::placement, &S::Placement::forward));
  list.word("placement.zero", {"defect", "scan", "direction"},
            "what lies at theta = 0 or x = 0: the largest defect, the scan's own axes (origin), or a direction",
            at(&S::placement, &S::Placement::zero));
  list.direction("placement.zero_direction", "from the axle (wheel), in the scan's frame, for zero = \"direction\"",
                 at(&S::placement, &S::Placement::zero_direction));
  list.number("placement.zero_deg", {{}, -360.0, 360.0}, "theta that it gets",
              at(&S::placement, &S::Placement::zero_deg));
  list.number("placement.zero_mm", {{}, -1e6, 1e6}, "x that it gets", at(&S::placement, &S::Placement::zero_mm));
  list.word(
      "placement.line", {},
      "line along which a rail lies: auto: found; straight; a file of points (x y z) along it, in the scan's frame "
      "and unit, that it follows; or a file (.toml) with the [layout] with which it is compared",
      at(&S::placement, &S::Placement::line));
  list.number("placement.line_beside_mm", {{}, -1e4, 1e4},
              "how far to the right of the layout's line the rail lies: half a gauge and half a head",
              at(&S::placement, &S::Placement::line_beside_mm));

  list.flag("clean.strays", "remove outliers and small clusters among thinned points before anything else",
            at(&S::clean, &S::Clean::strays));
  list.number(
      "clean.stray_distance", kNotNegative,
      "mean distance to neighbours from which a point is stray, over the size to which points are thinned; 0: 4 times "
      "the usual one",
      at(&S::clean, &S::Clean::stray_distance));
  list.number("clean.stray_cluster", {{}, 0.0, 1.0}, "clusters with less than this part of the largest one are stray",
              at(&S::clean, &S::Clean::stray_cluster));
  list.number("clean.farthest_mm", {{}, 0.01, 50.0}, "points farther from the section are removed",
              at(&S::clean, &S::Clean::farthest_mm));
  list.number("clean.outlier_factor", kNotNegative,
              "standard deviations from the surroundings that make an outlier; 0: none are",
              at(&S::clean, &S::Clean::outlier_factor));
  list.number("clean.edge_share", {{}, 0.0, 1.0},
              "where more of the surroundings would be outliers they are an edge and stay",
              at(&S::clean, &S::Clean::edge_share));
  list.flag("clean.mixed_points",
            "remove points between two surfaces, where the scanner's place is known: the laser's spot hit both",
            at(&S::clean, &S::Clean::mixed_points));
  list.number("clean.hole_limit_mm", kNotNegative,
              "holes up to this diameter are filled, larger ones stay; 0: 10, or twice the distance of the lines",
              at(&S::clean, &S::Clean::hole_limit_mm));
  list.number("clean.least_filled", {{}, 0.0, 1.0},
              "lateral positions that are covered along less of the band are left out",
              at(&S::clean, &S::Clean::least_filled));

  list.number("fit.resolution_mm", {{}, 0.02, 20.0}, "distance of the surface's points",
              at(&S::fit, &S::Fit::resolution_mm));
  list.number("fit.finest_mm", {{}, 0.0, 50.0},
              "smallest distance of the spline's knots; 0: 0.5, or the distance of the points",
              at(&S::fit, &S::Fit::finest_mm));
  list.number("fit.significance", {{}, 0.05, 20.0}, "how far details must stand out of the noise; above 1 smooths more",
              at(&S::fit, &S::Fit::significance));
  list.flag("fit.follow", "lower the significance step by step while points held out are met better",
            at(&S::fit, &S::Fit::follow));
  list.number("fit.held_out", {{}, 0.0, 0.5}, "part of the points that the fit does not see, which judge it",
              at(&S::fit, &S::Fit::held_out));
  list.flag("fit.errors", "fit each half of the points, too, which tells results how well the surface is known",
            at(&S::fit, &S::Fit::errors));
  list.flag(
      "fit.weights",
      "points count by the noise of their pass, of their angle to the beam and of their intensity, where it differs",
      at(&S::fit, &S::Fit::weights));
  list.number("fit.tolerance_um", kNotNegative,
              "changes along the band below this need no slices of their own; 0: a fiftieth of the noise, 0.02 to 0.5",
              at(&S::fit, &S::Fit::tolerance_um));
  list.word("fit.sections", {"auto", "keep", "fit"},
            "points that lie in cross-sections: keep (each becomes a slice) or fit; auto: keep those with points at "
            "the same places across",
            at(&S::fit, &S::Fit::sections));
  list.word("fit.sections_along", {"approximate", "interpolate"},
            "splines along the band through kept sections: approximate or interpolate",
            at(&S::fit, &S::Fit::sections_along));
  list.word("fit.smoothing", {"auto", "none"},
            "kept sections: auto: points move onto the curve that they stand for, as far as their noise asks for; none",
            at(&S::fit, &S::Fit::smoothing));
  list.number("fit.smoothing_lambda_mm3", kNotNegative,
              "smoothing across kept sections that noise does not smooth, before triangles or offsets are made of them",
              at(&S::fit, &S::Fit::smoothing_lambda_mm3));
  list.word("fit.base", {"fitted", "nominal"}, "section below offsets: fitted or nominal", at(&S::fit, &S::Fit::base));
  list.word("fit.mesh", {"band", "free"},
            "band: Delaunay over the developed band; free: advancing front through the cleaned points",
            at(&S::fit, &S::Fit::mesh));
  list.number("fit.decimate_um", kNotNegative,
              "leave out nodes that triangles do not need to this tolerance; 0: keep all",
              at(&S::fit, &S::Fit::decimate_um));
  list.number("fit.written_um", {{}, 0.001, 1e6},
              "a surface that is written, read again, farther from the fitted one is an error",
              at(&S::fit, &S::Fit::written_um));

  list.number("errors.lateral_mm", {{}, 0.0, 1000.0},
              "standard deviation of the surface's place across that the scan does not show, as of a gauge",
              at(&S::errors, &S::Errors::lateral_mm));
  list.number("errors.scanner_um", {{}, 0.0, 1e6},
              "standard deviation of heights that points next to each other share and the surface follows: what the "
              "scanner is known to do wrong",
              at(&S::errors, &S::Errors::scanner_um));
  list.number("errors.scanner_mm", {{}, 0.0, 1e9}, "how far points share it", at(&S::errors, &S::Errors::scanner_mm));

  list.number("damage.threshold_mm", kNotNegative, "depth from which damage is listed; 0: from the noise",
              at(&S::damage, &S::Damage::threshold_mm));

  list.word("tiles.use", {"auto", "always", "never"},
            "whether a long rail is imported tile by tile, in bounded memory; auto: from tiles.from_MB on, if it "
            "becomes slices",
            at(&S::tiles, &S::Tiles::use));
  list.number("tiles.from_MB", kNotNegative, "size of the files from which that is done",
              at(&S::tiles, &S::Tiles::from_MB));
  list.number("tiles.length_m", {{}, 0.2, 1000.0}, "of a tile; 1.6 m more to both sides are looked at",
              at(&S::tiles, &S::Tiles::length_m));
  list.number("tiles.sample_points", {{}, 1e4, 1e9}, "evenly drawn points by which line, place and section are found",
              at(&S::tiles, &S::Tiles::sample_points));

  list.word("map.height_unit", {"auto", "m", "mm", "um", "in"},
            "of the deviations of a gridded map; auto: what the file says, else scan.unit",
            at(&S::map, &S::Map::height_unit));
  list.flag("map.angles_deg", "positions of a gridded map round the wheel are degrees, not lengths",
            at(&S::map, &S::Map::angles_deg));
  list.word("map.values", {"deviations", "heights"},
            "what a matrix with positions holds: deviations from the nominal profile, or heights, up",
            at(&S::map, &S::Map::values));
  list.number("map.across_mm", kNotNegative, "distance of the heights in a row of a line scanner",
              at(&S::map, &S::Map::across_mm));
  list.number("map.along_mm", kNotNegative,
              "distance of such rows; 0: their first column, if it grows or falls, says where they are",
              at(&S::map, &S::Map::along_mm));
  return std::move(list.keys);
}

const std::vector<ImportKey>& import_keys() {
  static const std::vector<ImportKey> keys = listed_keys();
  return keys;
}

[[noreturn]] void fail(const std::string& message, const SourcePosition& where, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, message, where, advice);
}

double number_of(const CaseValue& value, const std::string& name, const SourcePosition& where) {
  const bool number = std::holds_alternative<double>(value.data) || std::holds_alternative<std::int64_t>(value.data);
  if (!number || !std::isfinite(value.number()))
    fail(fmt::format("'{}' must be a number", name), where, advice_on_type(key_info(name, KeyType::number, {}), value));
  return value.number();
}

void check_triple(const CaseValue& value, const std::string& name, bool direction) {
  if (!value.is_list() || (!value.list().empty() && value.list().size() != 3))
    fail(fmt::format("'{}' must be a list of three numbers, or empty", name), value.where);
  double square = 0.0;
  for (const CaseValue& one : value.list()) square += std::pow(number_of(one, name, value.where), 2);
  if (direction && !value.list().empty() && !(square > 0.0))
    fail(fmt::format("'{}' is no direction: all its numbers are zero", name), value.where);
}

void check_number(const CaseValue& value, const KeyInfo& key) {
  const double number = number_of(value, key.path, value.where), least = key.at_least.value_or(0.0);
  if (key.above && !(number > *key.above))
    fail(fmt::format("'{}' must be above {:g}, not {:g}", key.path, *key.above, number), value.where);
  if ((key.at_least && number < least) || (key.at_most && number > *key.at_most))
    fail(key.at_most
             ? fmt::format("'{}' must be between {:g} and {:g}, not {:g}", key.path, least, *key.at_most, number)
             : fmt::format("'{}' must be at least {:g}, not {:g}", key.path, least, number),
         value.where);
}

void set(ImportSettings& settings, const ImportKey& key, const CaseValue& value) {
  const KeyInfo& info = key.info;
  if (info.type == KeyType::number) {
    check_number(value, info);
  } else if (info.type == KeyType::direction) {
    check_triple(value, info.path, info.path.starts_with("placement."));
  } else if (info.type == KeyType::flag) {
    if (!std::holds_alternative<bool>(value.data))
      fail(fmt::format("'{}' must be true or false", info.path), value.where, advice_on_type(info, value));
  } else {
    const auto* word = std::get_if<std::string>(&value.data);
    if (word == nullptr || word->empty())
      fail(fmt::format("'{}' must be a text", info.path), value.where,
           word == nullptr ? advice_on_type(info, value) : std::string());
    if (!info.choices.empty() && std::find(info.choices.begin(), info.choices.end(), *word) == info.choices.end())
      fail(fmt::format("'{}' cannot be \"{}\"", info.path, *word), value.where,
           fmt::format("choose {}", fmt::join(info.choices, ", ")));
  }
  key.set(settings, value, {});
}

[[noreturn]] void unknown(const std::string& path, const SourcePosition& where) {
  std::vector<std::string> known;
  for (const ImportKey& key : import_keys()) known.push_back(key.info.path);
  const std::string nearest = nearest_key(path, known);
  fail(fmt::format("there is no setting '{}'", path), where,
       nearest.empty() ? "treadmark import --list-settings shows all" : fmt::format("did you mean '{}'?", nearest));
}

const ImportKey& known_key(const std::string& path, const SourcePosition& where) {
  for (const ImportKey& key : import_keys())
    if (key.info.path == path) return key;
  unknown(path, where);
}

}  // namespace

void read_import_settings(const std::filesystem::path& file, ImportSettings& settings) {
  for (const CaseEntry& table : parse_toml(read_input(file, "file of settings"), file.string())) {
    if (!table.value.is_table()) unknown(table.key, table.value.where);
    for (const CaseEntry& entry : table.value.table())
      set(settings, known_key(table.key + '.' + entry.key, entry.value.where), entry.value);
  }
}

void set_import_setting(ImportSettings& settings, const std::string& assignment) {
  const std::size_t equals = assignment.find('='), point = assignment.find('.');
  if (equals == std::string::npos || point == std::string::npos || point > equals)
    fail(fmt::format("'{}' is no setting", assignment), {}, "write table.key=value");
  const std::string path = assignment.substr(0, equals), text = assignment.substr(equals + 1);
  const ImportKey& key = known_key(path, {});
  // a bare word is a text; numbers, flags and lists stand as in TOML
  const bool word = key.info.type == KeyType::text || key.info.type == KeyType::choice;
  if (word && (text.empty() || text.front() != '"')) return set(settings, key, {{}, text});
  CaseTable parsed;
  try {
    parsed = parse_toml("value = " + text, "");
  } catch (const Error& error) {
    fail(fmt::format("the value in '{}' cannot be read", assignment), {},
         error.advice().empty() ? "write it as in TOML" : error.advice());
  }
  if (parsed.size() != 1) fail(fmt::format("'{}' takes one value", path), {});
  set(settings, key, {{}, parsed.front().value.data});
}

std::string import_settings_toml(const ImportSettings& settings) {
  std::string out = "# Settings of treadmark import; lengths in mm or um as the names say.\n", table;
  for (const ImportKey& key : import_keys()) {
    const KeyInfo& info = key.info;
    const std::size_t dot = info.path.find('.');
    if (info.path.substr(0, dot) != table) out += fmt::format("\n[{}]\n", info.path.substr(0, dot));
    table = info.path.substr(0, dot);
    const std::string choices = info.choices.empty() ? "" : fmt::format(" ({})", fmt::join(info.choices, ", "));
    out += fmt::format("{} = {}  # {}{}\n", info.path.substr(dot + 1),
                       key.text ? key.text(settings) : fmt::format("{}", key.get(settings)), info.doc, choices);
  }
  return out;
}

std::string import_settings_schema() {
  return file_schema("Treadmark import settings", infos_of(std::span(import_keys())));
}

std::string import_settings_table() { return key_table(infos_of(std::span(import_keys()))); }

}  // namespace treadmark::io
