// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/report/plot.hpp"

namespace treadmark::cli {
namespace {

struct PlotOptions {
  std::string folder, output_file;  ///< "-" = stdout
  std::string what;                 ///< empty: list what can be drawn
  std::vector<int> cases;           ///< numbers; empty = all
};

int plot_command(const PlotOptions& options, const CommonOptions&) {
  const report::Page page = app::pages::read_report(options.folder);
  if (options.what.empty()) {
    for (const auto& [name, meaning] : report::plots_of(page)) std::cout << fmt::format("{:<32} {}\n", name, meaning);
    return kOk;
  }
  if (options.output_file.empty())
    throw Error(ErrorKind::configuration, "there is no place for the picture", {},
                "name a file with -o FILE.svg, or - for standard output");
  if (options.output_file != "-" && std::filesystem::path(options.output_file).extension() != ".svg")
    throw Error(ErrorKind::configuration, "pictures are written as SVG only", {options.output_file, 0, 0},
                "end the name with .svg; a report saves single views as PNG");
  const std::string svg = report::plot(page, options.what, options.cases);
  if (options.output_file == "-") {
    std::cout << svg;
  } else {
    catch_interrupt();
    write_file(options.output_file, svg);
  }
  return kOk;
}

}  // namespace

Command add_plot(CLI::App& verb) {
  auto options = std::make_shared<PlotOptions>();
  verb.add_option("FOLDER", options->folder, "What run, compare, bench, import --report, simulate or sweep wrote")
      ->required();
  verb.add_option("--what", options->what,
                  "pressure, traction, slip, gap, forces, section ...; without it: a list of what can be drawn");
  add_output(verb, "-o,--output", options->output_file, "The picture; - for standard output", "FILE.svg");
  verb.add_option("--case", options->cases, "Numbers of the cases that are drawn, default all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("N,...");
  return command(options, plot_command);
}

}  // namespace treadmark::cli
