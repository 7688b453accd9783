// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_surfaces.hpp"
#include "treadmark/app/bench/pages/bench_page.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_toml.hpp"

namespace treadmark::cli {
namespace {

struct BenchOptions {
  std::string case_file;  ///< empty = the built-in case
  std::string output_folder, json_file;
  std::vector<std::string> backends;
  std::vector<double> resolutions_mm;
  double seconds_per_measure = 0.2;
  bool markdown = false;
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

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
  if (!options.case_file.empty()) return app::read_registered_case(options.case_file, options.overrides);
  io::CaseFile file = app::bench_case();
  io::apply_overrides(file, options.overrides);
  return file;
}

int bench_command(const BenchOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads_given ? common.threads : 1);
  catch_interrupt();
  const io::CaseFile file = case_of(options);
  app::BenchReport report = with_progress(common.quiet, [&](const Progress& progress) {
    return app::bench_surfaces(file, settings_of(options), progress);
  });
  report.settings = echo(options);
  print_notes(file.notes, common.quiet);
  if (!options.output_folder.empty()) app::write_bench_folder(options.output_folder, report);
  write_report_file(options.report_file, [&] { return app::pages::bench_page(report, app::bench_json(report)); });
  const auto json = [&] { return app::bench_json(report); };
  write_json_file(options.json_file, json);
  print_results(options.json_file, json,
                [&] { return options.markdown ? app::bench_markdown(report) : app::bench_table(report); });
  if (!report.complete) std::cerr << "interrupted: " << report.rows.size() << " rows finished\n";
  return report.complete && report.agrees() ? kOk : kFailed;
}

}  // namespace

Command add_bench(CLI::App& verb) {
  auto options = std::make_shared<BenchOptions>();
  verb.add_option("CASE", options->case_file,
                  "Case file (.toml or .inp), default a wheel with a flat on a rail with a squat");
  add_values(verb, "--backends", options->backends, "Representations, default all that the shapes allow", "A,B,...");
  add_values(verb, "--resolutions", options->resolutions_mm, "Spacings of the data [mm], default 1,0.5", "MM,...");
  verb.add_option("--seconds-per-measure", options->seconds_per_measure,
                  "Each time is the median of repeats over so long [s]")
      ->type_name("S");
  add_output(verb, "-o,--output", options->output_folder, "Folder for bench.json, bench.csv and a picture (SVG)",
             "FOLDER");
  CLI::Option* bench_json = add_output(verb, "--json", options->json_file,
                                       "Write the rows here; - for standard output instead of the table", "FILE");
  verb.add_flag("--markdown", options->markdown, "Print the table in Markdown")->excludes(bench_json);
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides);
  return command(options, bench_command);
}

}  // namespace treadmark::cli
