// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/list_files.hpp"
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/geometry/pages/geometry_page.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct GeometryOptions {
  std::string case_file, wheel, wheel_left, rail, rail_left, new_wheel, new_rail;
  std::optional<double> diameter_mm, diameter_left_mm, gauge_mm, gauge_height_mm, rail_origins_mm, wheel_origins_mm,
      amplitude_mm, axle_load_kN;
  std::string cant, amplitudes_mm = "1:7:0.1", gauges_mm;
  std::string roll = "none", backend;
  double yaw_mrad = 0.0, pitch_deg = 0.0, position_mm = 0.0, step_mm = 0.1, second_mm = 0.05, resolution_mm = 0.0,
         scale_to_mm = 1.0;
  std::string pairs;                                                ///< a list of them; empty: one
  std::string json_file, csv_file, hdf5_file, folder, report_file;  ///< empty: none
  std::vector<std::string> overrides;
};

std::optional<double> metres(const std::optional<double>& mm) {
  if (!mm) return std::nullopt;
  return kMillimetre * *mm;
}

app::GeometryRequest request_of(const GeometryOptions& o) {
  app::GeometryRequest r;
  r.case_file = o.case_file;
  r.wheel = o.wheel, r.wheel_left = o.wheel_left, r.rail = o.rail, r.rail_left = o.rail_left;
  r.new_wheel = o.new_wheel, r.new_rail = o.new_rail;
  r.diameter = metres(o.diameter_mm), r.diameter_left = metres(o.diameter_left_mm);
  r.gauge = metres(o.gauge_mm), r.gauge_height = metres(o.gauge_height_mm);
  r.rail_origins = metres(o.rail_origins_mm), r.wheel_origins = metres(o.wheel_origins_mm);
  if (!o.cant.empty()) r.cant = app::parse_cant(o.cant);
  r.pitch = o.pitch_deg * kPi / 180.0;
  r.x = kMillimetre * o.position_mm;
  r.scale_to_mm = o.scale_to_mm;
  r.backend = o.backend;
  r.resolution = kMillimetre * o.resolution_mm;
  r.overrides = o.overrides;
  if (o.axle_load_kN) r.axle_load = 1e3 * *o.axle_load_kN;
  geometry::AnalysisSettings& s = r.settings;
  s.roll = o.roll == "free" ? geometry::Roll::free : geometry::Roll::none;
  s.yaw = kMillimetre * o.yaw_mrad;
  s.step = kMillimetre * o.step_mm;
  s.second = kMillimetre * o.second_mm;
  s.amplitudes = app::parse_lengths_mm(o.amplitudes_mm);
  s.wanted_amplitude = metres(o.amplitude_mm);
  return r;
}

int run_list(const GeometryOptions& options, const CommonOptions& common) {
  if (!options.json_file.empty() || !options.folder.empty() || !options.gauges_mm.empty() || !options.case_file.empty())
    throw Error(ErrorKind::configuration,
                "--pairs makes one table: CASE, --json, --output and --gauges-mm belong to one pair", {},
                "write the table with --csv, --hdf5 or --report");
  const ListFiles files{options.csv_file, options.hdf5_file, options.report_file};
  const std::vector<app::GeometryRequest> requests = app::read_pair_list(options.pairs, request_of(options));
  const std::optional<app::ResultList> list =
      make_list(files, common, [&](const std::filesystem::path& kept, const Progress& progress) {
        return app::run_pairs(requests, kept, progress);
      });
  if (!list) return kFailed;
  write_list(files, *list);
  return list->failed() > 0 ? kFailed : kOk;
}

int geometry_command(const GeometryOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  if (!options.pairs.empty()) {
    if (options.axle_load_kN || !options.new_wheel.empty() || !options.new_rail.empty())
      throw Error(ErrorKind::configuration,
                  "--pairs makes one table of geometry: --axle-load-kN, --new-wheel and --new-rail belong to one pair");
    return run_list(options, common);
  }
  if (!options.hdf5_file.empty())
    throw Error(ErrorKind::configuration, "--hdf5 is the table of a list of --pairs", {}, "use --json or --csv");
  if (!options.case_file.empty() &&
      (app::is_profile_file(options.case_file) || app::library_body_of(options.case_file)))
    throw Error(ErrorKind::configuration, options.case_file + " is a profile, and CASE is a case file", {},
                "name profiles with --wheel and --rail");
  app::SectionStore store;
  const app::GeometryResult result = app::run_geometry(request_of(options), store);
  std::optional<app::GaugeSweep> sweep;
  if (!options.gauges_mm.empty()) sweep = app::sweep_gauge(result, app::parse_lengths_mm(options.gauges_mm));
  print_notes(result.notes, common.quiet);
  const std::vector<std::string> doubts = app::profile_doubts(result.request);
  for (const std::string& doubt : doubts) std::cerr << "warning: " << doubt << '\n';

  const auto json = [&] { return app::geometry_json(result, sweep ? &*sweep : nullptr); };
  print_results(options.json_file, json,
                [&] { return app::geometry_text(result) + (sweep ? app::sweep_text(*sweep) : std::string()); });
  write_json_file(options.json_file, json);
  if (!options.csv_file.empty()) write_file(options.csv_file, app::functions_csv(result));
  if (!options.folder.empty()) app::write_geometry_folder(options.folder, result, sweep ? &*sweep : nullptr);
  write_report_file(options.report_file, [&] { return app::geometry_page(result, sweep ? &*sweep : nullptr); });
  return doubts.empty() ? kOk : kFailed;
}

}  // namespace

