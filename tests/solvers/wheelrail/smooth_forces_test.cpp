// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kSweepLoad = 20e3;
// Tread and gauge corner in turn: a second region opens, joins the first as a part, is left alone as the only one.
constexpr double kFrom = 4.85e-3, kTo = 5.65e-3;

Problem from_tread_to_gauge_corner() {
  Problem p = standard_problem();
  p.state.position = {};
  p.state.velocity = {10.0, 0.0, 0.0, 0.0, 0.0, -10.0 / kStandardRadius};
  p.vertical_force = kSweepLoad;
  p.discretisation.dx = p.discretisation.ds = 0.3e-3;
  return p;
}

Problem at_one_height() {
  Problem p = from_tread_to_gauge_corner();
  p.vertical_force.reset();
  p.state.position.z = -0.25e-3;
  return p;
}

struct SweepInstant {
  double y = 0.0;
  Vec3 force = Vec3::Zero();
  double z = 0.0;
  std::vector<std::size_t> parts;  ///< of every patch
};

class Sweep {
 public:
  explicit Sweep(Problem p) : problem_(std::move(p)), pair_(standard_geometry()) {}

  SweepInstant at(double y) {
    problem_.state.position.y = y;
    const PairSolution s = pair_.solve(problem_);
    if (s.status != Status::ok && s.status != Status::no_contact)
      ADD_FAILURE() << "y = " << 1e3 * y << " mm: " << s.message;
    SweepInstant now{y, s.load.track.force, s.z, {}};
    for (const PatchSolution& patch : s.patches) now.parts.push_back(patch.region.parts.size());
    return now;
  }

  std::vector<SweepInstant> over(double from, double to, int steps) {
    std::vector<SweepInstant> line;
    for (int i = 0; i <= steps; ++i) line.push_back(at(from + (to - from) * i / steps));
    return line;
  }

  /// The two sides of a change of the patches, as close as lateral positions can be told apart.
  std::pair<SweepInstant, SweepInstant> sides(SweepInstant a, SweepInstant b) {
    constexpr double kClose = 1e-11;
    while (b.y - a.y > kClose) {
      const SweepInstant middle = at(0.5 * (a.y + b.y));
      (middle.parts == a.parts ? a : b) = middle;
    }
    return {a, b};
  }

 private:
  Problem problem_;
  Pair pair_;
};

/// Greatest change of a force from one position to the next, beyond the mean of both neighbouring steps.
double roughness(const std::vector<SweepInstant>& line) {
  double most = 0.0;
  for (std::size_t i = 1; i + 2 < line.size(); ++i)
    for (const int axis : {0, 1, 2}) {
      const auto change = [&](std::size_t j) { return line[j + 1].force[axis] - line[j].force[axis]; };
      most = std::max(most, std::abs(change(i) - 0.5 * (change(i - 1) + change(i + 1))));
    }
  return most;
}

class SmoothForces : public ::testing::TestWithParam<bool> {
 protected:
  Problem problem() const { return GetParam() ? from_tread_to_gauge_corner() : at_one_height(); }
};

// Elements lie at whole steps from the contact reference: where that moves at once, all forces change by an error of
// the discretisation. Their direction only depends on creepages and angles.
constexpr double kSameSize = 2e-3, kSameDirection = 4e-4;
constexpr double kSmall = 200.0;  // forces are compared with no less [N]

TEST_P(SmoothForces, NoJumpWherePatchesOpenJoinAndClose) {
  Sweep sweep(problem());
  const std::vector<SweepInstant> line = sweep.over(kFrom, kTo, 50);
  int changes = 0;
  double worst_along = 0.0, worst_across = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    if (line[i].parts == line[i + 1].parts) continue;
    ++changes;
    const auto [before, after] = sweep.sides(line[i], line[i + 1]);
    const Vec3 jump = after.force - before.force, direction = before.force.normalized();
    const double along = std::abs(jump.dot(direction)), across = jump.cross(direction).norm(),
                 size = before.force.norm() + kSmall;
    worst_along = std::max(worst_along, along / size);
    worst_across = std::max(worst_across, across / size);
    EXPECT_LT(along, kSameSize * size) << "y = " << 1e3 * before.y << " mm";
    EXPECT_LT(across, kSameDirection * size) << "y = " << 1e3 * before.y << " mm";
    EXPECT_NEAR(after.z, before.z, 1e-8) << "y = " << 1e3 * before.y << " mm";
  }
  RecordProperty("changes", changes);
  RecordProperty("worst_along_per_mille", std::to_string(1e3 * worst_along));
  RecordProperty("worst_across_per_mille", std::to_string(1e3 * worst_across));
  EXPECT_GE(changes, GetParam() ? 2 : 3);
}

// A jump would stay; waves, of rows of elements that come and go, and kinks go down with the step.
TEST_P(SmoothForces, RoughnessGoesDownWithTheStep) {
  Sweep sweep(problem());
  const double from = GetParam() ? 5.27e-3 : 5.16e-3, to = GetParam() ? 5.33e-3 : 5.23e-3;
  const int steps = GetParam() ? 12 : 50;
  const double coarse = roughness(sweep.over(from, to, steps)), fine = roughness(sweep.over(from, to, 4 * steps));
  RecordProperty("coarse_N", std::to_string(coarse));
  RecordProperty("fine_N", std::to_string(fine));
  EXPECT_LT(fine, 0.5 * coarse);
}

INSTANTIATE_TEST_SUITE_P(Prescribed, SmoothForces, ::testing::Bool(),
                         [](const auto& p) { return p.param ? "force" : "height"; });

}  // namespace
}  // namespace treadmark::wheelrail
