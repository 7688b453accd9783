// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <CLI/CLI.hpp>

#include <iostream>

#include "treadmark/app/cli/commands.hpp"
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

void add_case_options(CLI::App& verb, cli::RunOptions& options) {
  verb.add_option("CASE", options.cases, "Treadmark case (.toml) or CONTACT input file (.inp)")->required();
  verb.add_option("--set", options.overrides, "Override a key of every case, for example --set wheelset.y_mm=3")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program{"Treadmark: wheel-rail contact on any 3D surface"};
  program.set_version_flag("--version", "treadmark " + app::version() + " (" + app::git_revision() + ")\n" + app::build_description());
  program.require_subcommand(1);
  program.fallthrough();
  program.footer(
      "Exit status: 0 ok, 1 failed, 2 usage or configuration, 3 bad input data, 4 not converged (results still written).\n"
      "Results go to standard output, everything else to standard error.");

  cli::CommonOptions common;
  program.add_option("--threads", common.threads, "Number of threads, 0 = all cores")->check(CLI::Range(0, 4096));
  program.add_flag("--quiet", common.quiet, "No progress and no notes");

  cli::RunOptions options;
  CLI::App* run = program.add_subcommand("run", "Solve the contact problems of one or more case files");
  add_case_options(*run, options);
  run->add_option("-o,--output", options.output_folder, "Folder for result.json, fields.h5, ParaView files, pressure.svg")
      ->type_name("FOLDER");
  run->add_option("--json", options.json_file, "Write the result file here; - for standard output instead of the summary")
      ->type_name("FILE");
  run->add_option("--backend", options.backend, "Surface backend for wheel and rail (see: treadmark list backends)");
  run->add_option("--wheel-backend", options.wheel_backend, "Surface backend for the wheel");
  run->add_option("--rail-backend", options.rail_backend, "Surface backend for the rail");

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
