// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/run_cases.hpp"

#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/case_sequence.hpp"
#include "treadmark/app/cases/run_parts.hpp"
#include "treadmark/app/cases/solve_cases.hpp"
#include "treadmark/app/cases/uncertainty.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/never_cancelled.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/solvers/wheelrail/usual_values.hpp"

namespace treadmark::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// What is to be said of results on surfaces that are there; also of what a cancelled run keeps.
void describe_results(const io::CaseFile& file, const ProfilesOfRun& profiles, SurfaceStore& store,
                      io::RunResult& run) {
  const NeverCancelled whole;
  run.doubts = profile_doubts(profiles);
  ResultNotes notes(profiles, store);
  const std::vector<const io::Case*> cases = solved_cases(file, run);
  parallel_for(cases.size(), [&](std::size_t i) { notes.add(*cases[i], *cases[i], run.cases[i]); });
}

/// The cases as a page that solves opens them: of a wheel on a rail, and not so many that nobody reads them.
std::string text_for_page(const io::CaseFile& file) {
  constexpr std::size_t kMost = 100;
  const auto on_rail = [](const io::Case& c) { return std::holds_alternative<io::WheelRailCase>(c.content); };
  if (file.cases.size() > kMost || !ranges::all_of(file.cases, on_rail)) return {};
  return io::case_file_text(file, file.path.parent_path());
}

}  // namespace

io::RunResult run_cases(const io::CaseFile& file, const Progress& progress) {
  SurfaceStore store;
  return run_cases(file, store, progress);
}

io::RunResult run_cases(const io::CaseFile& file, SurfaceStore& store, const Progress& progress) {
  const auto start = Clock::now();
  store.begin_run();
  const SampledRegions regions = sampled_regions(file);
  // Geometry first: a broken file is found before hours of work.
  std::vector<std::optional<wheelrail::Geometry>> geometries(file.cases.size());
  io::RunResult run;
  ProfilesOfRun profiles;
  try {
    const CancellationScope scope(progress.stop);
    for (std::size_t i = 0; i < file.cases.size(); ++i) {
      check_cancelled();
      if (const auto* input = std::get_if<io::WheelRailCase>(&file.cases[i].content))
        geometries[i] = geometry_of(*input, store, regions);
    }
    profiles = check_profiles_of_run(file);
    run = solve_cases(file, geometries, progress);
  } catch (const Cancelled&) {  // what is finished is whole
    run = head_of(file);
  }
  describe_results(file, profiles, store, run);
  run.toml = text_for_page(file);
  run.geometry_sha256 = store.hashes();
  run.surfaces = store.uses();
  add_uncertainty(run, file, store, progress);
  run.seconds = seconds_since(start);
  return run;
}

io::CaseFile without_error_bars(io::CaseFile file) {
  for (io::Case& c : file.cases)
    if (auto* input = std::get_if<io::WheelRailCase>(&c.content)) input->error_bars = io::ErrorBars::never;
  return file;
}

io::RunResult solve_cases(const io::CaseFile& file, const std::vector<std::optional<wheelrail::Geometry>>& geometries,
                          const Progress& progress) {
  const auto start = Clock::now();
  std::vector<std::optional<io::CaseResult>> results(file.cases.size());
  std::vector<std::exception_ptr> errors(file.cases.size());
  std::mutex progress_mutex;
  std::size_t finished = 0;
  SolverPool pool;
  const auto solve_case = [&](std::size_t i, CaseSequence& sequence) {
    const auto case_start = Clock::now();
    const io::Case& c = file.cases[i];
    io::CaseResult result;
    try {
      result = sequence.solve(c, geometries[i] ? &*geometries[i] : nullptr);
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::numerical) {
        errors[i] =
            std::make_exception_ptr(e.where().file.empty() ? Error(e.kind(), e.message(), c.where, e.advice()) : e);
        return;
      }
      result = {};
      result.status = Status::failed;
      result.message = e.what();
    }
    result.number = c.number;
    result.shown = c.shown;
    if (!c.shown) result.patches.clear();
    result.seconds = seconds_since(case_start);
    results[i] = std::move(result);
    if (progress.report) {
      const std::lock_guard lock(progress_mutex);
      progress.report(++finished, file.cases.size(), "case " + std::to_string(c.number));
    }
  };
  const auto groups = groups_in_time(file);
  try {
    const CancellationScope scope(progress.stop);
    parallel_for(groups.size(), [&](std::size_t g) {
      CaseSequence sequence(pool);
      for (const std::size_t i : groups[g]) {
        if (progress.stop_requested()) return;
        solve_case(i, sequence);
        if (errors[i]) return;
      }
    });
  } catch (const Cancelled&) {  // what is finished is whole
  }
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);

  io::RunResult run = head_of(file);
  for (auto& result : results)
    if (result) run.cases.push_back(std::move(*result));
  run.complete = run.cases.size() == file.cases.size();
  run.seconds = seconds_since(start);
  return run;
}

std::vector<CaseGeometry> check_geometry(const io::CaseFile& file) {
  std::vector<CaseGeometry> out;
  SurfaceStore store;
  const SampledRegions regions = sampled_regions(file);
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content))
      out.push_back({&c, geometry_of(*input, store, regions)});
  return out;
}

std::vector<std::string> value_doubts(const io::CaseFile& file) {
  std::vector<std::string> doubts;
  std::set<std::string> known;
  for (const io::Case& c : file.cases) {
    const auto* input = std::get_if<io::WheelRailCase>(&c.content);
    if (input == nullptr) continue;
    std::vector<Remark> remarks;
    wheelrail::judge_values(to_problem(*input, true), remarks);
    for (const Remark& remark : remarks)
      if (known.insert(remark.text).second) doubts.push_back(fmt::format("case {}: {}", c.number, remark.text));
  }
  return doubts;
}

}  // namespace treadmark::app
