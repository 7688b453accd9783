// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <iostream>

#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/cli/command_frame.hpp"
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/io/results/write_json.hpp"

namespace treadmark::cli {
namespace {

struct FileSchema {
  const char* name;
  std::string (*text)();
};
constexpr FileSchema kSchemas[] = {{"case", io::case_file_schema},
                                   {"import", import_schema},
                                   {"vehicle", vehicle_schema},
                                   {"track", track_schema},
                                   {"simulation", simulation_schema},
                                   {"study", study_schema},
                                   {"evolve", evolve_schema},
                                   {"design", design_schema},
                                   {"limits", limits_schema},
                                   // of what the program writes
                                   {"result", io::result_schema},
                                   {"compare", io::comparison_schema},
                                   {"bench", app::bench_schema},
                                   {"geometry", app::geometry_schema},
                                   {"measure", app::measure_schema},
                                   {"import-report", import_report_schema}};

}  // namespace

Command add_schema(CLI::App& verb) {
  auto what = std::make_shared<std::string>("case");
  std::vector<std::string> names;
  for (const FileSchema& schema : kSchemas) names.emplace_back(schema.name);
  verb.add_option("WHAT", *what, fmt::format("{}; without it case", fmt::join(names, ", ")))
      ->check(CLI::IsMember(names))
      ->option_text("KIND");  // all of them are no word of a line
  return [what](const CommonOptions&) -> int {
    for (const FileSchema& schema : kSchemas)
      if (*what == schema.name) std::cout << schema.text() << '\n';
    return kOk;
  };
}

}  // namespace treadmark::cli
