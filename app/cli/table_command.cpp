// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/setting_options.hpp"
#include "treadmark/app/table/force_tables.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct TableOptions {
  std::string file;
  io::GivenSettings given;
  std::string output, json_file;  ///< empty: none
};

app::MadeTable table_of(const TableOptions& options, const CommonOptions& common) {
  if (app::is_table_file(options.file)) {
    if (!options.given.settings.empty() || !options.given.overrides.empty())
      throw Error(ErrorKind::configuration, options.file + " is a table already, which settings do not change", {},
                  "make another one of its case");
    return app::read_table(options.file);
  }
  const app::TableRequest request = app::table_request(options.given);
  const auto cache = io::ContentCache::from_environment();
  return with_progress(common.quiet, [&](const Progress& progress) {
    const CancellationScope scope(progress.stop);
    return app::make_table(options.file, request, cache ? &*cache : nullptr, progress);
  });
}

int table_command(const TableOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  if (!options.output.empty()) app::check_table_output(options.output);  // before anything takes long
  const app::MadeTable made = table_of(options, common);
  if (!options.output.empty()) app::write_table(options.output, made);
  const auto json = [&] { return app::table_json(made); };
  write_json_file(options.json_file, json);
  print_results(options.json_file, json, [&] { return app::table_text(made); });
  return kOk;
}

}  // namespace

Command add_table(CLI::App& verb) {
  auto options = std::make_shared<TableOptions>();
  verb.add_option("FILE", options->file,
                  "Case file (.toml or .inp) of a round wheel on a prismatic rail, or a table (.h5 or .json)")
      ->required();
  add_settings(verb, app::table_keys().infos, options->given.settings);
  add_output(verb, "-o,--output", options->output,
             "Write the table here: .h5 or .json with all of it, or .csv with its nodes", "FILE");
  add_output(verb, "--json", options->json_file,
             "Write what it covers and its errors here; - for standard output instead of the text", "FILE");
  add_overrides(verb, options->given.overrides);
  return command(options, table_command);
}

}  // namespace treadmark::cli
