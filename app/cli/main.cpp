// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <CLI/CLI.hpp>

#include <iostream>

#include "treadmark/app/cli/commands.hpp"
#include "treadmark/app/cli/import_options.hpp"
#include "treadmark/app/cli/scan_options.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"

namespace {

using namespace treadmark;

int exit_status(const Error& error) {
  switch (error.kind()) {
    case ErrorKind::configuration:
      return cli::kUsage;
    case ErrorKind::input_data:
      return cli::kInputData;
    case ErrorKind::numerical:
      return cli::kFailed;
  }
  return cli::kFailed;
}

void add_overrides(CLI::App& verb, std::vector<std::string>& overrides) {
  verb.add_option("--set", overrides, "Override a key of every case, for example --set wheelset.y_mm=3")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_case_options(CLI::App& verb, cli::RunOptions& options) {
  verb.add_option("CASE", options.cases, "Treadmark case (.toml) or CONTACT input file (.inp)")->required();
  add_overrides(verb, options.overrides);
}

void add_report(CLI::App& verb, std::string& file) {
  verb.add_option("--report", file, "Write a report here that opens in any browser, offline")->type_name("FILE.html");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Treadmark: wheel-rail contact on any 3D surface"};
  program.set_version_flag(
      "--version", "treadmark " + app::version() + " (" + app::git_revision() + ")\n" + app::build_description());
  program.require_subcommand(1);
  program.fallthrough();
  program.footer(
      "Exit status: 0 ok, 1 failed, 2 usage or configuration, 3 bad input data, 4 not converged (results still "
      "written).\n"
      "Results go to standard output, everything else to standard error.");

  cli::CommonOptions common;
  const CLI::Option* threads =
      program.add_option("--threads", common.threads, "Number of threads, 0 = all cores")->check(CLI::Range(0, 4096));
  program.add_flag("--quiet", common.quiet, "No progress and no notes");

  cli::RunOptions options;
  CLI::App* run = program.add_subcommand("run", "Solve the contact problems of one or more case files");
  add_case_options(*run, options);
  run->add_option("-o,--output", options.output_folder,
                  "Folder for result.json, fields.h5, ParaView files, pressure.svg")
      ->type_name("FOLDER");
  run->add_option("--json", options.json_file,
                  "Write the result file here; - for standard output instead of the summary")
      ->type_name("FILE");
  run->add_option("--backend", options.backend, "Surface backend for wheel and rail (see: treadmark list backends)");
  run->add_option("--wheel-backend", options.wheel_backend, "Surface backend for the wheel");
  run->add_option("--rail-backend", options.rail_backend, "Surface backend for the rail");
  run->add_option("--resolution", options.resolution_mm,
                  "Spacing of the data that surfaces in other backends are sampled at [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");

  add_report(*run, options.report_file);

  cli::CompareOptions comparison;
  CLI::App* compare = program.add_subcommand("compare", "Solve the same cases through several surface representations");
  compare->add_option("CASE", comparison.case_file, "Treadmark case (.toml) or CONTACT input file (.inp)")->required();
  const auto list_option = [](CLI::App* verb, const char* name, auto& value, const char* text, const char* type) {
    return verb->add_option(name, value, text)->delimiter(',')->allow_extra_args(false)->type_name(type);
  };
  CLI::Option* backends = list_option(compare, "--backends", comparison.backends,
                                      "Representations, default all that the shapes allow", "A,B,...");
  list_option(compare, "--resolutions", comparison.resolutions_mm, "Spacings of the data [mm], default 1,0.5,0.25",
              "MM,...");
  CLI::Option* bodies =
      compare
          ->add_option("--bodies", comparison.bodies,
                       "Compared bodies: wheel, rail, both; auto = those that change along their length")
          ->check(CLI::IsMember({"auto", "wheel", "rail", "both"}));
  list_option(compare, "--wheel-backends", comparison.wheel_backends, "With --rail-backends: every wheel on every rail",
              "A,B,...")
      ->excludes(backends)
      ->excludes(bodies);
  list_option(compare, "--rail-backends", comparison.rail_backends, "See --wheel-backends", "A,B,...")
      ->excludes(backends)
      ->excludes(bodies);
  compare
      ->add_option("-o,--output", comparison.output_folder,
                   "Folder for compare.json, compare.csv, table.txt and pictures (SVG)")
      ->type_name("FOLDER");
  compare->add_option("--json", comparison.json_file, "Write the rows here; - for standard output instead of the table")
      ->type_name("FILE");
  add_report(*compare, comparison.report_file);
  add_overrides(*compare, comparison.overrides);

  cli::BenchOptions measured;
  CLI::App* bench =
      program.add_subcommand("bench", "Cost of heights and contact search in every backend, agreement checked first");
  bench->add_option("CASE", measured.case_file,
                    "Case file (.toml or .inp), default a wheel with a flat on a rail with a squat");
  list_option(bench, "--backends", measured.backends, "Representations, default all that the shapes allow", "A,B,...");
  list_option(bench, "--resolutions", measured.resolutions_mm, "Spacings of the data [mm], default 1,0.5", "MM,...");
  bench
      ->add_option("--seconds-per-measure", measured.seconds_per_measure,
                   "Each time is the median of repeats over so long [s]")
      ->type_name("S");
  bench->add_option("-o,--output", measured.output_folder, "Folder for bench.json, bench.csv and a picture (SVG)")
      ->type_name("FOLDER");
  CLI::Option* bench_json =
      bench->add_option("--json", measured.json_file, "Write the rows here; - for standard output instead of the table")
          ->type_name("FILE");
  bench->add_flag("--markdown", measured.markdown, "Print the table in Markdown")->excludes(bench_json);
  add_report(*bench, measured.report_file);
  add_overrides(*bench, measured.overrides);

  cli::ConvertOptions conversion;
  CLI::App* convert = program.add_subcommand("convert", "Write a wheel or rail as triangles, slices or offsets");
  convert
      ->add_option("IN", conversion.input,
                   "Profile, slices, triangles (.ply .stl .obj .off), offsets (.vdb), or a case file")
      ->required();
  convert->add_option("OUT", conversion.output, ".ply .stl .obj .off, .slcs .slcw, or .vdb")->required();
  convert->add_option("--body", conversion.body, "wheel or rail, where the input does not tell")
      ->check(CLI::IsMember({"wheel", "rail"}));
  convert->add_option("--resolution", conversion.resolution_mm, "Spacing of the samples [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  convert->add_option("--nominal-radius", conversion.nominal_radius_mm, "Wheel radius at profile z = 0 [mm]")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  convert->add_option("--scale", conversion.scale_to_mm, "Factor from units of the file to mm (1000 for a file in m)")
      ->check(CLI::PositiveNumber);
  convert->add_option("--range-mm", conversion.range_mm, "Part of a rail: from, to along the track")
      ->delimiter(',')
      ->expected(2);
  convert->add_option("--range-deg", conversion.range_deg, "Part of a wheel: from, to round it")
      ->delimiter(',')
      ->expected(2);
  add_overrides(*convert, conversion.overrides);

  cli::ImportOptions imported;
  CLI::App* import =
      program.add_subcommand("import", "From a raw scan to a surface: units, placement, cleaning, fit, with an audit");
  cli::add_import_options(*import, imported);
  add_overrides(*import, imported.overrides);

  cli::ScanOptions scanned;
  CLI::App* scan = program.add_subcommand(
      "scan", "Scan a wheel or rail virtually: points with the faults of a laser scanner, and the truth about them");
  cli::add_scan_options(*scan, scanned);
  add_overrides(*scan, scanned.overrides);

  cli::SimulateOptions simulated;
  CLI::App* simulate = program.add_subcommand("simulate", "A vehicle on its track in time, with contact at its wheels");
  simulate->add_option("FILE", simulated.file, "Simulation file (.toml)")->required();
  simulate
      ->add_option("-o,--output", simulated.output_folder,
                   "Folder for simulation.h5, history.csv, events.csv, modes.csv and pictures (SVG)")
      ->type_name("FOLDER");
  simulate
      ->add_option("--json", simulated.json_file, "Write the summary here; - for standard output instead of the table")
      ->type_name("FILE");
  std::string simulated_backend;
  simulate->add_option("--backend", simulated_backend, "Surface backend for wheel and rail");
  simulate->add_option("--wheel-backend", simulated.wheel_backend, "Surface backend for the wheel");
  simulate->add_option("--rail-backend", simulated.rail_backend, "Surface backend for the rail");
  simulate->add_flag("--resume", simulated.resume, "Go on with an interrupted simulation in the output folder");
  simulate->add_flag("--modes", simulated.modes_only,
                     "Print eigenfrequencies and modes in static equilibrium, and stop");
  add_report(*simulate, simulated.report_file);
  add_overrides(*simulate, simulated.overrides);

  cli::SweepOptions swept;
  CLI::App* sweep = program.add_subcommand(
      "sweep", "Runs of a simulation or case with varied keys, on all cores; goes on where it was stopped");
  sweep->add_option("STUDY", swept.file, "Study file (.toml)")->required();
  sweep->add_option("-o,--output", swept.output_folder, "Folder for sweep.h5, sweep.csv, figures and the runs")
      ->type_name("FOLDER")
      ->required();
  sweep->add_flag("--resume", swept.resume, "Go on with a study that was stopped; there must be one in the folder");
  add_report(*sweep, swept.report_file);
  add_overrides(*sweep, swept.overrides);

  cli::ReportOptions reported;
  CLI::App* report =
      program.add_subcommand("report", "One HTML file of a result folder, to be opened in any browser, offline");
  report->add_option("FOLDER", reported.folder, "What run, compare, bench, import --report, simulate or sweep wrote")
      ->required();
  report->add_option("-o,--output", reported.output_file, "The report, default FOLDER/report.html")
      ->type_name("FILE.html");
  report->add_flag("--static", reported.static_pictures,
                   "Fixed pictures in place of live views: a smaller file without scripts");

  cli::PlotOptions plotted;
  CLI::App* plot = program.add_subcommand("plot", "One picture (SVG) of a result folder");
  plot->add_option("FOLDER", plotted.folder, "What run, compare, bench, import --report, simulate or sweep wrote")
      ->required();
  plot->add_option("--what", plotted.what,
                   "pressure, traction, slip, gap, forces, section ...; without it: a list of what can be drawn");
  plot->add_option("-o,--output", plotted.output_file, "The picture; - for standard output")->type_name("FILE.svg");
  plot->add_option("--case", plotted.cases, "Numbers of the cases that are drawn, default all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("N,...");

  CLI::App* check = program.add_subcommand("check", "Read and validate case files and their geometry without solving");
  add_case_options(*check, options);

  std::string what;
  CLI::App* list = program.add_subcommand("list", "List what this build offers");
  list->add_option("WHAT", what, "backends, profiles, solvers or verbs")->required();
  CLI::App* schema = program.add_subcommand("schema", "Print the JSON schema of Treadmark's case files");

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return program.exit(e) == 0 ? cli::kOk : cli::kUsage;
  }

  try {
    if (run->parsed()) return cli::run_command(options, common);
    if (compare->parsed()) return cli::compare_command(comparison, common);
    measured.threads_given = threads->count() > 0;
    if (bench->parsed()) return cli::bench_command(measured, common);
    if (convert->parsed()) return cli::convert_command(conversion, common);
    if (import->parsed()) return cli::import_command(imported, common);
    if (scan->parsed()) return cli::scan_command(scanned, common);
    if (simulate->parsed()) {
      if (simulated.wheel_backend.empty()) simulated.wheel_backend = simulated_backend;
      if (simulated.rail_backend.empty()) simulated.rail_backend = simulated_backend;
      return cli::simulate_command(simulated, common);
    }
    swept.threads_given = threads->count() > 0;
    if (sweep->parsed()) return cli::sweep_command(swept, common);
    if (report->parsed()) return cli::report_command(reported, common);
    if (plot->parsed()) return cli::plot_command(plotted, common);
    if (check->parsed()) return cli::check_command(options);
    if (list->parsed()) return cli::list_command(what);
    if (schema->parsed()) return cli::schema_command();
    return cli::kUsage;
  } catch (const Error& e) {
    std::cerr << "treadmark: " << e.what() << '\n';
    return exit_status(e);
  } catch (const std::bad_alloc&) {
    std::cerr << "treadmark: not enough memory for this problem (use larger element sizes or fewer threads)\n";
    return cli::kFailed;
  } catch (const std::exception& e) {
    std::cerr << "treadmark: unexpected failure: " << e.what() << '\n';
    return cli::kFailed;
  }
}
