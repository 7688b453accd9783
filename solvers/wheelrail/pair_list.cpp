// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <chrono>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {
namespace {

/// Pairs on the same surfaces, as many as there are threads at work: they keep influence coefficients.
class SparePairs {
 public:
  explicit SparePairs(const Geometry& geometry) : geometry_(geometry) {}

  std::unique_ptr<Pair> take() {
    {
      const std::lock_guard lock(mutex_);
      if (!spare_.empty()) {
        std::unique_ptr<Pair> pair = std::move(spare_.back());
        spare_.pop_back();
        return pair;
      }
    }
    return std::make_unique<Pair>(geometry_);
  }
  void give_back(std::unique_ptr<Pair> pair) {
    const std::lock_guard lock(mutex_);
    spare_.push_back(std::move(pair));
  }

 private:
  const Geometry& geometry_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Pair>> spare_;
};

/// Tells how far many short pieces of work are, some times a second.
class Counted {
 public:
  Counted(std::size_t total, const Progress& progress) : total_(total), progress_(progress) {}

  void add() {
    using namespace std::chrono_literals;
    if (!progress_.report) return;
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    if (++finished_ < total_ && now - last_ < 50ms) return;
    last_ = now;
    progress_.report(finished_, total_, "contacts");
  }

 private:
  std::size_t total_, finished_ = 0;
  const Progress& progress_;
  std::mutex mutex_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

PairSolution solved_alone(Pair& pair, const std::function<Problem(std::size_t)>& problem, std::size_t i) {
  try {
    const Problem given = problem(i);
    if (given.history != kalker::HistoryUse::start)
      throw Error(ErrorKind::configuration, "one of many problems cannot go on from another one", {},
                  "solve them one after the other");
    return pair.solve(given);
  } catch (const Error& error) {
    PairSolution failed;
    failed.status = Status::failed;
    failed.refused = true;
    failed.message = error.what();
    return failed;
  }
}

}  // namespace

void Pair::solve_many(std::size_t count, const std::function<Problem(std::size_t)>& problem,
                      const std::function<void(std::size_t, PairSolution&&)>& take, const Progress& progress) const {
  const CancellationScope scope(progress.stop);
  SparePairs pairs(geometry_);
  Counted counted(count, progress);
  parallel_for(count, [&](std::size_t i) {
    std::unique_ptr<Pair> pair = pairs.take();
    PairSolution solution = solved_alone(*pair, problem, i);
    pairs.give_back(std::move(pair));
    take(i, std::move(solution));
    counted.add();
  });
}

}  // namespace treadmark::wheelrail
