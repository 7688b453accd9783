// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

// Random wheels on random rails, each in one of the representations: what holds of every contact holds there too, and
// the wheel stands as high as on the formulas, within the stated errors. TREADMARK_PROBLEMS: how many, TREADMARK_SEED:
// which.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "treadmark/backends/create.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/tests/solvers/wheelrail/random_problems.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr long kUsualProblems = 30;

/// A formula in a representation with samples 1 mm apart, and its stated error [m].
struct Represented {
  RepresentedSurface of;
  double error = 0.0;
};

const Represented& represented(const std::string& name, Body body, double radius, const std::string& backend) {
  static std::map<std::tuple<std::string, double, std::string>, Represented> made;
  const auto [at, fresh] = made.try_emplace({name, radius, backend});
  if (!fresh) return at->second;
  SurfaceSpec spec;
  spec.body = body;
  spec.shape = StandardProfile{name};
  spec.nominal_radius = radius;
  const NaturalSurface natural = create_natural(spec);
  constexpr double kReach = 0.06;  // [m]
  const double u = body == Body::rail ? kReach : kReach / radius;
  Region region;
  region.u_min = -u, region.u_max = u;
  Represented& r = at->second;
  r.of = represent(natural, {backend, 1e-3, region});
  r.error = fit_error(natural, r.of).height_max;
  return r;
}

/// An elastic body that comes to lie nearer by e everywhere presses no less than before: with the same force the
/// approach differs by e at most. Elements that lie otherwise in the contact change the force at one approach by about
/// a hundredth.
void expect_as_high(const PairSolution& expected, const PairSolution& found, double error) {
  constexpr double kElements = 0.02;
  double steepest = 0.0, approach = 0.0;
  for (const PairSolution* s : {&expected, &found})
    for (const PatchSolution& patch : s->patches)
      steepest = std::max(steepest, std::abs(patch.angle_rail)), approach = std::max(approach, patch.approach);
  EXPECT_NEAR(found.z, expected.z, (error + kElements * approach) / std::cos(steepest));
}

TEST(RandomRepresentations, StandAsHighAsFormulas) {
  const long count = from_environment("TREADMARK_PROBLEMS", kUsualProblems);
  const auto first = static_cast<std::uint64_t>(from_environment("TREADMARK_SEED", 1));
  std::vector<std::string> names;
  for (const std::string_view name : backend_names())
    if (name != "analytic") names.emplace_back(name);
  long solved = 0, told = 0;
  for (std::uint64_t number = first; number < first + static_cast<std::uint64_t>(count); ++number) {
    RandomProblem r = random_problem(number);
    const std::string &wheel_name = names[number % names.size()],
                      &rail_name = names[(3 * number + number / names.size()) % names.size()];
    SCOPED_TRACE(fmt::format("TREADMARK_SEED={}: {}, {} on {}", number, r.words(), wheel_name, rail_name));
    if (number % 2 == 0) r.problem.regime = kalker::Regime::frictionless;
    const Represented &wheel = represented(r.wheel, Body::wheel, r.radius, wheel_name),
                      &rail = represented(r.rail, Body::rail, 0.0, rail_name);
    const Geometry geometry{rail.of.surface, wheel.of.surface, true, true};
    const PairSolution found = Pair(geometry).solve(r.problem);
    if (found.status != Status::ok) {
      EXPECT_FALSE(found.message.empty());
      continue;
    }
    if (any_grave(found.remarks)) {
      ++told;  // as of a grid that cuts a patch on a steep flank, where contact is searched on the grid
      continue;
    }
    ++solved;
    EXPECT_THAT(Violations(r, geometry, found).found, ::testing::IsEmpty());
    if (r.problem.regime != kalker::Regime::frictionless) continue;
    const PairSolution expected = Pair(surfaces_of(r)).solve(r.problem);
    if (expected.status == Status::ok) expect_as_high(expected, found, wheel.error + rail.error);
  }
  fmt::print("{} of {} solved, {} with a grave warning\n", solved, count, told);
  EXPECT_GT(solved + told, 9 * count / 10);
  EXPECT_GT(solved, 3 * count / 4);
}

}  // namespace
}  // namespace treadmark::wheelrail
