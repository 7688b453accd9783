// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "treadmark/app/cases/basic_case.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// Solvers keep influence coefficients: finished ones are handed to the next case, with the same bodies where it has
/// any. Thread-safe.
class SolverPool {
 public:
  struct Lease {
    wheelrail::Geometry geometry;
    std::unique_ptr<wheelrail::Pair> pair;
  };

  /// Without history.
  Lease take(const wheelrail::Geometry& geometry);
  std::unique_ptr<BasicSequence> take_basic();
  void give_back(Lease lease);
  void give_back(std::unique_ptr<BasicSequence> basic);

 private:
  std::mutex mutex_;
  std::map<std::pair<const Surface*, const Surface*>, std::vector<std::unique_ptr<wheelrail::Pair>>> idle_;
  std::vector<std::unique_ptr<BasicSequence>> idle_basic_;
};

/// Whether a case does not depend on the ones before it in its sequence.
bool starts_anew(const io::Case& c);

/// Indices of cases that are solved one after the other. Those of different groups do not depend on each other.
std::vector<std::vector<std::size_t>> groups_in_time(const io::CaseFile& file);

/// Cases that follow each other in time. The history outlives a change of the bodies' surfaces (a wheel in another
/// state, another rail): it moves into the solver of the new ones.
class CaseSequence {
 public:
  explicit CaseSequence(SolverPool& pool) : pool_(pool) {}
  ~CaseSequence();
  CaseSequence(const CaseSequence&) = delete;
  CaseSequence& operator=(const CaseSequence&) = delete;

  /// geometry: of a wheel-rail case, else null.
  /// Errors: Error for input that makes no sense, and after a case that failed, for one that depends on it.
  /// Non-convergence is a status.
  io::CaseResult solve(const io::Case& c, const wheelrail::Geometry* geometry);

 private:
  io::CaseResult solve(const io::Case& c, const io::WheelRailCase& input, const wheelrail::Geometry& geometry);
  wheelrail::Pair& pair_for(const wheelrail::Geometry& geometry);

  SolverPool& pool_;
  std::optional<SolverPool::Lease> lease_;
  std::unique_ptr<BasicSequence> basic_;
  bool broken_ = false;
};

}  // namespace treadmark::app