Command add_geometry(CLI::App& verb) {
  auto options = std::make_shared<GeometryOptions>();
  const auto mm = [&](const char* name, std::optional<double>& value, const char* text) {
    verb.add_option(name, value, text)->check(CLI::PositiveNumber)->type_name("MM");
  };
  verb.add_option("CASE", options->case_file, "Case file (.toml or .inp): wheel, rail and track of its first case");
  verb.add_option("--wheel", options->wheel,
                  "Profile, slices, triangles or offsets of both wheels, or of the right one; or a built-in name")
      ->type_name(kProfileName);
  verb.add_option("--wheel-left", options->wheel_left, "Of the left wheel, given as for the right side")
      ->type_name(kProfileName);
  verb.add_option("--rail", options->rail, "Of both rails, or of the right one")->type_name(kProfileName);
  verb.add_option("--rail-left", options->rail_left, "Of the left rail, given as for the right side")
      ->type_name(kProfileName);
  verb.add_option("--new-wheel", options->new_wheel,
                  "The conicity with this profile in place of both wheels' too: effect of wear")
      ->type_name(kProfileName);
  verb.add_option("--new-rail", options->new_rail, "The same with this profile in place of both rails'")
      ->type_name(kProfileName);
  mm("--diameter-mm", options->diameter_mm, "At the tape lines, 920 unless given");
  mm("--diameter-left-mm", options->diameter_left_mm, "Of the left wheel");
  mm("--gauge-mm", options->gauge_mm, "Distance of the rails' gauge points");
  mm("--gauge-height-mm", options->gauge_height_mm,
     "Depth below the rail's top down to which the gauge is measured, 14 unless given");
  mm("--rail-origins-mm", options->rail_origins_mm,
     "In place of the gauge: distance of the origins of the rails' profiles");
  mm("--wheel-origins-mm", options->wheel_origins_mm,
     "Distance of the origins of the wheels' profiles (tape lines), 1500 unless given");
  verb.add_option("--cant", options->cant,
                  "Inclination of the rails, 1:40 for example; 0 where the profile contains it")
      ->type_name("1:N");
  verb.add_option("--amplitudes-mm", options->amplitudes_mm,
                  "Of the conicity: 3, or 1,2,3, or 1:7.5:0.1 (from:to:step)")
      ->capture_default_str();
  mm("--amplitude-mm", options->amplitude_mm, "Of the single value, in place of the rule by the clearance");
  verb.add_option("--gauges-mm", options->gauges_mm, "The conicity at these gauges too: 1430:1440:1")
      ->type_name("LIST");
  verb.add_option("--roll", options->roll, "none: each side by itself, as EN 15302; free: rolls until both sides touch")
      ->check(CLI::IsMember({"none", "free"}))
      ->capture_default_str();
  verb.add_option("--axle-load-kN", options->axle_load_kN,
                  "What both wheels carry: normal forces by statics, Hertz' ellipses and pressures too")
      ->check(CLI::Range(1e-3, 1e4))
      ->type_name("KN");
  verb.add_option("--yaw-mrad", options->yaw_mrad, "Of the wheelset")
      ->check(CLI::Range(-50.0, 50.0))
      ->type_name("MRAD");
  verb.add_option("--step-mm", options->step_mm, "Of the shift")->check(CLI::Range(0.005, 2.0))->capture_default_str();
  verb.add_option("--second-mm", options->second_mm, "Gap up to which further contacts are listed; 0: none")
      ->check(CLI::Range(0.0, 5.0))
      ->capture_default_str();
  verb.add_option("--pitch-deg", options->pitch_deg, "Angle of the wheels, which need not be round")->type_name("DEG");
  verb.add_option("--position-mm", options->position_mm, "Place along rails that vary")->type_name("MM");
  verb.add_option("--scale", options->scale_to_mm, "Factor from units of profile files to mm")
      ->check(CLI::PositiveNumber);
  verb.add_option("--backend", options->backend, "Surface backend (see: treadmark list backends)")
      ->type_name(kBackendName);
  verb.add_option("--resolution", options->resolution_mm, "Spacing of the data of that backend [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--pairs", options->pairs,
                  "Many pairs: a table whose first line names its columns (name, wheel, rail, wheel_left, "
                  "rail_left, diameter_mm, gauge_mm, cant ...); the options hold where cells are empty")
      ->type_name("LIST.csv");
  verb.add_option("--json", options->json_file, "Write the results here; - for standard output instead of the text")
      ->check(is_output())
      ->type_name("FILE");
  verb.add_option("--csv", options->csv_file,
                  "Write the contact over the shift here as a table, with --pairs one row a pair")
      ->check(is_output())
      ->type_name("FILE");
  add_hdf5_file(verb, options->hdf5_file);
  verb.add_option("-o,--output", options->folder, "Folder for geometry.json, functions.csv, conicity.csv and pictures")
      ->check(is_output())
      ->type_name("FOLDER");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides);
  return command(options, geometry_command);
}

}  // namespace treadmark::cli
