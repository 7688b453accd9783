// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/page_file.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::cli {
namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string output_file;       ///< empty = report.html in the folder, of several overlay.html in the first
  bool static_pictures = false;  ///< in place of live views
};

int report_command(const ReportOptions& options, const CommonOptions& common) {
  namespace fs = std::filesystem;
  const fs::path first = options.folders.front();
  const bool several = options.folders.size() > 1;
  const report::Page page = several ? app::pages::read_overlay({options.folders.begin(), options.folders.end()})
                                    : app::pages::read_report(first);
  const fs::path folder = fs::is_directory(first) ? first : first.parent_path();
  const fs::path file =
      options.output_file.empty() ? folder / (several ? "overlay.html" : "report.html") : fs::path(options.output_file);
  report::PageOptions how;
  how.live = !options.static_pictures;
  const std::string html = report::to_html(page, how);
  catch_interrupt();
  write_page(file, html);
  if (how.live && report::page_script().empty() && !common.quiet)
    std::cerr << "note: this build has no Node.js: the report shows fixed pictures\n";
  std::cout << file.string() << '\n';
  return kOk;
}

}  // namespace

Command add_report(CLI::App& verb) {
  auto options = std::make_shared<ReportOptions>();
  verb.add_option(
          "FOLDER", options->folders,
          "What run, compare, bench, import --report, simulate, sweep, evolve, design, geometry, track, stability, "
          "response or assess wrote. "
          "Two to four folders of "
          "run, or of simulate, are overlaid and compared with the first")
      ->required();
  verb.add_option("-o,--output", options->output_file,
                  "The report, default FOLDER/report.html, of several overlay.html in the first")
      ->check(is_output(true))
      ->type_name("FILE.html")
      ->each([](const std::string& name) { check_page_name(name); });
  verb.add_flag("--static", options->static_pictures,
                "Fixed pictures in place of live views: a smaller file without scripts");
  return command(options, report_command);
}

}  // namespace treadmark::cli
