// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Material carries its tractions through the contact. With an interface layer far softer than the bodies, u = L p, and
// without creepage the tractions of an element are, one step of one element later, those of its neighbour behind,
// whatever becomes of the patches meanwhile; what comes in at the leading edge has none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "two_crowns.hpp"

namespace treadmark::wheelrail {
namespace {

using kalker::HistoryUse;
using kalker::Regime;
using namespace testing;

constexpr double kShift = 1e-5;

using Place = std::pair<long, long>;
struct Element {
  double pressure = 0.0, px = 0.0;
};

/// Elements in contact by their places on the raster.
std::map<Place, Element> elements(const PairSolution& s) {
  std::map<Place, Element> all;
  for (const PatchSolution& patch : s.patches)
    for (int iy = 0; iy < patch.grid.ny; ++iy)
      for (int ix = 0; ix < patch.grid.nx; ++ix) {
        const std::size_t i = patch.grid.index(ix, iy);
        if (!(patch.contact.pressure[i] > 0.0)) continue;
        const Place place{std::lround(patch.grid.x(ix) / kStep), std::lround(patch.grid.y(iy) / kStep)};
        EXPECT_FALSE(all.contains(place)) << "two patches press on one element";
        all[place] = {patch.contact.pressure[i], patch.contact.traction_x[i]};
      }
  return all;
}

/// Rigid slip of elements in contact: creepage, and what parts of a patch have beyond it.
double rigid_slip(const PatchSolution& patch) {
  if (patch.extra_slip_x.empty()) return patch.kinematics.xi;
  const auto most =
      std::max_element(patch.contact.pressure.begin(), patch.contact.pressure.end()) - patch.contact.pressure.begin();
  return patch.kinematics.xi + patch.extra_slip_x[static_cast<std::size_t>(most)];
}

/// Pitch rate at which the wheel rolls without slip.
double pure_rolling(Problem p) {
  Pair pair(two_crowns());
  p.regime = Regime::steady;
  p.history = HistoryUse::start;
  const auto creepage = [&](double rate) {
    p.state.velocity.pitch = rate;
    return rigid_slip(pair.solve(p).patches.at(0));
  };
  double a = -p.state.velocity.x / kRadius, b = 1.001 * a, fa = creepage(a), fb = creepage(b);
  for (int i = 0; i < 4 && fb != fa; ++i) {
    const double c = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb, b = c, fb = creepage(c);
  }
  return b;
}

TEST(Transport, TractionsStayWithTheMaterialWhilePatchesMergeAndSplit) {
  Pair pair(two_crowns());
  Problem rolling = crowns_problem();
  rolling.regime = Regime::transient;
  rolling.state.velocity.x = 10.0;

  // A shift fills both contacts with tractions.
  Problem shift = crowns_problem();
  shift.regime = Regime::shift;
  shift.state.velocity.x = kShift;
  group(shift, Grouping::apart);
  PairSolution s = pair.solve(shift);
  ASSERT_EQ(s.patches.size(), 2u);
  auto before = elements(s);
  double full = 0.0;
  for (const auto& [place, e] : before) full = std::max(full, std::abs(e.px));
  EXPECT_NEAR(full, kShift / kLayer, 0.01 * kShift / kLayer);

  const Grouping plan[] = {Grouping::apart,    Grouping::together,     Grouping::together, Grouping::apart,
                           Grouping::apart,    Grouping::parts_of_one, Grouping::apart,    Grouping::parts_of_one,
                           Grouping::together, Grouping::apart};
  rolling.history = HistoryUse::keep_going;
  std::uint64_t largest_id = 2;
  for (const Grouping g : plan) {
    rolling.state.position.x += kStep;
    group(rolling, g);
    rolling.state.velocity.pitch = pure_rolling(rolling);  // one reference for both contacts has another radius
    s = pair.solve(rolling);
    ASSERT_EQ(s.status, Status::ok) << s.message;
    EXPECT_LT(std::abs(rigid_slip(s.patches.at(0))), 1e-9);
    ASSERT_EQ(s.patches.size(), g == Grouping::apart ? 2u : 1u);
    const auto now = elements(s);
    double total = 0.0, expected_total = 0.0;
    for (const auto& [place, e] : now) {
      const auto behind = before.find({place.first + 1, place.second});
      const double expected = behind == before.end() ? 0.0 : behind->second.px;
      EXPECT_NEAR(e.px, expected, 4e-3 * full) << place.first << ", " << place.second;
      total += e.px;
      expected_total += expected;
    }
    EXPECT_NEAR(total, expected_total, 1e-3 * std::abs(full) * static_cast<double>(now.size()));
    EXPECT_GT(std::abs(total), 0.1 * full * static_cast<double>(now.size())) << "something is left to be carried";
    for (const PatchSolution& patch : s.patches) {
      EXPECT_FALSE(patch.came_from.empty());
      largest_id = std::max(largest_id, patch.id);
    }
    before = now;
  }
  EXPECT_GT(largest_id, 2u) << "a patch that splits off gets a number of its own";
}

TEST(Transport, APatchThatPartsKeepsItsForce) {
  // Elastic bodies without a layer: each part felt the displacements by the other, and stops to feel them. Where
  // nothing moves and nothing slips, tractions stay.
  Pair pair(two_crowns());
  Problem shift = crowns_problem();
  shift.material.layer_flexibility = 0.0;
  shift.regime = Regime::shift;
  shift.state.velocity.x = kShift;
  group(shift, Grouping::together);
  const PairSolution one = pair.solve(shift);
  ASSERT_EQ(one.patches.size(), 1u);
  const double force = one.load.track.force.x();
  EXPECT_GT(std::abs(force), 1e3);
  shift.state.velocity.x = 0.0;
  shift.history = HistoryUse::keep_going;
  group(shift, Grouping::apart);
  for (int step = 0; step < 3; ++step) {
    const PairSolution parted = pair.solve(shift);
    ASSERT_EQ(parted.patches.size(), 2u);
    // Pressures, which feel each other no longer either, move the edges of the parts a little.
    EXPECT_NEAR(parted.load.track.force.x() / force, 1.0, 5e-3);
  }
}

TEST(Transport, WhatLosesContactForgets) {
  Pair pair(two_crowns());
  Problem rolling = crowns_problem();
  rolling.regime = Regime::transient;
  rolling.state.velocity.x = 10.0;
  rolling.state.velocity.pitch = pure_rolling(rolling);
  Problem shift = crowns_problem();
  shift.regime = Regime::shift;
  shift.state.velocity.x = kShift;
  const double z = pair.solve(shift).z;

  rolling.history = HistoryUse::keep_going;
  rolling.vertical_force.reset();
  rolling.state.position.z = z;
  rolling.state.position.x = kStep;
  EXPECT_GT(std::abs(pair.solve(rolling).load.track.force.x()), 1.0);
  rolling.state.position.z = -1e-3;
  rolling.state.position.x += kStep;
  EXPECT_EQ(pair.solve(rolling).status, Status::no_contact);
  rolling.state.position.z = z;
  rolling.state.position.x += kStep;
  const PairSolution again = pair.solve(rolling);
  ASSERT_EQ(again.status, Status::ok) << again.message;
  EXPECT_NEAR(again.load.track.force.x(), 0.0, 1e-3);
  EXPECT_TRUE(again.patches.at(0).came_from.empty());
}

}  // namespace
}  // namespace treadmark::wheelrail
