// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// Random wheels on random rails, on tread and flange: what holds of every contact is checked by this file's own means.
// TREADMARK_PROBLEMS: how many, TREADMARK_SEED: which; scripts/problem-trials.sh runs many.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/solvers/wheelrail/random_problems.hpp"
#include "treadmark/tests/solvers/wheelrail/solution_bytes.hpp"

namespace treadmark::wheelrail {
namespace {

using ::testing::IsEmpty;

constexpr long kUsualProblems = 200;

/// The same forces and pressures in the mirror.
void expect_mirrored(const RandomProblem& r, const PairSolution& s) {
  Problem left = r.problem;
  left.side = Side::left;
  for (SixMotion* m : {&left.state.position, &left.state.velocity}) m->y = -m->y, m->roll = -m->roll, m->yaw = -m->yaw;
  const PairSolution m = Pair(surfaces_of(r)).solve(left);
  ASSERT_EQ(m.status, s.status);
  ASSERT_EQ(m.patches.size(), s.patches.size());
  constexpr double kRounding = 1e-9;
  const Vec3 a = s.load.track.force, b = m.load.track.force;
  EXPECT_NEAR((Vec3(a.x(), -a.y(), a.z()) - b).norm(), 0.0, kRounding * a.norm());
  for (std::size_t k = 0; k < s.patches.size(); ++k) {
    const Grid2& g = s.patches[k].grid;
    const kalker::ContactSolution &c = s.patches[k].contact, &d = m.patches[k].contact;
    ASSERT_EQ(d.pressure.size(), c.pressure.size());
    double most = 0.0;
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const std::size_t i = g.index(ix, iy), j = g.index(ix, g.ny - 1 - iy);
        most = std::max(most, std::abs(c.pressure[i] - d.pressure[j]));
        if (!c.traction_y.empty()) most = std::max(most, std::abs(c.traction_y[i] + d.traction_y[j]));
      }
    EXPECT_LE(most, kRounding * c.max_pressure);
  }
}

Problem flange_problem(double y, double force, double cant) {
  Problem p;
  p.track.cant = cant;
  p.state.position.y = y;
  p.vertical_force = force;
  p.regime = kalker::Regime::frictionless;
  p.discretisation.dx = p.discretisation.ds = 1e-3;
  return p;
}

TEST(RandomProblems, NothingIsViolatedWithoutAStatus) {
  const long count = from_environment("TREADMARK_PROBLEMS", kUsualProblems);
  const auto first = static_cast<std::uint64_t>(from_environment("TREADMARK_SEED", 1));
  std::map<const Surface*, Pair> used;  // by the wheel, for one problem after the other
  long solved = 0, parted = 0, two = 0;
  for (std::uint64_t number = first; number < first + static_cast<std::uint64_t>(count); ++number) {
    const RandomProblem r = random_problem(number);
    SCOPED_TRACE(fmt::format("TREADMARK_SEED={}: {}", number, r.words()));
    const Geometry g = surfaces_of(r);
    const PairSolution s = Pair(g).solve(r.problem);
    if (s.status != Status::ok) {
      EXPECT_FALSE(s.message.empty());
    } else {
      ++solved;
      two += s.patches.size() > 1;
      parted += ranges::any_of(s.patches, [](const PatchSolution& p) { return p.region.parts.size() > 1; });
      EXPECT_THAT(Violations(r, g, s).found, IsEmpty());
    }
    const auto same_bits = [&](const PairSolution& other) { return SolutionBytes::of(other) == SolutionBytes::of(s); };
    switch (number % 3) {
      case 0:
        expect_mirrored(r, s);
        break;
      case 1:
        EXPECT_TRUE(same_bits(used.try_emplace(g.wheel.get(), g).first->second.solve(r.problem))) << "by the order";
        break;
      default:
        const ThreadLimit limit(1 + static_cast<int>(number / 3 % 7));
        EXPECT_TRUE(same_bits(Pair(g).solve(r.problem))) << "by the number of threads";
    }
  }
  fmt::print("{} of {} solved, {} of them with two patches or more, {} with parts\n", solved, count, two, parted);
  EXPECT_GT(solved, 9 * count / 10);
  if (count < kUsualProblems) return;
  EXPECT_GT(two, 0);
  EXPECT_GT(parted, 0);
}

TEST(RandomProblems, ThoseThatWereWrongOnceAreNot) {
  // Flange contacts between the rows of the search; tractions that turn the force to and fro.
  for (const std::uint64_t number : {1615u, 1883u, 2939u, 3458u, 1873u, 1974u, 2674u}) {
    const RandomProblem r = random_problem(number);
    SCOPED_TRACE(r.words());
    const PairSolution s = Pair(surfaces_of(r)).solve(r.problem);
    EXPECT_EQ(s.status, Status::ok) << s.message;
    EXPECT_THAT(Violations(r, surfaces_of(r), s).found, IsEmpty());
  }
  // Contacts of flange and tread that are parts of one patch on a steep plane.
  for (RandomProblem r : {RandomProblem{"50E6", "EPS", 0.46, flange_problem(6.92e-3, 47.36e3, 1.0 / 40.0)},
                          {"55E1", "EPS", 0.46, flange_problem(6.878e-3, 12e3, 1e-3)},
                          {"54E3", "EPS", 0.42, flange_problem(6.909e-3, 40.9e3, 1.0 / 40.0)}}) {
    r.problem.wheelset.nominal_radius = r.radius;
    SCOPED_TRACE(r.words());
    const PairSolution s = Pair(surfaces_of(r)).solve(r.problem);
    EXPECT_EQ(s.status, Status::ok) << s.message;
    EXPECT_THAT(Violations(r, surfaces_of(r), s).found, IsEmpty());
  }
}

TEST(RandomProblems, WhatIsForgedIsFound) {
  RandomProblem r{"60E1", "S1002", kStandardRadius, standard_problem()};
  const PairSolution good = Pair(surfaces_of(r)).solve(r.problem);
  ASSERT_THAT(Violations(r, surfaces_of(r), good).found, IsEmpty());
  const auto broken = [&](auto forge) {
    PairSolution bad = good;
    forge(bad);
    return Violations(r, surfaces_of(r), bad).found;
  };
  const auto greatest = [&](kalker::ContactSolution& c) {
    return static_cast<std::size_t>(ranges::max_element(c.pressure) - c.pressure.begin());
  };
  using ::testing::Contains;
  using ::testing::StartsWith;
  EXPECT_THAT(broken([&](PairSolution& s) { s.patches[0].contact.pressure[greatest(s.patches[0].contact)] = 0.0; }),
              Contains(StartsWith("penetration over")));
  EXPECT_THAT(broken([&](PairSolution& s) { s.patches[0].contact.pressure[0] = 1e6; }),
              Contains(StartsWith("pressure at a distance")));
  EXPECT_THAT(broken([&](PairSolution& s) { s.patches[0].contact.pressure[0] = -1.0; }),
              Contains(StartsWith("tension")));
  EXPECT_THAT(broken([&](PairSolution& s) { s.patches[0].contact.traction_y[0] = 1e6; }),
              Contains(StartsWith("traction beyond")));
  EXPECT_THAT(broken([&](PairSolution& s) {
                for (double& p : s.patches[0].contact.pressure) p *= 1.001;
              }),
              Contains(StartsWith("vertical force")));
  EXPECT_THAT(broken([&](PairSolution& s) { s.patches.clear(); }), Contains(StartsWith("penetration [m] without")));
}

}  // namespace
}  // namespace treadmark::wheelrail
