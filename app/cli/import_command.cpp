// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/report_file.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/app/report/pages/import_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/results/atomic_file.hpp"

namespace treadmark::cli {

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

  const ThreadLimit limit(common.threads);
  catch_interrupt();
  io::ImportReport report;
  {
    ProgressLine line(common.quiet);
    Progress progress;
    progress.stop = &interrupted();
    progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
      line.update(finished, total, what);
    };
    report = app::import_scan(request, progress);
  }
  if (!options.report_folder.empty()) {
    io::write_import_report(options.report_folder, report);
    write_report_file(std::filesystem::path(options.report_folder) / "report.html", [&] {
      return app::report::import_page(report, io::import_json(report, false), options.report_folder);
    });
  }
  if (options.json_file == "-") {
    std::cout << io::import_json(report, true);
  } else {
    if (!options.json_file.empty()) io::write_text_file(options.json_file, io::import_json(report, true));
    std::cout << io::import_summary(report);
  }
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
  return kOk;
}

}  // namespace treadmark::cli
