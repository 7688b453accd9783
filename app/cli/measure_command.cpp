// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/list_files.hpp"
#include "treadmark/app/cli/setting_options.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_claim.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct MeasureOptions {
  std::string body;
  std::vector<std::string> files;
  io::GivenSettings given;
  std::string json, csv, hdf5, report;  ///< empty = none; JSON "-" = stdout
};

int measure_command(const MeasureOptions& options, const CommonOptions& common) {
  const app::MeasureRequest request =
      app::measure_request(options.body == "wheel" ? Body::wheel : Body::rail, options.given);
  const std::vector<std::string> names = app::measured_names(options.files, request.body);
  const ListFiles outputs{options.csv, options.hdf5, options.report};
  for (const std::string& name : names) refuse_output_as_input(name);  // a file that fails is but a row without numbers
  const ThreadLimit limit(common.threads);
  // Several were asked for, even if a folder holds one only.
  const bool one = names.size() == 1 && names == options.files;
  if (!request.mate.empty() && !one) throw Error(ErrorKind::configuration, "mate is the other wheel of one wheel");
  if (one) {
    catch_interrupt();
    const CancellationScope scope(&interrupted());
    const app::MeasuredFile file = app::measure_file(names.front(), request);
    print_notes(file.notes, common.quiet);
    const auto json = [&] { return app::measure_json(file, request); };
    write_json_file(options.json, json);
    if (!outputs.csv.empty()) write_file(outputs.csv, app::list_csv(app::list_of(file, request)));
    if (!outputs.hdf5.empty()) app::write_list_store(outputs.hdf5, app::list_of(file, request));
    write_report_file(outputs.report, [&] { return app::measure_page(file, request); });
    if (outputs.csv != "-") print_results(options.json, json, [&] { return app::measure_text(file, request); });
    return file.doubtful ? kFailed : kOk;
  }
  const std::optional<app::ResultList> list =
      make_list(outputs, common, [&](const std::filesystem::path& kept, const Progress& progress) {
        return app::measure_files(names, request, kept, progress);
      });
  if (!list) return kFailed;
  const auto json = [&] { return app::measure_json(*list, request); };
  write_json_file(options.json, json);
  if (options.json == "-") std::cout << json();
  write_list(outputs, *list, options.json != "-");
  return list->failed() > 0 ? kInputData : kOk;
}

}  // namespace

Command add_measure(CLI::App& verb) {
  auto options = std::make_shared<MeasureOptions>();
  verb.add_option("BODY", options->body, "wheel or rail")->required()->check(CLI::IsMember({"wheel", "rail"}));
  verb.add_option(
          "FILE", options->files,
          "Profile, slices, triangles, offsets, scan, case file or a name of 'treadmark list profiles'; folders, and "
          "@LIST of a file a line, for many")
      ->required()
      ->type_name(kProfileName);
  add_settings(verb, app::measure_keys().infos, options->given.settings);
  add_output(verb, "--json", options->json, "Write all of it here (JSON); - for standard output instead of the table",
             "FILE");
  add_output(verb, "--csv", options->csv, "Write a row a file here (CSV); - for standard output", "FILE");
  add_hdf5_file(verb, options->hdf5);
  add_report_file(verb, options->report);
  add_overrides(verb, options->given.overrides);
  return command(options, measure_command);
}

}  // namespace treadmark::cli
