// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "standard_pair.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::HistoryUse;
using kalker::Regime;

Problem rolling_problem() {
  Problem p = standard_problem();
  p.regime = Regime::transient;
  p.solver.eps = 1e-7;
  return p;
}

void advance(Problem& p) {
  p.history = HistoryUse::keep_going;
  p.state.position.x += p.discretisation.dx;
}

TEST(Sequence, TransientRollingEndsInSteadyRolling) {
  Pair pair(standard_geometry());
  Problem p = rolling_problem();
  PairSolution s = pair.solve(p);
  const double first = s.patches.at(0).contact.force_x;
  for (int i = 0; i < 160; ++i) {
    advance(p);
    s = pair.solve(p);
    ASSERT_EQ(s.status, Status::ok) << s.message;
  }
  const PatchSolution& patch = s.patches.at(0);
  const kalker::ContactSolution end = steady_on_the_same_elements(p, patch);
  EXPECT_LT(std::abs(first), 0.5 * std::abs(end.force_x)) << "the first step only starts to build up";
  EXPECT_NEAR(patch.contact.force_x, end.force_x, 1e-4 * std::abs(end.force_x));
  EXPECT_NEAR(patch.contact.force_y, end.force_y, 1e-4 * std::abs(end.force_y));
  EXPECT_NEAR(patch.contact.moment_n, end.moment_n, 1e-3 * std::abs(end.moment_n));
  EXPECT_EQ(patch.id, 1u);
  EXPECT_EQ(patch.came_from, std::vector<std::uint64_t>{1});
  // Grids of a sequence lie on a raster, steady ones round the contact reference.
  Problem steady = p;
  steady.regime = Regime::steady;
  steady.history = HistoryUse::start;
  const PairSolution elsewhere = pair.solve(steady);
  EXPECT_NEAR((s.load.track.force - elsewhere.load.track.force).norm(), 0.0, 2e-3 * 6e4);
}

TEST(Sequence, SteadyRollingMayGoOnTransiently) {
  Pair pair(standard_geometry());
  Problem p = rolling_problem();
  p.regime = Regime::steady;
  const PairSolution steady = pair.solve(p);
  p.regime = Regime::transient;
  advance(p);
  const PairSolution next = pair.solve(p);
  // The raster displaces tractions by half an element at most, which decays.
  EXPECT_NEAR((next.load.track.force - steady.load.track.force).norm(), 0.0, 0.01 * 6e4);
}

void expect_same(const PairSolution& a, const PairSolution& b) {
  EXPECT_EQ(a.z, b.z);
  ASSERT_EQ(a.patches.size(), b.patches.size());
  for (std::size_t i = 0; i < a.patches.size(); ++i) {
    EXPECT_EQ(a.patches[i].id, b.patches[i].id);
    EXPECT_EQ(a.patches[i].contact.pressure, b.patches[i].contact.pressure);
    EXPECT_EQ(a.patches[i].contact.traction_x, b.patches[i].contact.traction_x);
    EXPECT_EQ(a.patches[i].contact.traction_y, b.patches[i].contact.traction_y);
  }
}

TEST(Sequence, SavedStateGoesOnToTheLastBitInThisPairAndInAnother) {
  Pair pair(standard_geometry());
  Problem p = rolling_problem();
  pair.solve(p);
  for (int i = 0; i < 5; ++i) advance(p), pair.solve(p);
  const auto saved = pair.save();
  advance(p);
  const PairSolution first = pair.solve(p);
  Problem elsewhere = p;
  elsewhere.state.position.y += 1e-3;
  advance(elsewhere);
  pair.solve(elsewhere);
  pair.restore(saved);
  expect_same(pair.solve(p), first);
  Pair other(standard_geometry());
  other.solve(rolling_problem());
  other.restore(saved);
  expect_same(other.solve(p), first);
}

TEST(Sequence, TheSameInstantAgainGivesTheSameSolution) {
  Pair pair(standard_geometry());
  Problem p = rolling_problem();
  pair.solve(p);
  advance(p);
  const PairSolution once = pair.solve(p);
  p.history = HistoryUse::same_instant;
  Problem faster = p;
  faster.state.velocity.y += 0.01;
  EXPECT_NE(pair.solve(faster).load.track.force.y(), once.load.track.force.y());
  expect_same(pair.solve(p), once);
}

TEST(Sequence, ErrorsLeaveTheHistoryAsItWas) {
  Pair pair(standard_geometry()), undisturbed(standard_geometry());
  Problem p = rolling_problem();
  pair.solve(p);
  undisturbed.solve(p);
  advance(p);
  Problem wrong = p;
  wrong.state.position.y = std::nan("");
  EXPECT_THROW(pair.solve(wrong), Error);
  wrong = p;
  wrong.discretisation.dx *= 0.5;
  wrong.state.position.x = 0.0;
  EXPECT_THROW(pair.solve(wrong), Error) << "elements of another size cannot go on";
  wrong = p;
  wrong.side = Side::left;
  EXPECT_THROW(pair.solve(wrong), Error);
  wrong = p;
  wrong.state.position.x += 5.0 * p.discretisation.dx;
  const PairSolution too_far = pair.solve(wrong);
  EXPECT_EQ(too_far.status, Status::failed);
  EXPECT_NE(too_far.message.find("dt <= 2 dx / V"), std::string::npos) << too_far.message;
  expect_same(pair.solve(p), undisturbed.solve(p));
}

TEST(Sequence, StepsBeyondTheRuleAreARemarkWhereTheyAreAllowed) {
  Pair pair(standard_geometry());
  Problem p = rolling_problem();
  p.discretisation.dq_relative = 2.5;
  EXPECT_EQ(pair.solve(p).status, Status::failed);
  p.enforce_step_rule = false;
  const PairSolution s = pair.solve(p);
  EXPECT_EQ(s.status, Status::ok);
  ASSERT_EQ(s.remarks.size(), 1u);
  EXPECT_EQ(s.remarks.front().kind, RemarkKind::step_rule);
}

TEST(Sequence, LeftIsTheMirrorImageOfRightInTime) {
  Pair right_pair(standard_geometry()), left_pair(standard_geometry());
  Problem right = rolling_problem();
  Problem left = right;
  left.side = Side::left;
  for (SixMotion* m : {&left.state.position, &left.state.velocity}) m->y = -m->y, m->roll = -m->roll, m->yaw = -m->yaw;
  PairSolution r = right_pair.solve(right), l = left_pair.solve(left);
  for (int i = 0; i < 4; ++i) {
    advance(right);
    advance(left);
    r = right_pair.solve(right);
    l = left_pair.solve(left);
  }
  EXPECT_EQ(l.load.track.force.x(), r.load.track.force.x());
  EXPECT_EQ(l.load.track.force.y(), -r.load.track.force.y());
  EXPECT_EQ(l.load.wheel.moment.y(), r.load.wheel.moment.y());
  EXPECT_EQ(l.load.wheel.moment.x(), -r.load.wheel.moment.x());
}

}  // namespace
}  // namespace treadmark::wheelrail
