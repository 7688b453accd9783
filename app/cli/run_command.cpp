// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cstdio>
#include <filesystem>
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/results/write_json.hpp"

namespace treadmark::cli {
namespace {

struct RunOptions {
  std::vector<std::string> cases;
  std::string output_folder;  ///< empty = no files
  std::string json_file;      ///< "-" = stdout, empty = none
  std::string backend, wheel_backend, rail_backend;
  double resolution_mm = 0.0;          ///< of re-represented surfaces, 0 = their default
  std::vector<std::string> overrides;  ///< key=value
  std::string report_file;             ///< HTML; empty = none
  bool verbose = false;                ///< all numbers of all cases
  bool bodies = false;                 ///< wheel and rail of every case for ParaView
};

/// Whether a resolution means something to it.
bool is_sampled(const io::SurfaceSource& source) {
  return (!source.backend.empty() && backend_of(source.backend).resample) || ranges::any_of(source.parts, is_sampled);
}

void choose_backends(io::CaseFile& file, const RunOptions& options) {
  constexpr double kMetres = 1e-3;
  const std::string& wheel = options.wheel_backend.empty() ? options.backend : options.wheel_backend;
  const std::string& rail = options.rail_backend.empty() ? options.backend : options.rail_backend;
  for (io::Case& c : file.cases)
    if (auto* input = std::get_if<io::WheelRailCase>(&c.content)) {
      if (!wheel.empty()) input->wheel.backend = wheel;
      if (!rail.empty()) input->rail.backend = rail;
      bool idle = options.resolution_mm > 0.0;
      for (io::SurfaceSource* source : {&input->wheel, &input->rail})
        if (options.resolution_mm > 0.0 && is_sampled(*source)) {
          source->resolution = kMetres * options.resolution_mm;
          idle = false;
        }
      if (idle) refuse_idle_resolution({file.path.string()});
    }
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
    if (c.status == Status::failed || any_grave(c.remarks)) return kFailed;
    if (c.status == Status::not_converged && status == kOk) status = kNotConverged;
  }
  return status;
}

int run_command(const RunOptions& options, const CommonOptions& common) {
  if (options.cases.size() > 1 && !options.json_file.empty())
    throw Error(ErrorKind::configuration, "--json takes the results of one case file only", {},
                "use -o FOLDER for several");
  if (options.cases.size() > 1 && !options.report_file.empty())
    throw Error(ErrorKind::configuration, "--report shows the results of one case file only", {},
                "use -o FOLDER, then treadmark report for each");
  const std::vector<std::filesystem::path> folders = options.output_folder.empty()
                                                         ? std::vector<std::filesystem::path>{}
                                                         : app::output_folders(options.output_folder, options.cases);
  if (options.bodies && folders.empty())
    throw Error(ErrorKind::configuration, "--vtk needs a folder to write to", {}, "give it with -o FOLDER");
  const ThreadLimit limit(common.threads);
  catch_interrupt();

  int status = kOk;
  for (std::size_t k = 0; k < options.cases.size(); ++k) {
    const std::string& name = options.cases[k];
    io::CaseFile file = io::read_any_case(name, options.overrides);
    choose_backends(file, options);
    app::SurfaceStore store;
    io::RunResult result =
        with_progress(common.quiet, [&](const Progress& progress) { return app::run_cases(file, store, progress); });
    result.settings = settings_of(options);

    print_notes(file.notes, common.quiet);
    print_notes(result.doubts, common.quiet);
    if (!common.quiet)
      for (const io::SurfaceUse& use : result.surfaces)
        if (use.fit.points > 0) std::cerr << "note: " << io::summary(use) << '\n';
    if (!folders.empty() || !options.report_file.empty()) app::add_surfaces(result, file, store);
    if (!folders.empty()) print_notes(app::write_result_folder(folders[k], result, options.bodies), common.quiet);
    write_report_file(options.report_file, [&] {
      return app::pages::run_page(std::make_shared<io::RunResult>(result), io::to_json(result));
    });
    const auto json = [&] { return io::to_json(result); };
    print_results(options.json_file, json, [&] {
      constexpr std::size_t kInFull = 3;  // cases that are printed with all numbers
      if (result.cases.size() > kInFull && !options.verbose) return io::summary_list(result.cases);
      std::string text;
      for (const io::CaseResult& c : result.cases) text += io::summary(c) + '\n';
      return text;
    });
    write_json_file(options.json_file, json);

    if (!result.complete)
      std::cerr << "interrupted: " << result.cases.size() << " of " << result.cases_total << " cases finished\n";
    const int this_status = exit_status(result);
    if (this_status != kOk && (status == kOk || this_status == kFailed)) status = this_status;
    if (!result.complete) break;
  }
  return status;
}

}  // namespace

Command add_run(CLI::App& verb) {
  auto options = std::make_shared<RunOptions>();
  add_case_files(verb, options->cases, options->overrides);
  verb.add_option("-o,--output", options->output_folder,
                  "Folder for result.json, fields.h5, ParaView files, pressure.svg")
      ->check(is_output())
      ->type_name("FOLDER");
  verb.add_option("--json", options->json_file,
                  "Write the result file here; - for standard output instead of the summary")
      ->check(is_output())
      ->type_name("FILE");
  verb.add_flag("--vtk", options->bodies, "Write wheel and rail of every case for ParaView too: FOLDER/vtk/bodies.pvd");
  verb.add_flag("--verbose", options->verbose, "Print all numbers of each case, also where there are more than three");
  verb.add_option("--backend", options->backend, "Surface backend for wheel and rail (see: treadmark list backends)")
      ->type_name(kBackendName);
  verb.add_option("--wheel-backend", options->wheel_backend, "Surface backend for the wheel")->type_name(kBackendName);
  verb.add_option("--rail-backend", options->rail_backend, "Surface backend for the rail")->type_name(kBackendName);
  verb.add_option("--resolution", options->resolution_mm,
                  "Spacing of the data that surfaces in other backends are sampled at [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  add_report_file(verb, options->report_file);
  return command(options, run_command);
}

}  // namespace treadmark::cli
