// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <system_error>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/app/import/import_tiles.hpp"
#include "treadmark/app/import/pages/import_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/scans/read_scan.hpp"
#include "treadmark/report/pictures/imports/import_pictures.hpp"

namespace treadmark::cli {
namespace {

struct ImportOptions {
  std::vector<std::string> scans, outputs;
  std::string report_folder, json_file, settings_file;  ///< empty = none; JSON "-" = stdout
  std::string truth;                                    ///< empty = none
  std::string body, unit, nominal;                      ///< empty = as the settings say
  double nominal_radius_mm = 0.0, resolution_mm = 0.0;  ///< 0 = as the settings say
  bool list_settings = false;
  std::vector<std::string> overrides;  ///< table.key=value
};

int import_command(const ImportOptions& options, const CommonOptions& common) {
  app::ImportRequest request;
  if (!options.settings_file.empty()) io::read_import_settings(options.settings_file, request.settings);
  io::ImportSettings& settings = request.settings;
  if (!options.body.empty()) settings.scan.body = options.body;
  if (!options.unit.empty()) settings.scan.unit = options.unit;
  if (!options.nominal.empty()) settings.placement.nominal = options.nominal;
  if (options.nominal_radius_mm > 0.0) settings.placement.nominal_radius_mm = options.nominal_radius_mm;
  if (options.resolution_mm > 0.0) settings.fit.resolution_mm = options.resolution_mm;
  for (const std::string& assignment : options.overrides) io::set_import_setting(settings, assignment);
  if (options.list_settings) {
    std::cout << io::import_settings_toml(settings);
    return kOk;
  }
  request.scans.assign(options.scans.begin(), options.scans.end());
  request.outputs.assign(options.outputs.begin(), options.outputs.end());
  if (request.scans.empty()) throw Error(ErrorKind::configuration, "there is no scan to import", {}, "name its file");

  request.truth = options.truth;
  const ThreadLimit limit(common.threads);
  const auto work = [&] {
    try {
      return with_progress(
          common.quiet, [&](const Progress& progress) { return app::import_scan(request, progress); },
          Units::different);
    } catch (...) {
      std::error_code ignored;
      if (const auto kept = app::unfinished_file(request); interrupted() && std::filesystem::exists(kept, ignored))
        print_notes({fmt::format("{} holds what is finished: the same command goes on", kept.string())}, common.quiet);
      throw;
    }
  };
  const io::ImportReport report = work();
  if (!options.report_folder.empty()) {
    pictures::write_import_report(options.report_folder, report);
    for (const auto& [part, file] : {std::pair{"hdf5", "maps.h5"}, std::pair{"report", "report.html"}})
      if (!has_part(part)) print_notes({left_out_message(part, file) + ": " + left_out_advice(part)}, common.quiet);
    const auto page = [&](const io::ImportReport& one, const std::filesystem::path& folder) {
      if (has_part("report"))
        write_report_file(folder / "report.html",
                          [&] { return app::pages::import_page(one, io::import_json(one, false), folder); });
    };
    page(report, options.report_folder);
    if (report.track) page(*report.track->left, std::filesystem::path(options.report_folder) / pictures::kLeftRail);
  }
  const auto json = [&] { return io::import_json(report, true); };
  write_json_file(options.json_file, json);
  print_results(options.json_file, json, [&] { return io::import_summary(report); });
  return kOk;
}

}  // namespace

void check_import_file(const std::string& name, const std::vector<std::string>& overrides) {
  io::ImportSettings settings;
  io::read_import_settings(name, settings);
  for (const std::string& assignment : overrides) io::set_import_setting(settings, assignment);
  std::cout << name << ": settings of an import, no errors\n";
}

std::string import_schema() { return io::import_settings_schema(); }
std::string import_report_schema() { return io::import_report_schema(); }

Command add_import(CLI::App& verb) {
  auto options = std::make_shared<ImportOptions>();
  verb.add_option("SCAN", options->scans,
                  "Points (" + io::scan_extensions() +
                      "), several files = several passes; or a gridded map of deviations (.csv .asc)");
  add_output(
      verb, "-o,--output", options->outputs,
      "Surface file: .slcs .slcw (spline), .ply .stl .obj .off (mesh), .vdb .nvdb (offset); may be given several times",
      "FILE")
      ->allow_extra_args(false);
  add_output(verb, "--report", options->report_folder,
             "Folder for the audit: report.json, summary.txt, settings.toml and pictures (SVG)", "FOLDER");
  add_output(verb, "--json", options->json_file,
             "Write the audit here (JSON); - for standard output instead of the summary", "FILE");
  verb.add_option("--settings", options->settings_file, "TOML file of settings (see --list-settings)")
      ->type_name("FILE");
  verb.add_option(
          "--truth", options->truth,
          "Reference surface, or what treadmark scan --truth wrote: the audit has the error of the surface against it")
      ->type_name("FILE");
  verb.add_option("--body", options->body, "wheel or rail, where the surface file does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option("--unit", options->unit,
                  "Unit of the scan: m, mm, um, in; default: the file's word or the size of the wheel or rail")
      ->check(CLI::IsMember({"auto", "m", "mm", "um", "in"}));
  verb.add_option("--nominal", options->nominal,
                  "Nominal profile: S1002, 60E1, a profile file, none; default S1002 for wheels, 60E1 for rails")
      ->type_name(kProfileName);
  verb.add_option("--nominal-radius", options->nominal_radius_mm,
                  "Wheel radius at profile z = 0 [mm], default from the scan")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_option("--resolution", options->resolution_mm, "Distance of the surface's points [mm], default 0.5")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  verb.add_flag("--list-settings", options->list_settings, "Print all settings with their defaults as a TOML file");
  add_overrides(verb, options->overrides, "scan.unit=mm");
  return command(options, import_command);
}

}  // namespace treadmark::cli
