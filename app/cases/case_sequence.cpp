// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/cases/case_sequence.hpp"

#include <map>
#include <utility>

#include "treadmark/app/cases/contact_program/element_table.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::app {

namespace {

bool damped(const io::BasicCase&) { return false; }
bool damped(const io::WheelRailCase& c) { return c.damping.has_value(); }

}  // namespace

bool starts_anew(const io::Case& c) {
  return std::visit(
      [](const auto& content) {
        if (content.history == HistoryUse::start) return true;
        const bool needs_previous =
            content.regime == Regime::shift || content.regime == Regime::transient || damped(content);
        return !needs_previous && content.history != HistoryUse::same_instant;
      },
      c.content);
}

std::vector<std::vector<std::size_t>> groups_in_time(const io::CaseFile& file) {
  std::vector<std::vector<std::size_t>> groups;
  std::map<int, std::size_t> last;  // group of the last case, by sequence
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
    const auto before = last.find(file.cases[i].sequence);
    if (before != last.end() && !starts_anew(file.cases[i])) {
      groups[before->second].push_back(i);
      continue;
    }
    last[file.cases[i].sequence] = groups.size();
    groups.push_back({i});
  }
  return groups;
}

CaseSequence::~CaseSequence() {
  if (lease_) pool_.give_back(std::move(*lease_));
  if (basic_) pool_.give_back(std::move(basic_));
}

wheelrail::Pair& CaseSequence::pair_for(const wheelrail::Geometry& geometry) {
  if (!lease_) {
    lease_ = pool_.take(geometry);
  } else if (lease_->geometry.rail != geometry.rail || lease_->geometry.wheel != geometry.wheel) {
    const auto history = lease_->pair->save();
    pool_.give_back(std::move(*lease_));
    lease_ = pool_.take(geometry);
    lease_->pair->restore(history);
  }
  return *lease_->pair;
}

io::CaseResult CaseSequence::solve(const io::Case& c, const io::WheelRailCase& input,
                                   const wheelrail::Geometry& geometry) {
  wheelrail::Problem problem = to_problem(input, geometry.round_wheel);
  problem.refinement = true;
  const wheelrail::PairSolution solution = pair_for(geometry).solve(problem);
  io::CaseResult result = to_result(input, solution);
  if (c.element_table > 0)
    for (std::size_t k = 0; k < result.patches.size(); ++k)
      result.patches[k].element_table = mat_head(input, solution, k, c.number);
  return result;
}

io::CaseResult CaseSequence::solve(const io::Case& c, const wheelrail::Geometry* geometry) {
  if (std::exchange(broken_, true))
    throw Error(ErrorKind::numerical,
                "the case before it in its sequence failed, so that there is no previous instant");
  io::CaseResult result;
  if (const auto* rail = std::get_if<io::WheelRailCase>(&c.content)) {
    result = solve(c, *rail, *geometry);
  } else {
    const auto& basic = std::get<io::BasicCase>(c.content);
    if (!basic_) basic_ = pool_.take_basic();
    result = basic_->solve(basic);
    if (c.element_table > 0)
      for (io::PatchResult& patch : result.patches) patch.element_table = mat_head(basic, c.number);
  }
  for (io::PatchResult& patch : result.patches) patch.all_elements = c.element_table > 1;
  broken_ = result.status == Status::failed;
  return result;
}

SolverPool::Lease SolverPool::take(const wheelrail::Geometry& geometry) {
  std::unique_ptr<wheelrail::Pair> pair;
  {
    const std::lock_guard lock(mutex_);
    auto& idle = idle_[{geometry.rail.get(), geometry.wheel.get()}];
    if (!idle.empty()) {
      pair = std::move(idle.back());
      idle.pop_back();
    }
  }
  if (pair)
    pair->reset();
  else
    pair = std::make_unique<wheelrail::Pair>(geometry);
  return {geometry, std::move(pair)};
}

void SolverPool::give_back(Lease lease) {
  const std::lock_guard lock(mutex_);
  idle_[{lease.geometry.rail.get(), lease.geometry.wheel.get()}].push_back(std::move(lease.pair));
}

std::unique_ptr<BasicSequence> SolverPool::take_basic() {
  const std::lock_guard lock(mutex_);
  if (idle_basic_.empty()) return std::make_unique<BasicSequence>();
  std::unique_ptr<BasicSequence> basic = std::move(idle_basic_.back());
  idle_basic_.pop_back();
  basic->reset();
  return basic;
}

void SolverPool::give_back(std::unique_ptr<BasicSequence> basic) {
  const std::lock_guard lock(mutex_);
  idle_basic_.push_back(std::move(basic));
}

}  // namespace treadmark::app
