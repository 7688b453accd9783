// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/list_files.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct MeasureOptions {
  std::string body;
  std::vector<std::string> files;
  std::string nominal, limits, json, csv, hdf5, report, alignment, mate;  ///< empty = none; JSON "-" = stdout
  double nominal_radius_mm = 0.0, scale = 1.0, line_mm = 0.0, line_step_mm = 1.0;
  int stations = 36;
  bool as_in_file = false;
  std::vector<std::string> overrides;
};

app::MeasureRequest measure_request(const MeasureOptions& options) {
  app::MeasureRequest request;
  request.body = options.body == "wheel" ? Body::wheel : Body::rail;
  request.nominal = options.nominal;
  request.nominal_radius = 1e-3 * options.nominal_radius_mm;
  request.scale_to_mm = options.scale;
  request.from_flange_back = !options.as_in_file;
  request.line = 1e-3 * options.line_mm;
  request.line_step = 1e-3 * options.line_step_mm;
  request.stations = options.stations;
  request.mate = options.mate;
  request.overrides = options.overrides;
  for (const measures::RailAlignment a :
       {measures::RailAlignment::unworn, measures::RailAlignment::top, measures::RailAlignment::none})
    if (options.alignment == measures::name_of(a)) request.alignment = a;
  if (request.alignment && request.body == Body::wheel)
    throw Error(ErrorKind::configuration, "--alignment belongs to rails", {}, "wheels count from the flange back");
  if (options.as_in_file && request.body == Body::rail)
    throw Error(ErrorKind::configuration, "--as-in-file belongs to wheels", {}, "say --alignment none");
  if (!options.limits.empty()) request.limits = app::read_limits(options.limits);
  return request;
}

int measure_command(const MeasureOptions& options, const CommonOptions& common) {
  const app::MeasureRequest request = measure_request(options);
  const std::vector<std::string> names = app::measured_names(options.files, request.body);
  const ListFiles outputs{options.csv, options.hdf5, options.report};
  for (const std::string& name : names) refuse_output_as_input(name);  // a file that fails is but a row without numbers
  const ThreadLimit limit(common.threads);
  // Several were asked for, even if a folder holds one only.
  const bool one = names.size() == 1 && names == options.files;
  if (!options.mate.empty() && (!one || request.body == Body::rail))
    throw Error(ErrorKind::configuration, "--mate is the other wheel of one wheel");
  if (one) {
    catch_interrupt();
    const CancellationScope scope(&interrupted());
    const app::MeasuredFile file = app::measure_file(names.front(), request);
    print_notes(file.notes, common.quiet);
    const auto json = [&] { return app::measure_json(file, request); };
    write_json_file(options.json, json);
    if (!outputs.csv.empty()) write_file(outputs.csv, app::list_csv(app::list_of(file, request)));
    if (!outputs.hdf5.empty()) app::write_list_store(outputs.hdf5, app::list_of(file, request));
    write_report_file(outputs.report, [&] { return app::measure_page(file, request); });
    if (outputs.csv != "-") print_results(options.json, json, [&] { return app::measure_text(file, request); });
    return file.doubtful ? kFailed : kOk;
  }
  const std::optional<app::ResultList> list =
      make_list(outputs, common, [&](const std::filesystem::path& kept, const Progress& progress) {
        return app::measure_files(names, request, kept, progress);
      });
  if (!list) return kFailed;
  const auto json = [&] { return app::measure_json(*list, request); };
  write_json_file(options.json, json);
  if (options.json == "-") std::cout << json();
  write_list(outputs, *list, options.json != "-");
  return list->failed() > 0 ? kInputData : kOk;
}

}  // namespace

Command add_measure(CLI::App& verb) {
  auto options = std::make_shared<MeasureOptions>();
  verb.add_option("BODY", options->body, "wheel or rail")->required()->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option(
          "FILE", options->files,
          "Profile, slices, triangles, offsets, scan, case file or a name of 'treadmark list profiles'; folders, and "
          "@LIST of a file a line, for many")
      ->required()
      ->type_name(kProfileName);
  verb.add_option("--nominal", options->nominal,
                  "Profile that wear is counted against: a name of 'treadmark list profiles' or a file")
      ->type_name(kProfileName);
  verb.add_option("--limits", options->limits, "TOML file of limits: tables [wheel], [rail] and [roughness]")
      ->type_name("FILE");
  verb.add_option("--json", options->json, "Write all of it here (JSON); - for standard output instead of the table")
      ->check(is_output())
      ->type_name("FILE");
  verb.add_option("--csv", options->csv, "Write a row a file here (CSV); - for standard output")
      ->check(is_output())
      ->type_name("FILE");
  add_hdf5_file(verb, options->hdf5);
  add_report_file(verb, options->report);
  verb.add_option("--nominal-radius", options->nominal_radius_mm, "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--alignment", options->alignment,
                  "Of a rail upon its nominal section: unworn (field side, underside, web, foot), top, none; default "
                  "unworn for profiles, none for surfaces and scans")
      ->check(CLI::IsMember({"unworn", "top", "none"}));
  verb.add_option("--mate", options->mate, "Profile of the other wheel of the axle, in the same axes: back to back")
      ->type_name("FILE");
  verb.add_flag("--as-in-file", options->as_in_file,
                "y = 0 of a wheel's file is the tape line, wherever the flange back is");
  verb.add_option("--scale", options->scale, "From the numbers of profile and triangle files to mm")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  verb.add_option("--stations", options->stations, "Sections along a rail or round a wheel")
      ->capture_default_str()
      ->check(CLI::Range(1, 100000));
  verb.add_option("--line", options->line_mm, "y of the line along a rail whose roughness is told [mm]")
      ->capture_default_str()
      ->type_name("MM");
  verb.add_option("--line-step", options->line_step_mm, "Distance of its samples [mm]")
      ->capture_default_str()
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  add_overrides(verb, options->overrides);
  return command(options, measure_command);
}

}  // namespace treadmark::cli
