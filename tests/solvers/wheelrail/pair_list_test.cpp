// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Many problems of one pair: the bits of single solutions, whatever else is solved and by how many threads.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <numeric>
#include <vector>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/tests/solvers/wheelrail/solution_bytes.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr std::size_t kRows = 24;

/// Places across the tread and over the flange, on elements of three sizes.
Problem row(std::size_t i) {
  Problem p = standard_problem();
  p.state.position.y = -4e-3 + 0.5e-3 * static_cast<double>(i);
  p.state.position.yaw = 1e-3 * static_cast<double>(i % 5);
  p.vertical_force = 4e4 + 3e3 * static_cast<double>(i % 7);
  p.discretisation.dx = p.discretisation.ds = 1e-3 + 0.3e-3 * static_cast<double>(i % 3);
  return p;
}

std::vector<std::vector<std::byte>> alone() {
  std::vector<std::vector<std::byte>> out;
  for (std::size_t i = 0; i < kRows; ++i) out.push_back(SolutionBytes::of(Pair(standard_geometry()).solve(row(i))));
  return out;
}

TEST(ManyProblems, GiveTheBitsOfSingleOnesInAnyOrder) {
  const std::vector<std::vector<std::byte>> expected = alone();
  const Pair pair(standard_geometry());
  for (const int threads : {1, 2, 5})
    for (const bool backwards : {false, true}) {
      const ThreadLimit limit(threads);
      std::vector<std::vector<std::byte>> found(kRows);
      const auto of = [&](std::size_t i) { return backwards ? kRows - 1 - i : i; };
      pair.solve_many(
          kRows, [&](std::size_t i) { return row(of(i)); },
          [&](std::size_t i, PairSolution&& solution) { found[of(i)] = SolutionBytes::of(solution); });
      EXPECT_EQ(found, expected) << threads << " threads" << (backwards ? ", backwards" : "");
    }
}

TEST(ManyProblems, LeaveTheHistoryAndGoOnAfterRowsThatFail) {
  Pair pair(standard_geometry());
  pair.solve(standard_problem());
  const auto before = pair.save();
  std::vector<PairSolution> found(6);
  pair.solve_many(
      found.size(),
      [&](std::size_t i) {
        Problem p = row(i);
        if (i == 1) p.state.position.y = NAN;
        if (i == 2) p.history = kalker::HistoryUse::keep_going;
        if (i == 3) throw Error(ErrorKind::numerical, "no such row");
        if (i == 4) {
          p.vertical_force.reset();
          p.state.position.z = -0.02;
        }
        return p;
      },
      [&](std::size_t i, PairSolution&& solution) { found[i] = std::move(solution); });
  EXPECT_EQ(pair.save(), before);
  EXPECT_EQ(found[0].status, Status::ok);
  for (const std::size_t i : {1u, 2u, 3u}) {
    EXPECT_EQ(found[i].status, Status::failed) << i;
    EXPECT_TRUE(found[i].refused && found[i].patches.empty()) << i;
  }
  for (const std::size_t i : {0u, 4u, 5u}) EXPECT_FALSE(found[i].refused) << i;
  EXPECT_THAT(found[2].message, ::testing::HasSubstr("go on from another"));
  EXPECT_THAT(found[3].message, ::testing::HasSubstr("no such row"));
  EXPECT_EQ(found[4].status, Status::no_contact);
  EXPECT_EQ(found[5].status, Status::ok);
  EXPECT_EQ(SolutionBytes::of(found[5]), SolutionBytes::of(Pair(standard_geometry()).solve(row(5))));
}

TEST(ManyProblems, EndWhereTheyAreToldTo) {
  const Pair pair(standard_geometry());
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  std::atomic<std::size_t> taken{0};
  constexpr std::size_t kEndless = 1000000000;
  EXPECT_THROW(pair.solve_many(
                   kEndless, [](std::size_t i) { return row(i % kRows); },
                   [&](std::size_t, PairSolution&&) {
                     if (++taken == 5) stop = true;
                   },
                   progress),
               Cancelled);
  EXPECT_GE(taken, 5u);
  EXPECT_LT(taken, 100u);
}

TEST(ManyProblems, TellHowFarTheyAre) {
  const Pair pair(standard_geometry());
  Progress progress;
  std::size_t last = 0, all = 0;
  progress.report = [&](std::size_t finished, std::size_t total, const std::string&) {
    EXPECT_GT(finished, last);
    last = finished, all = total;
  };
  pair.solve_many(
      kRows, row, [](std::size_t, PairSolution&&) {}, progress);
  EXPECT_EQ(last, kRows);
  EXPECT_EQ(all, kRows);
}

}  // namespace
}  // namespace treadmark::wheelrail
