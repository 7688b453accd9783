// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <optional>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cases/case_derivatives.hpp"
#include "treadmark/app/cases/case_list.hpp"
#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cases/uncertainty.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/output_file.hpp"
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
  std::vector<std::string> numbers;    ///< of lists; empty: usual ones
  bool fields = false;                 ///< of patches, also of long lists
  bool verbose = false;                ///< all numbers of all cases
  bool bodies = false;                 ///< wheel and rail of every case for ParaView
  bool sensitivities = false;          ///< derivatives by numbers of the case file
  std::vector<std::string> by;         ///< which; empty: placement, motion, load and friction
};

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
        if (options.resolution_mm > 0.0 && app::is_sampled(*source)) {
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

bool is_list(const io::ListedCases& given, const RunOptions& options) {
  const bool all_shown =
      options.fields || options.verbose || options.bodies || options.sensitivities || !options.report_file.empty();
  return !all_shown && ranges::none_of(given.file.cases, app::wants_error_bars) &&
         (given.rows != nullptr || given.file.cases.size() > app::kLongList);
}

/// How surfaces were fitted.
void print_fits(const std::vector<io::SurfaceUse>& surfaces, bool quiet) {
  for (const io::SurfaceUse& use : surfaces)
    if (use.fit.points > 0) print_notes({io::summary(use)}, quiet);
}

/// Where finished rows are kept while the work goes on.
std::filesystem::path kept_rows(const std::filesystem::path& folder, const std::string& json_file) {
  if (!folder.empty()) return folder / "unfinished.rows";
  return json_file.empty() || json_file == "-" || is_stream(json_file) ? "" : json_file + ".unfinished";
}

/// Cases of which there are many: their numbers go to files row by row.
int run_list(io::ListedCases given, const std::filesystem::path& folder, const RunOptions& options,
             const CommonOptions& common) {
  const OutputClaim claim(app::result_files(folder, true));
  if (given.rows) refuse_output_as_input(given.rows->file());
  choose_backends(given.file, options);
  const std::filesystem::path kept = kept_rows(folder, options.json_file);
  const app::ListOptions wanted{options.numbers, kept, !options.json_file.empty(), settings_of(options)};
  app::SurfaceStore store;
  std::optional<app::SolvedList> list;
  app::ListSummary summary;
  std::vector<std::string> notes;
  try {
    print_notes(given.file.notes, common.quiet);
    with_progress(common.quiet,
                  [&](const Progress& progress) { list.emplace(std::move(given), store, wanted, progress); });
    print_notes(list->head().doubts, common.quiet);
    print_fits(list->head().surfaces, common.quiet);
    if (list->found() > 0)
      print_notes({fmt::format("{} of {} cases were finished before", list->found(), list->size())}, common.quiet);
    const CancellationScope scope(&interrupted());
    std::optional<OutputFile> json;
    if (!options.json_file.empty() && options.json_file != "-") json.emplace(options.json_file);
    std::function<void(std::string_view)> write;
    if (json) write = [&](std::string_view bytes) { json->write(bytes); };
    if (options.json_file == "-") write = [](std::string_view bytes) { std::cout << bytes; };
    summary = app::write_list(*list, folder, write, notes);
    if (json) json->commit();
    list->forget();
  } catch (const Cancelled&) {
    std::error_code unknown;
    std::cerr << (kept.empty() ? std::string("interrupted: nothing is kept without -o FOLDER or --json FILE\n")
                  : !std::filesystem::exists(kept, unknown)
                      ? std::string("interrupted: no case was begun\n")
                      : fmt::format("interrupted: finished cases are in {}, the same command goes on\n",
                                    kept.string()));
    return kFailed;
  }
  print_notes(notes, common.quiet);
  if (options.json_file != "-") print(app::list_summary_text(summary));
  return summary.failed ? kFailed : summary.not_converged ? kNotConverged : kOk;
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
    io::ListedCases given = [&] {
      const CancellationScope scope(&interrupted());  // a long table is checked row by row
      return io::read_listed_cases(name, options.overrides);
    }();
    if (is_list(given, options)) {
      const int list_status = run_list(std::move(given), folders.empty() ? "" : folders[k], options, common);
      if (list_status != kOk && (status == kOk || list_status == kFailed)) status = list_status;
      if (interrupted()) break;
      continue;
    }
    if (!options.numbers.empty())
      throw Error(ErrorKind::configuration, "--numbers chooses columns of lists, this has all of them", {name},
                  fmt::format("leave it out: a list has cases_file, or more than {} cases, and no error bars, "
                              "--fields, --report, --vtk, --sensitivities or --verbose",
                              app::kLongList));
    const OutputClaim claim(app::result_files(folders.empty() ? "" : folders[k], false));
    const auto rows = given.rows;
    io::CaseFile file = io::all_cases(std::move(given));
    choose_backends(file, options);
    app::check_derivative_keys(file, options.by);
    app::SurfaceStore store;
    io::RunResult result =
        with_progress(common.quiet, [&](const Progress& progress) { return app::run_cases(file, store, progress); });
    result.settings = settings_of(options);
    if (options.sensitivities && result.complete)
      with_progress(common.quiet,
                    [&](const Progress& progress) { app::add_derivatives(result, file, store, options.by, progress); });
    if (rows) result.geometry_sha256.emplace_back(rows->file().string(), rows->sha256());

    print_notes(file.notes, common.quiet);
    print_notes(result.doubts, common.quiet);
    print_fits(result.surfaces, common.quiet);
    if (result.complete && app::may_have_error_bars(file, store))
      print_notes({"the import of a surface tells how well it is known: --set case.error_bars=always gives results "
                   "their error bars, which cost dozens of solutions more"},
                  common.quiet);
    if (!folders.empty() || !options.report_file.empty()) app::add_surfaces(result, file, store);
    if (!folders.empty()) print_notes(app::write_result_folder(folders[k], result, options.bodies), common.quiet);
    write_report_file(options.report_file, [&] {
      return app::pages::run_page(std::make_shared<io::RunResult>(result), io::to_json(result));
    });
    const auto json = [&] { return io::to_json(result); };
    print_results(options.json_file, json, [&] {
      constexpr std::size_t kInFull = 3;  // cases that are printed with all numbers
      const bool known = ranges::any_of(result.cases, [](const auto& c) { return c.uncertainty.has_value(); });
      if (result.cases.size() > kInFull && !options.verbose && !options.sensitivities && !known)
        return io::summary_list(result.cases);
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
  add_output(verb, "-o,--output", options->output_folder,
             "Folder for result.json, fields.h5, ParaView files, pressure.svg; of lists for cases.csv, cases.h5",
             "FOLDER");
  add_output(verb, "--json", options->json_file,
             "Write the result file here; - for standard output instead of the summary", "FILE");
  verb.add_flag("--vtk", options->bodies, "Write wheel and rail of every case for ParaView too: FOLDER/vtk/bodies.pvd");
  add_values(verb, "--numbers", options->numbers,
             "Of lists: columns, by their names in results (pmax_MPa, patch_2.fn_N, ...)", "NAME,...");
  verb.add_flag("--fields", options->fields,
                "Of lists too: all fields and pictures, which stay in memory; so do --report, --vtk, --sensitivities "
                "and --verbose");
  CLI::Option* sensitivities =
      verb.add_flag("--sensitivities", options->sensitivities,
                    "Derivatives of the numbers of each case by placement, motion, load and friction");
  add_values(
      verb, "--by", options->by,
      "By what instead: keys of the case file (wheelset.y_mm, wheel.flats.0.depth_mm, ...), rail.shape, wheel.shape",
      "KEY,...")
      ->needs(sensitivities);
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
