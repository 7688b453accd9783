// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/read_report.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/report/pages/bench_page.hpp"
#include "treadmark/app/report/pages/compare_page.hpp"
#include "treadmark/app/report/pages/evolution_page.hpp"
#include "treadmark/app/report/pages/import_page.hpp"
#include "treadmark/app/report/pages/page_parts.hpp"
#include "treadmark/app/report/pages/run_page.hpp"
#include "treadmark/app/report/pages/simulation_page.hpp"
#include "treadmark/app/report/pages/sweep_page.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/results/read_hdf5.hpp"

namespace treadmark::app::report {
namespace {

namespace fs = std::filesystem;

std::string text_or_nothing(const fs::path& file) {
  std::error_code unknown;
  return fs::exists(file, unknown) ? io::profiles::read_text(file, "results", {}) : std::string();
}

Page run_in(const fs::path& folder) {
  return run_page(std::make_shared<io::RunResult>(io::read_hdf5(folder / "fields.h5")),
                  text_or_nothing(folder / "result.json"));
}

/// simulation.h5: of a simulation that ended, be it by Ctrl-C; unfinished.h5: what a killed one left at its last
/// checkpoint.
Page simulation_in(const fs::path& store) {
  auto result = std::make_shared<io::SimulationResult>(io::read_simulation(store));
  io::SnapshotSeries snapshots = io::read_snapshots(store);
  result->snapshots = std::move(snapshots.run);
  result->snapshot_times = std::move(snapshots.times);
  result->snapshot_scenes = std::move(snapshots.scenes);
  std::optional<AssessedRun> assessed;
  if (const fs::path file = store.parent_path() / "assessment.json"; fs::exists(file) && result->rows() > 1)
    assessed = assess_result(title_of({}, result->input_file), result, request_in(file));
  return simulation_page(result, {}, assessed ? &*assessed : nullptr);
}

}  // namespace

Page read_report(const fs::path& given) {
  std::error_code unknown;  // what cannot be looked at counts as missing
  const fs::path folder =
      fs::is_regular_file(given, unknown) ? (given.has_parent_path() ? given.parent_path() : fs::path(".")) : given;
  if (!fs::is_directory(folder, unknown))
    throw Error(ErrorKind::input_data, "there is no such folder", {given.string()},
                "give a folder that a command wrote with -o");
  const auto has = [&](const char* name) { return fs::exists(folder / name, unknown); };
  if (has("compare.json")) return compare_page(folder);
  if (has("bench.json")) return bench_page(folder);
  if (has("report.json")) return import_page(folder);
  if (has(io::kEvolutionIdentity)) return evolution_page(folder);
  if (has("study.id")) return sweep_page(read_study_folder(folder));
  for (const char* store : {"simulation.h5", "unfinished.h5"})
    if (has(store)) return simulation_in(folder / store);
  if (has("fields.h5")) return run_in(folder);
  throw Error(ErrorKind::input_data, "the folder holds no results", {folder.string()},
              "results are fields.h5 (run), compare.json, bench.json, report.json (import --report), simulation.h5 and "
              "study.id (sweep), evolution.id (evolve)");
}

}  // namespace treadmark::app::report
