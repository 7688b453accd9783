// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_surfaces.hpp"
#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/report_file.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/report/pages/bench_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/atomic_file.hpp"

namespace treadmark::cli {
namespace {

app::BenchSettings settings_of(const BenchOptions& options) {
  app::BenchSettings settings;
  settings.backends = options.backends;
  settings.seconds_per_measure = options.seconds_per_measure;
  if (!options.resolutions_mm.empty()) {
    settings.resolutions.clear();
    for (const double r : options.resolutions_mm) settings.resolutions.push_back(1e-3 * r);
  }
  return settings;
}

std::vector<std::string> echo(const BenchOptions& options) {
  std::vector<std::string> out = options.overrides;
  if (!options.backends.empty()) out.push_back(fmt::format("backends={}", fmt::join(options.backends, ",")));
  if (!options.resolutions_mm.empty())
    out.push_back(fmt::format("resolutions_mm={}", fmt::join(options.resolutions_mm, ",")));
  return out;
}

io::CaseFile case_of(const BenchOptions& options) {
  if (!options.case_file.empty()) return io::read_any_case(options.case_file, options.overrides);
  io::CaseFile file = app::bench_case();
  io::apply_overrides(file, options.overrides);
  return file;
}

}  // namespace

int bench_command(const BenchOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(options.threads_given ? common.threads : 1);
  catch_interrupt();
  const io::CaseFile file = case_of(options);
  app::BenchReport report;
  {
    ProgressLine line(common.quiet);
    Progress progress;
    progress.stop = &interrupted();
    progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
      line.update(finished, total, what);
    };
    report = app::bench_surfaces(file, settings_of(options), progress);
  }
  report.settings = echo(options);
  if (!common.quiet)
    for (const std::string& note : file.notes) std::cerr << "note: " << note << '\n';
  if (!options.output_folder.empty()) app::write_bench_folder(options.output_folder, report);
  write_report_file(options.report_file, [&] { return app::report::bench_page(report, app::bench_json(report)); });
  if (!options.json_file.empty() && options.json_file != "-")
    io::write_text_file(options.json_file, app::bench_json(report));
  if (options.json_file == "-")
    std::cout << app::bench_json(report);
  else
    std::cout << (options.markdown ? app::bench_markdown(report) : app::bench_table(report));
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
  if (!report.complete) std::cerr << "interrupted: " << report.rows.size() << " rows finished\n";
  return report.complete && report.agrees() ? kOk : kFailed;
}

}  // namespace treadmark::cli
