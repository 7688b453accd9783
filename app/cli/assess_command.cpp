// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <iostream>
#include <optional>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/assessment/pages/assessment_page.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/number_text.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_limits.hpp"

namespace treadmark::cli {
namespace {

struct AssessOptions {
  std::vector<std::string> results;
  std::string vehicle = "passenger";
  double from = 0.0;
  std::vector<std::string> sections, spectra, laws, channels;
  std::string limits;                                    ///< file; empty: the usual ones
  std::string csv_file, json_file, folder, report_file;  ///< empty = none; "-": standard output instead of the text
};

double metres(std::string_view text, const std::string& section) {
  const std::optional<double> value = finite_number(text);
  if (!value)
    throw Error(ErrorKind::configuration, fmt::format("--section {}: '{}' is no number", section, text), {},
                "write NAME:FROM:TO or NAME:FROM:TO:KIND, places in metres");
  return *value;
}

/// "curve 1:20:80:curve"
AssessmentSection section_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text)
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  if (parts.size() != 3 && parts.size() != 4)
    throw Error(ErrorKind::configuration, fmt::format("--section {} has {} parts", text, parts.size()), {},
                "write NAME:FROM:TO or NAME:FROM:TO:KIND, places in metres");
  AssessmentSection section{parts[0], metres(parts[1], text), metres(parts[2], text), SectionKind::straight};
  if (parts.size() == 4) {
    const auto kind = ranges::find(kSectionKinds, parts[3]);
    if (kind == kSectionKinds.end())
      throw Error(ErrorKind::configuration, fmt::format("--section {}: there is no kind '{}'", text, parts[3]), {},
                  fmt::format("kinds: {}", fmt::join(kSectionKinds, ", ")));
    section.kind = static_cast<SectionKind>(kind - kSectionKinds.begin());
  }
  return section;
}

int assess_command(const AssessOptions& options, const CommonOptions&) {
  AssessmentRequest request;
  const auto kind = ranges::find(kVehicleKinds, options.vehicle);
  request.vehicle = static_cast<VehicleKind>(kind - kVehicleKinds.begin());
  request.from = options.from;
  request.spectra = options.spectra;
  request.laws = options.laws;
  if (!options.limits.empty()) request.limits = io::read_limits_file(options.limits);
  for (const std::string& section : options.sections) request.sections.push_back(section_of(section));
  const std::vector<app::AssessedRun> runs = app::assess_files(options.results, request, options.channels);
  const std::vector<std::string> channels =
      options.channels.empty() ? app::usual_channels(*runs.front().result) : options.channels;
  catch_interrupt();  // what takes time is done
  if (!options.folder.empty()) app::write_assessment_folder(options.folder, runs, channels);
  write_report_file(options.report_file, [&] { return app::pages::assessment_page(runs, channels); });
  if (!options.csv_file.empty() && options.csv_file != "-") write_file(options.csv_file, app::assessment_csv(runs));
  const auto json = [&] { return app::assessment_json(runs); };
  write_json_file(options.json_file, json);
  print_results(options.json_file, json,
                [&] { return options.csv_file == "-" ? app::assessment_csv(runs) : app::assessment_text(runs); });
  const auto good = [](const app::AssessedRun& run) {
    return ranges::any_of(run.quantities,
                          [](const measures::Assessed& a) { return a.status == measures::AssessedStatus::ok; });
  };
  return ranges::all_of(runs, good) ? kOk : kFailed;
}

}  // namespace

Command add_assess(CLI::App& verb) {
  auto options = std::make_shared<AssessOptions>();
  verb.add_option("RESULT", options->results, "Folders that treadmark simulate wrote, or their simulation.h5")
      ->required();
  verb.add_option("--vehicle", options->vehicle, "What limits are for")
      ->check(CLI::IsMember(std::vector<std::string>(kVehicleKinds.begin(), kVehicleKinds.end())))
      ->capture_default_str();
  verb.add_option("--from", options->from, "Where the assessment begins without --section [m]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str()
      ->type_name("M");
  verb.add_option("--section", options->sections,
                  "A part of the runs by distance travelled: NAME:FROM:TO or NAME:FROM:TO:KIND, in metres; KIND is "
                  "straight, curve or transition")
      ->allow_extra_args(false)
      ->type_name("SECTION");
  add_values(verb, "--spectra", options->spectra, "Channels whose spectra are wanted, as ws1_*.Q_N", "CHANNEL,...");
  add_values(verb, "--laws", options->laws, "Named laws of wear and fatigue that are asked of the wheels (list laws)",
             "LAW,...");
  verb.add_option("--limits", options->limits, "File of limits by section, radius, speed and load")->type_name("FILE");
  add_values(verb, "--channels", options->channels, "Channels that are drawn over the distance", "CHANNEL,...");
  add_output(verb, "--csv", options->csv_file, "Write the table here; - for standard output instead of the text",
             "FILE");
  add_output(verb, "--json", options->json_file, "Write all numbers here; - for standard output instead of the text",
             "FILE");
  add_output(verb, "-o,--output", options->folder,
             "Folder for assessment.csv, assessment.json, estimates.csv, spectra.csv, runs.csv and pictures (SVG)",
             "FOLDER");
  add_report_file(verb, options->report_file);
  return command(options, assess_command);
}

}  // namespace treadmark::cli
