// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <optional>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/list_files.hpp"
#include "treadmark/app/cli/setting_options.hpp"
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/geometry/pages/geometry_page.hpp"
#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct GeometryOptions {
  io::GivenSettings given;
  std::string pairs;                                                ///< a list of them; empty: one
  std::string json_file, csv_file, hdf5_file, folder, report_file;  ///< empty: none
};

int run_list(const app::GeometryRequest& usual, const GeometryOptions& options, const CommonOptions& common) {
  if (usual.axle_load || !usual.new_wheel.empty() || !usual.new_rail.empty())
    throw Error(ErrorKind::configuration,
                "--pairs makes one table of geometry: --axle-load-kN, --new-wheel and --new-rail belong to one pair");
  if (!options.json_file.empty() || !options.folder.empty() || !usual.gauges.empty() || !usual.case_file.empty())
    throw Error(ErrorKind::configuration,
                "--pairs makes one table: CASE, --json, --output and --gauges-mm belong to one pair", {},
                "write the table with --csv, --hdf5 or --report");
  const ListFiles files{options.csv_file, options.hdf5_file, options.report_file};
  const std::vector<app::GeometryRequest> requests = app::read_pair_list(options.pairs, usual);
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
  const app::GeometryRequest request = app::geometry_request(options.given);
  if (!options.pairs.empty()) return run_list(request, options, common);
  if (!options.hdf5_file.empty())
    throw Error(ErrorKind::configuration, "--hdf5 is the table of a list of --pairs", {}, "use --json or --csv");
  if (const std::string& file = request.case_file;
      !file.empty() && (app::is_profile_file(file) || app::library_body_of(file)))
    throw Error(ErrorKind::configuration, file + " is a profile, and CASE is a case file", {},
                "name profiles with --wheel and --rail");
  app::SectionStore store;
  const app::GeometryResult result = app::run_geometry(request, store);
  print_notes(result.notes, common.quiet);
  const std::vector<std::string> doubts = app::profile_doubts(result.request);
  for (const std::string& doubt : doubts) std::cerr << "warning: " << doubt << '\n';

  const auto json = [&] { return app::geometry_json(result); };
  print_results(options.json_file, json, [&] { return app::geometry_text(result); });
  write_json_file(options.json_file, json);
  if (!options.csv_file.empty()) write_file(options.csv_file, app::functions_csv(result));
  if (!options.folder.empty()) app::write_geometry_folder(options.folder, result);
  write_report_file(options.report_file, [&] { return app::geometry_page(result); });
  return doubts.empty() ? kOk : kFailed;
}

}  // namespace

Command add_geometry(CLI::App& verb) {
  auto options = std::make_shared<GeometryOptions>();
  add_settings(verb, app::geometry_keys().infos, options->given.settings);
  verb.add_option("--pairs", options->pairs,
                  "Many pairs: a table whose first line names its columns (name, wheel, rail, wheel_left, "
                  "rail_left, diameter_mm, gauge_mm, cant ...); the options hold where cells are empty")
      ->type_name("LIST.csv");
  add_output(verb, "--json", options->json_file, "Write the results here; - for standard output instead of the text",
             "FILE");
  add_output(verb, "--csv", options->csv_file,
             "Write the contact over the shift here as a table, with --pairs one row a pair", "FILE");
  add_hdf5_file(verb, options->hdf5_file);
  add_output(verb, "-o,--output", options->folder, "Folder for geometry.json, functions.csv, conicity.csv and pictures",
             "FOLDER");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->given.overrides);
  return command(options, geometry_command);
}

}  // namespace treadmark::cli
