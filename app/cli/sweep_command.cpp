// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/report/pages/read_report.hpp"
#include "treadmark/app/simulation/run_study.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"

namespace treadmark::cli {
namespace {

struct SweepOptions {
  std::string file;
  std::string output_folder;
  bool resume = false;
  std::vector<std::string> overrides;
  std::string report_file;  ///< HTML; empty = none
};

void print_table(const io::StudyResult& study) {
  for (const io::SimulationRun& run : study.runs) {
    std::cout << fmt::format("{:>4}  {:<40} {:<10}", run.number, run.label, run.status);
    for (const char* name : {"q_max_N", "q_max_over_static", "ty_max_N", "pmax_Pa"}) {
      const double value = io::summary_value(run, name);
      if (value == value) std::cout << fmt::format("  {} {:.5g}", name, value);
    }
    std::cout << (run.message.empty() ? "" : "  " + run.message) << '\n';
  }
}

int sweep_command(const SweepOptions& options, const CommonOptions& common) {
  if (!io::is_study_file(options.file))
    throw Error(ErrorKind::configuration, options.file + " is not a study: it has no table [study]", {},
                "treadmark simulate runs one simulation");
  require_part("hdf5", "folders of studies");
  const app::ProcessPlace place = app::process_place();
  const bool speaks = place.rank == 0 && !common.quiet;
  // Processes that were started together share the cores.
  const ThreadLimit limit(place.count > 1 && !common.threads_given ? 1 : common.threads);
  const io::StudyFile study = io::read_study_file(options.file, options.overrides);
  print_notes(study.notes, !speaks);

  app::StudyOptions wanted;
  wanted.folder = options.output_folder;
  wanted.settings = options.overrides;
  wanted.must_exist = options.resume;
  wanted.cache = io::ContentCache::from_environment();
  wanted.workers = std::min(thread_count(), std::max(1, static_cast<int>(study.runs.size())));
  const app::StudyOutcome outcome =
      with_progress(!speaks, [&](const Progress& progress) { return app::run_study(study, wanted, progress); });
  if (speaks && outcome.found_finished > 0)
    std::cerr << fmt::format("{} of {} runs were finished already\n", outcome.found_finished, outcome.runs_total);
  const auto write_report = [&] {
    if (place.rank == 0)
      write_report_file(options.report_file, [&] { return app::report::read_report(options.output_folder); });
  };
  if (!outcome.complete) {
    write_report();
    std::cerr << fmt::format("stopped: {} of {} runs finished; the same command goes on\n", outcome.study.runs.size(),
                             outcome.runs_total);
    return kFailed;
  }
  app::write_study_folder(study, wanted, outcome.study);
  write_report();
  if (place.rank == 0) print_table(outcome.study);
  const bool all_good =
      std::ranges::all_of(outcome.study.runs, [](const io::SimulationRun& run) { return run.status == "complete"; });
  return all_good ? kOk : kFailed;
}

}  // namespace

Command add_sweep(CLI::App& verb) {
  auto options = std::make_shared<SweepOptions>();
  verb.add_option("STUDY", options->file, "Study file (.toml)")->required();
  verb.add_option("-o,--output", options->output_folder, "Folder for sweep.h5, sweep.csv, figures and the runs")
      ->type_name("FOLDER")
      ->required();
  verb.add_flag("--resume", options->resume, "Go on with a study that was stopped; there must be one in the folder");
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "simulation.distance_m=2");
  return command(options, sweep_command);
}

}  // namespace treadmark::cli
