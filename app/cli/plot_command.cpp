// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/report/pages/read_report.hpp"
#include "treadmark/app/report/plot.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"

namespace treadmark::cli {

int plot_command(const PlotOptions& options, const CommonOptions&) {
  const app::report::Page page = app::report::read_report(options.folder);
  if (options.what.empty()) {
    for (const auto& [name, meaning] : app::report::plots_of(page))
      std::cout << fmt::format("{:<22} {}\n", name, meaning);
    return kOk;
  }
  if (options.output_file.empty())
    throw Error(ErrorKind::configuration, "there is no place for the picture", {},
                "name a file with -o FILE.svg, or - for standard output");
  const std::string svg = app::report::plot(page, options.what, options.cases);
  if (options.output_file == "-")
    std::cout << svg;
  else
    io::write_text_file(options.output_file, svg);
  return kOk;
}

}  // namespace treadmark::cli
