// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/run_cases.hpp"

#include <chrono>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "treadmark/app/basic_case.hpp"
#include "treadmark/app/derived_results.hpp"
#include "treadmark/app/sampled_region.hpp"
#include "treadmark/app/surface_store.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/app/wheelrail_case.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

wheelrail::Geometry geometry_of(const io::WheelRailCase& input, SurfaceStore& store, const SampledRegions& regions) {
  const StoredSurface& rail = store.get(input.rail, Body::rail, input.wheelset.nominal_radius, regions.rail);
  const StoredSurface& wheel = store.get(input.wheel, Body::wheel, input.wheelset.nominal_radius, regions.wheel);
  return {rail.represented.surface, wheel.represented.surface, rail.constant_profile(), wheel.constant_profile()};
}

// Solvers keep influence coefficients: hand finished ones to the next case with the same bodies.
class SolverPool {
 public:
  struct Lease {
    wheelrail::Geometry geometry;
    std::unique_ptr<wheelrail::Pair> pair;
  };

  Lease take(const wheelrail::Geometry& geometry) {
    const std::lock_guard lock(mutex_);
    auto& idle = idle_[{geometry.rail.get(), geometry.wheel.get()}];
    if (idle.empty()) return {geometry, std::make_unique<wheelrail::Pair>(geometry)};
    Lease lease{geometry, std::move(idle.back())};
    idle.pop_back();
    return lease;
  }

  void give_back(Lease lease) {
    const std::lock_guard lock(mutex_);
    idle_[{lease.geometry.rail.get(), lease.geometry.wheel.get()}].push_back(std::move(lease.pair));
  }

 private:
  std::mutex mutex_;
  std::map<std::pair<const Surface*, const Surface*>, std::vector<std::unique_ptr<wheelrail::Pair>>> idle_;
};

/// Indices of cases that are solved one after the other. Those of different groups do not depend on each other.
std::vector<std::vector<std::size_t>> groups_in_time(const io::CaseFile& file) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<int, std::size_t> open;   // group of the last basic case, by sequence
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
    const auto* basic = std::get_if<io::BasicCase>(&file.cases[i].content);
    if (basic != nullptr) {
      const auto before = open.find(file.cases[i].sequence);
      if (before != open.end() && !starts_anew(*basic)) {
        groups[before->second].push_back(i);
        continue;
      }
      open[file.cases[i].sequence] = groups.size();
    }
    groups.push_back({i});
  }
  return groups;
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
  for (std::size_t i = 0; i < file.cases.size(); ++i)
    if (const auto* input = std::get_if<io::WheelRailCase>(&file.cases[i].content))
      geometries[i] = geometry_of(*input, store, regions);

  std::vector<std::optional<io::CaseResult>> results(file.cases.size());
  std::vector<std::exception_ptr> errors(file.cases.size());
  std::mutex progress_mutex;
  std::size_t finished = 0;
  SolverPool pool;
  const auto solve_case = [&](std::size_t i, BasicSequence& sequence, bool broken) {
    const auto case_start = Clock::now();
    const io::Case& c = file.cases[i];
    io::CaseResult result;
    try {
      if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) {
        SolverPool::Lease lease = pool.take(*geometries[i]);
        result = to_result(*input, lease.pair->solve(to_problem(*input, geometries[i]->constant_profiles())));
        pool.give_back(std::move(lease));
      } else {
        if (broken) throw Error(ErrorKind::numerical, "the case before it in its sequence failed, so that there is no previous instant");
        const auto& basic = std::get<io::BasicCase>(c.content);
        result = sequence.solve(basic);
        for (io::PatchResult& patch : result.patches) {
          if (c.element_table > 0) patch.element_table = mat_head(basic, c.number);
          patch.all_elements = c.element_table > 1;
        }
      }
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::numerical) {
        errors[i] = std::make_exception_ptr(e.where().file.empty() ? Error(e.kind(), e.message(), c.where, e.advice()) : e);
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
  parallel_for(groups.size(), [&](std::size_t g) {
    BasicSequence sequence;
    bool broken = false;
    for (const std::size_t i : groups[g]) {
      if (progress.stop_requested()) return;
      solve_case(i, sequence, broken);
      if (errors[i]) return;
      broken = results[i]->status == Status::failed;
    }
  });
  for (const auto& error : errors)
    if (error) std::rethrow_exception(error);

  io::RunResult run;
  run.version = version();
  run.git = git_revision();
  run.threads = thread_count();
  run.input_file = file.path.string();
  run.input_sha256 = file.sha256;
  run.geometry_sha256 = store.hashes();
  run.surfaces = store.uses();
  run.cases_total = static_cast<int>(file.cases.size());
  for (auto& result : results)
    if (result) run.cases.push_back(std::move(*result));
  run.complete = run.cases.size() == file.cases.size();
  run.seconds = seconds_since(start);
  return run;
}

void check_geometry(const io::CaseFile& file) {
  SurfaceStore store;
  const SampledRegions regions = sampled_regions(file);
  for (const io::Case& c : file.cases)
    if (const auto* input = std::get_if<io::WheelRailCase>(&c.content)) geometry_of(*input, store, regions);
}

}  // namespace treadmark::app
