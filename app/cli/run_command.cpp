// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cstdio>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/output_files.hpp"
#include "treadmark/app/cli/report_file.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/report/pages/run_page.hpp"
#include "treadmark/app/run_cases.hpp"
#include "treadmark/app/sampled_surfaces.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::cli {
namespace {

void choose_backends(io::CaseFile& file, const RunOptions& options) {
  constexpr double kMetres = 1e-3;
  const std::string& wheel = options.wheel_backend.empty() ? options.backend : options.wheel_backend;
  const std::string& rail = options.rail_backend.empty() ? options.backend : options.rail_backend;
  for (io::Case& c : file.cases)
    if (auto* input = std::get_if<io::WheelRailCase>(&c.content)) {
      if (!wheel.empty()) input->wheel.backend = wheel;
      if (!rail.empty()) input->rail.backend = rail;
      if (options.resolution_mm > 0.0)
        input->wheel.resolution = input->rail.resolution = kMetres * options.resolution_mm;
    }
}

void refuse_other_files(const std::string& name) {
  if (io::is_study_file(name)) throw Error(ErrorKind::configuration, name + " is a study", {}, "use treadmark sweep");
  if (io::is_simulation_file(name))
    throw Error(ErrorKind::configuration, name + " is a simulation", {}, "use treadmark simulate");
}

std::vector<std::string> settings_of(const RunOptions& options) {
  std::vector<std::string> settings = options.overrides;
  if (!options.backend.empty()) settings.push_back("backend=" + options.backend);
  if (!options.wheel_backend.empty()) settings.push_back("wheel.backend=" + options.wheel_backend);
  if (!options.rail_backend.empty()) settings.push_back("rail.backend=" + options.rail_backend);
  if (options.resolution_mm > 0.0) settings.push_back(fmt::format("resolution_mm={}", options.resolution_mm));
  return settings;
}

int exit_status(const io::RunResult& result) {
  int status = result.complete ? kOk : kFailed;
  for (const io::CaseResult& c : result.cases) {
    if (c.status == Status::failed) return kFailed;
    if (c.status == Status::not_converged && status == kOk) status = kNotConverged;
  }
  return status;
}

}  // namespace

int run_command(const RunOptions& options, const CommonOptions& common) {
  if (options.cases.size() > 1 && !options.json_file.empty())
    throw Error(ErrorKind::configuration, "--json takes the results of one case file only", {},
                "use -o FOLDER for several");
  if (options.cases.size() > 1 && !options.report_file.empty())
    throw Error(ErrorKind::configuration, "--report shows the results of one case file only", {},
                "use -o FOLDER, then treadmark report for each");
  const ThreadLimit limit(common.threads);
  catch_interrupt();

  int status = kOk;
  for (const std::string& name : options.cases) {
    refuse_other_files(name);
    io::CaseFile file = io::read_any_case(name, options.overrides);
    choose_backends(file, options);
    io::RunResult result;
    app::SurfaceStore store;
    {
      ProgressLine line(common.quiet);
      Progress progress;
      progress.stop = &interrupted();
      progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
        line.update(finished, total, what);
      };
      result = app::run_cases(file, store, progress);
    }
    result.settings = settings_of(options);

    if (!common.quiet)
      for (const std::string& note : file.notes) std::cerr << "note: " << note << '\n';
    if (!common.quiet)
      for (const io::SurfaceUse& use : result.surfaces)
        if (use.fit.points > 0) std::cerr << "note: " << io::summary(use) << '\n';
    if (!options.output_folder.empty() || !options.report_file.empty()) app::add_surfaces(result, file, store);
    if (!options.output_folder.empty()) {
      std::filesystem::path folder = options.output_folder;
      if (options.cases.size() > 1) folder /= std::filesystem::path(name).stem();
      write_result_folder(folder, result);
    }
    write_report_file(options.report_file, [&] {
      return app::report::run_page(std::make_shared<io::RunResult>(result), io::to_json(result));
    });
    if (options.json_file == "-")
      std::cout << io::to_json(result);
    else
      for (const io::CaseResult& c : result.cases) std::cout << io::summary(c) << '\n';
    if (!options.json_file.empty() && options.json_file != "-") io::write_json(options.json_file, result);

    if (!result.complete)
      std::cerr << "interrupted: " << result.cases.size() << " of " << result.cases_total << " cases finished\n";
    const int this_status = exit_status(result);
    if (this_status != kOk && (status == kOk || this_status == kFailed)) status = this_status;
    if (!result.complete) break;
  }
  std::cout.flush();
  if (!std::cout) throw Error(ErrorKind::numerical, "the results could not be written to standard output");
  return status;
}

}  // namespace treadmark::cli
