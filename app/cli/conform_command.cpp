// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/cli/terminal.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct ConformOptions {
  std::string what;
  double resolution_mm = 0.0;
  std::vector<std::string> overrides;
};

int conform_command(const ConformOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  const CancellationScope scope(&interrupted());
  const bool is_file = options.what.find_first_of("./") != std::string::npos;
  if (is_file && options.resolution_mm > 0.0)
    throw Error(ErrorKind::configuration, "--resolution is for a backend, and this is a case file", {options.what},
                "write --set rail.resolution_mm=... or --set wheel.resolution_mm=...");
  if (!is_file && !options.overrides.empty())
    throw Error(ErrorKind::configuration,
                fmt::format("--set is for a case file, and '{}' is taken for a backend", options.what), {},
                "a case file has an extension");
  const conformance::Record record = with_progress(common.quiet, [&](const Progress& progress) {
    return is_file ? app::hold_case(app::read_registered_case(options.what, options.overrides))
                   : conformance::hold_backend(options.what, 1e-3 * options.resolution_mm, progress);
  });
  print(record.text());
  return record.kept() && !interrupted() ? kOk : kFailed;
}

}  // namespace

Command add_conform(CLI::App& verb) {
  auto options = std::make_shared<ConformOptions>();
  verb.add_option("WHAT", options->what, "A backend, with shapes of known formulas; or a case file, for its surfaces")
      ->required()
      ->type_name(kBackendName);
  verb.add_option("--resolution", options->resolution_mm, "Spacing of a backend's data [mm], default its own")
      ->check(CLI::PositiveNumber)
      ->type_name("MM");
  add_overrides(verb, options->overrides);
  return command(options, conform_command);
}

}  // namespace treadmark::cli
