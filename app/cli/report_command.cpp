// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/report/pages/read_report.hpp"
#include "treadmark/app/report/write_page.hpp"
#include "treadmark/core/output_file.hpp"

namespace treadmark::cli {
namespace {

struct ReportOptions {
  std::string folder;
  std::string output_file;       ///< empty = report.html in the folder
  bool static_pictures = false;  ///< in place of live views
};

int report_command(const ReportOptions& options, const CommonOptions& common) {
  namespace fs = std::filesystem;
  const app::report::Page page = app::report::read_report(options.folder);
  const fs::path folder =
      fs::is_directory(options.folder) ? fs::path(options.folder) : fs::path(options.folder).parent_path();
  const fs::path file = options.output_file.empty() ? folder / "report.html" : fs::path(options.output_file);
  app::report::PageOptions how;
  how.live = !options.static_pictures;
  const std::string html = app::report::to_html(page, how);
  write_file(file, html);
  if (how.live && app::report::page_script().empty() && !common.quiet)
    std::cerr << "note: this build has no Node.js: the report shows fixed pictures\n";
  std::cout << file.string() << '\n';
  return kOk;
}

}  // namespace

Command add_report(CLI::App& verb) {
  auto options = std::make_shared<ReportOptions>();
  verb.add_option("FOLDER", options->folder, "What run, compare, bench, import --report, simulate or sweep wrote")
      ->required();
  verb.add_option("-o,--output", options->output_file, "The report, default FOLDER/report.html")
      ->type_name("FILE.html");
  verb.add_flag("--static", options->static_pictures,
                "Fixed pictures in place of live views: a smaller file without scripts");
  return command(options, report_command);
}

}  // namespace treadmark::cli
