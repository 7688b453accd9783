// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <iostream>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/fmu/fmu_file.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::cli {
namespace {

struct FmuOptions {
  fmi::FmuContent content;
  std::string input, output;
  int version = 3;
};

int fmu_command(const FmuOptions& options, const CommonOptions& common) {
  const ThreadLimit limit(common.threads);
  catch_interrupt();
  const CancellationScope scope(&interrupted());
  fmi::FmuContent content = options.content;
  content.input = options.input;
  content.output = options.output;
  content.version = static_cast<fmi::Version>(options.version);
  const fmi::WrittenFmu written = fmi::write_fmu(content);
  std::cout << fmt::format("{}: {}, FMI {}.0 co-simulation, {} variables, {:.1f} MB\n", options.output, written.title,
                           options.version, written.variables, 1e-6 * static_cast<double>(written.bytes));
  return kOk;
}

}  // namespace

Command add_fmu(CLI::App& verb) {
  auto options = std::make_shared<FmuOptions>();
  verb.add_option("CASE", options->input, "A case file with a wheel on a rail, or a simulation")->required();
  verb.add_option("-o,--output", options->output, "The FMU")->check(is_output(true))->required()->type_name("FILE.fmu");
  verb.add_option("--fmi", options->version, "Version of the interface")->check(CLI::IsMember({2, 3}));
  verb.add_option("--case", options->content.number, "Number of the case, default the first of a wheel on a rail")
      ->check(CLI::PositiveNumber)
      ->type_name("N");
  verb.add_flag("--wheelset", options->content.wheelset,
                "Both wheels of the wheelset: the first case of the other side, or the same case for both");
  add_overrides(verb, options->content.overrides);
  return command(options, fmu_command);
}

}  // namespace treadmark::cli
