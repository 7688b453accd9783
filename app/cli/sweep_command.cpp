// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/app/simulation/run_study.hpp"
#include "treadmark/app/simulation/slurm_jobs.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/io/tables/shown.hpp"

namespace treadmark::cli {
namespace {

struct SweepOptions {
  std::string file;
  std::string output_folder;
  bool resume = false, merge = false, status = false, slurm = false;
  std::string runs;  ///< "3-12"; empty: all
  std::vector<std::string> overrides, slurm_options;
  int slurm_tasks = 1000;
  std::string report_file;  ///< HTML; empty = none
};

io::RunRange range_of(const std::string& text) {
  io::RunRange range;
  if (text.empty()) return range;
  const char* const end = text.data() + text.size();
  const auto [dash, no_first] = from_chars(text.data(), end, range.first);
  const auto [rest, no_last] = from_chars(std::min(dash + 1, end), end, range.last);
  const bool read = no_first == std::errc() && dash != end && *dash == '-' && no_last == std::errc() && rest == end;
  if (!read || range.first < 1 || range.last < range.first)
    throw Error(ErrorKind::configuration, "--runs " + text + " is no range of runs", {}, "for example --runs 11-20");
  return range;
}

void print_state(const io::StudyFile& study, const SweepOptions& options) {
  const app::StudyState state = app::study_state(study, options.output_folder);
  std::cout << fmt::format("{} runs: {} finished, {} being solved, {} interrupted with a checkpoint, {} not begun\n",
                           study.runs.size(), state.finished.size(), state.solved_now.size(), state.interrupted.size(),
                           state.not_begun.size());
  std::cout << (state.written ? "sweep.csv and sweep.h5 are written\n"
                              : "sweep.csv and sweep.h5 are not written yet\n");
  if (const std::vector<std::string> jobs = app::slurm_jobs(options.output_folder); !jobs.empty())
    std::cout << fmt::format("jobs {}: squeue -j {} shows whether they wait or run\n", fmt::join(jobs, ", "),
                             fmt::join(jobs, ","));
}

/// Writes the jobs and what submits them.
int slurm_command(const io::StudyFile& study, const SweepOptions& options) {
  namespace fs = std::filesystem;
  app::StudyOptions wanted;
  wanted.folder = options.output_folder;
  wanted.workers = 0;
  app::run_study(study, wanted, {});  // takes the folder for this study, so that the tasks need not look at all runs
  app::SlurmRequest request;
  request.program = fs::read_symlink("/proc/self/exe");
  request.study = fs::absolute(options.file);
  request.folder = fs::absolute(options.output_folder);
  request.settings = options.overrides;
  request.options = options.slurm_options;
  request.tasks = options.slurm_tasks;
  if (!options.report_file.empty()) request.report = fs::absolute(options.report_file);
  const app::SlurmScripts scripts = app::write_slurm_scripts(study, request);
  std::cout << fmt::format("{} tasks and a job that gathers their runs; submit them with: sh {}\n", scripts.tasks,
                           scripts.submit.string());
  return kOk;
}

void print_table(const io::StudyResult& study) {
  std::vector<std::vector<std::string>> lines{{"run", "status"}};
  std::string said;
  for (const io::SimulationRun& run : study.runs) {
    lines.push_back({fmt::format("{:>4}  {}", run.number, run.label), run.status});
    if (!run.message.empty()) said += fmt::format("run {}: {}\n", run.number, run.message);
  }
  for (const char* name : {"q_max_N", "q_max_over_static", "ty_max_N", "pmax_Pa"}) {
    const auto shown = [&](const io::SimulationRun& run) { return io::shown_number(io::summary_value(run, name), -1); };
    if (ranges::all_of(study.runs, [&](const auto& run) { return shown(run) == "-"; })) continue;
    lines.front().emplace_back(name);
    for (std::size_t i = 0; i < study.runs.size(); ++i) lines[i + 1].push_back(shown(study.runs[i]));
  }
  print(io::table_text(lines, {1}) + said);
}

int sweep_command(const SweepOptions& options, const CommonOptions& common) {
  require_file(options.file, "study file", ErrorKind::configuration);
  if (!io::is_study_file(options.file))
    throw Error(ErrorKind::configuration, options.file + " is not a study: it has no table [study]", {},
                "treadmark simulate runs one simulation");
  require_part("hdf5", "folders of studies");
  const app::ProcessPlace place = app::process_place();
  const bool speaks = place.rank == 0 && !common.quiet;
  // Processes that were started together share the cores.
  const ThreadLimit limit(place.count > 1 && !common.threads_given ? 1 : common.threads);
  const io::RunRange share = range_of(options.runs);
  const io::StudyFile study =
      io::read_study_file(options.file, options.overrides, options.status ? io::RunRange{0, 0} : share);
  print_notes(study.notes, !speaks);
  if (options.status) {
    print_state(study, options);
    return kOk;
  }
  if (options.slurm) return slurm_command(study, options);

  app::StudyOptions wanted;
  wanted.folder = options.output_folder;
  wanted.settings = options.overrides;
  wanted.must_exist = options.resume || options.merge;
  wanted.cache = io::ContentCache::from_environment();
  wanted.share = share;
  wanted.workers = options.merge ? 0 : std::min(thread_count(), std::max(1, static_cast<int>(study.runs.size())));
  const app::StudyOutcome outcome =
      with_progress(!speaks, [&](const Progress& progress) { return app::run_study(study, wanted, progress); });
  if (speaks && outcome.found_finished > 0)
    std::cerr << fmt::format("{} of {} runs were finished already\n", outcome.found_finished, outcome.runs_total);
  const auto write_report = [&] {
    if (place.rank == 0)
      write_report_file(options.report_file, [&] { return app::pages::read_report(options.output_folder); });
  };
  if (!outcome.complete) {
    if (share.whole()) write_report();
    std::cerr << fmt::format("{}: {} of {} runs finished; {}\n", options.merge ? "nothing is gathered yet" : "stopped",
                             outcome.study.runs.size(), outcome.runs_total,
                             options.merge ? "--status says more" : "the same command goes on");
    return kFailed;
  }
  if (share.whole()) {
    app::write_study_folder(study, wanted, outcome.study);
    write_report();
  }
  if (place.rank == 0) print_table(outcome.study);
  if (speaks && share.whole()) std::cerr << "results: " << options.output_folder << '\n';
  const bool all_good =
      ranges::all_of(outcome.study.runs, [](const io::SimulationRun& run) { return run.status == "complete"; });
  return all_good ? kOk : kFailed;
}

}  // namespace

Command add_sweep(CLI::App& verb) {
  auto options = std::make_shared<SweepOptions>();
  verb.add_option("STUDY", options->file, "Study file (.toml)")->required();
  verb.add_option("-o,--output", options->output_folder, "Folder for sweep.h5, sweep.csv, figures and the runs")
      ->check(is_output(true))
      ->type_name("FOLDER")
      ->required();
  verb.add_flag("--resume", options->resume, "Go on with a study that was stopped; there must be one in the folder");
  CLI::Option* runs =
      verb.add_option("--runs", options->runs, "Solve only the runs with these numbers, and gather nothing")
          ->type_name("FIRST-LAST");
  CLI::Option* merge =
      verb.add_flag("--merge", options->merge, "Solve nothing: gather the runs, all of which must be finished")
          ->excludes(runs);
  CLI::Option* status =
      verb.add_flag("--status", options->status, "Say how many runs are finished, and the numbers of submitted jobs")
          ->excludes(runs)
          ->excludes(merge);
  CLI::Option* slurm =
      verb.add_flag("--slurm", options->slurm,
                    "Write a job array of Slurm for the runs that are not finished, a job that gathers them "
                    "behind it, and a script that submits both")
          ->excludes(runs)
          ->excludes(merge)
          ->excludes(status);
  verb.add_option("--slurm-option", options->slurm_options,
                  "Option of sbatch for these jobs, as --slurm-option=--time=60")
      ->type_name("OPTION")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->needs(slurm);
  verb.add_option("--slurm-tasks", options->slurm_tasks, "At most so many tasks of the array share the runs")
      ->check(CLI::Range(1, 100000))
      ->needs(slurm)
      ->capture_default_str();
  add_report_file(verb, options->report_file);
  add_overrides(verb, options->overrides, "simulation.distance_m=2");
  return command(options, sweep_command);
}

}  // namespace treadmark::cli
