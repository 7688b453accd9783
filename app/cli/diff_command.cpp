// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <iostream>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/compare/result_difference.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/read_hdf5.hpp"

namespace treadmark::cli {
namespace {

struct DiffOptions {
  std::string a, b;         ///< folders or files
  double tolerance = 1e-3;  ///< relative
};

io::RunResult read_result(const std::string& name) {
  namespace fs = std::filesystem;
  return io::read_hdf5(fs::is_directory(name) ? fs::path(name) / "fields.h5" : fs::path(name));
}

int diff_command(const DiffOptions& options, const CommonOptions&) {
  const app::ResultDifference difference = app::compare_results(read_result(options.a), read_result(options.b));
  for (const std::string& line : difference.unmatched) std::cout << line << '\n';
  const bool known = ranges::any_of(difference.quantities, [](const auto& q) { return std::isfinite(q.sigmas); });
  std::size_t beyond = 0;
  for (const app::QuantityDifference& q : difference.quantities) {
    if (q.relative <= options.tolerance) break;
    if (beyond++ == 0)
      std::cout << fmt::format("{:<29} {:>12} {:>12} {:>8}{}  where\n", "", "first", "second", "relative",
                               known ? "  deviations" : "");
    const std::string deviations = !known                    ? ""
                                   : std::isfinite(q.sigmas) ? fmt::format("{:>12.2g}", q.sigmas)
                                                             : fmt::format("{:>12}", "");
    std::cout << fmt::format("{:<29} {:>12.6g} {:>12.6g} {:>8.1e}{}  case {}{}\n", q.key, q.a, q.b, q.relative,
                             deviations, q.case_number, q.patch == 0 ? "" : fmt::format(", patch {}", q.patch));
  }
  std::cout << fmt::format("{} of {} quantities differ by more than {:g}\n", beyond, difference.quantities.size(),
                           options.tolerance);
  return app::agree(difference, options.tolerance) ? kOk : kFailed;
}

}  // namespace

Command add_diff(CLI::App& verb) {
  auto options = std::make_shared<DiffOptions>();
  verb.add_option("FIRST", options->a, "Folder of a run, or its fields.h5")->required();
  verb.add_option("SECOND", options->b, "What it is compared with")->required();
  verb.add_option("--tolerance", options->tolerance, "Relative difference that is none")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  return command(options, diff_command);
}

}  // namespace treadmark::cli
