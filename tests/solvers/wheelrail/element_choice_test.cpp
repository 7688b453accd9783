// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/element_choice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/kalker/contact_span.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/tests/solvers/wheelrail/standard_pair.hpp"

namespace treadmark::wheelrail {
namespace {

kalker::ContactSpan span_of(const PatchSolution& patch) {
  return kalker::contact_span(patch.grid, patch.contact.pressure);
}

double area(const PatchSolution& patch) { return patch.contact.elements_contact * patch.grid.cell_area(); }

Problem chosen(Problem p) {
  p.discretisation.choose_dx = p.discretisation.choose_ds = true;
  p.refinement = true;
  return p;
}

/// Elements of a third of the size.
Problem finer(Problem p, const PairSolution& than) {
  p.discretisation.choose_dx = p.discretisation.choose_ds = false;
  p.discretisation.max_elements = 1000000;
  double dx = kInfinity, ds = kInfinity;
  for (const PatchSolution& patch : than.patches) dx = std::min(dx, patch.grid.dx), ds = std::min(ds, patch.grid.dy);
  p.discretisation.dx = dx / 3.0, p.discretisation.ds = ds / 3.0;
  return p;
}

constexpr double kCrown = 0.3;

/// A cylinder that stands across a crowned rail.
Geometry crown() {
  constexpr double kAngle = 0.1;
  ArcChain rail{-kCrown * std::sin(kAngle), kCrown * (1.0 - std::cos(kAngle)), -kAngle, {}};
  rail.segments = {{2.0 * kAngle * kCrown, 1.0 / kCrown}};
  return {analytic::make_prismatic_surface(rail),
          analytic::make_revolved_surface(analytic::straight_chain(0.04), kStandardRadius), true, true};
}

Problem on_crown(double load) {
  Problem p;
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.75;
  p.wheelset = {1.360, -0.070, kStandardRadius, std::nullopt};
  p.regime = kalker::Regime::frictionless;
  p.vertical_force = load;
  return chosen(p);
}

TEST(ElementChoice, SidesFollowTheSizeOfContact) {
  const ElementSize round = elements_for(9e-3, 9e-3, kInfinity);
  EXPECT_DOUBLE_EQ(round.dx, 0.4e-3);
  EXPECT_DOUBLE_EQ(round.ds, 0.4e-3);
  for (double width = 0.3e-3; width < 0.1; width *= 1.07)
    for (const double ratio : {1.0, 1.5, 4.0, 30.0}) {
      const ElementSize one = elements_for(ratio * width, width, kInfinity),
                        twice = elements_for(2.0 * ratio * width, 2.0 * width, kInfinity),
                        turned = elements_for(width, ratio * width, kInfinity);
      EXPECT_GE(width / one.ds, kLeastAcross);
      EXPECT_GE(ratio * width / one.dx, kLeastAcross);
      EXPECT_LE(ratio * width / one.dx, 1.6 * kMostAcross);
      EXPECT_LE(width / one.ds, 1.6 * kLeastAcross);
      EXPECT_DOUBLE_EQ(twice.dx, 2.0 * one.dx);
      EXPECT_DOUBLE_EQ(twice.ds, 2.0 * one.ds);
      EXPECT_EQ(turned.dx, one.ds);
      EXPECT_EQ(turned.ds, one.dx);
    }
  EXPECT_DOUBLE_EQ(elements_for(1e-6, 1e-6, kInfinity).dx, elements_for(1e-5, 1e-5, kInfinity).dx) << "bounded below";
  EXPECT_DOUBLE_EQ(elements_for(20e-3, 20e-3, 0.5e-3).dx, 0.5e-3) << "what varies along the track is not passed over";
}

// Hertz 1882: the load makes patches of any size.
TEST(ElementChoice, HertzContactsConverge) {
  constexpr double kPressure = 3e-3, kArea = 0.03;
  for (const double load : {1e2, 1e3, 1e4, 8e4, 2e5}) {
    const PairSolution s = Pair(crown()).solve(on_crown(load));
    ASSERT_EQ(s.status, Status::ok) << s.message;
    ASSERT_EQ(s.patches.size(), 1U);
    const PatchSolution& patch = s.patches.front();
    const kalker::HertzShape hertz =
        kalker::hertz_from_curvatures(0.5 / kStandardRadius, 0.5 / kCrown, {true, load}, combine(Material{}));
    const double pressure = patch.contact.max_pressure, right = kalker::hertz_max_pressure(hertz);
    EXPECT_NEAR(pressure, right, kPressure * right) << load;
    EXPECT_NEAR(area(patch), kPi * hertz.semi_axis_x * hertz.semi_axis_y, kArea * area(patch)) << load;
    EXPECT_GE(std::min(span_of(patch).nx, span_of(patch).ny), kLeastAcross);
    ASSERT_TRUE(patch.refinement);
    EXPECT_LE(std::abs(pressure - right), patch.refinement->pressure * pressure);
    EXPECT_LT(patch.refinement->pressure, 0.02);
  }
}

TEST(ElementChoice, EightTimesTheLoadHasAsManyElements) {
  for (const double load : {1e3, 4e3, 1.5e4}) {
    const PairSolution s = Pair(crown()).solve(on_crown(load)), more = Pair(crown()).solve(on_crown(8.0 * load));
    const PatchSolution &one = s.patches.front(), &twice = more.patches.front();
    EXPECT_DOUBLE_EQ(twice.grid.dx, 2.0 * one.grid.dx) << load;
    EXPECT_DOUBLE_EQ(twice.grid.dy, 2.0 * one.grid.dy) << load;
    EXPECT_NEAR(twice.contact.elements_contact, one.contact.elements_contact, 0.01 * one.contact.elements_contact);
    EXPECT_NEAR(twice.contact.max_pressure, 2.0 * one.contact.max_pressure, 2e-3 * twice.contact.max_pressure);
  }
}

// Tread, gauge corner and flange, one patch and two.
TEST(ElementChoice, StandardProfilesStayWithinTheEstimate) {
  Pair pair(standard_geometry());
  for (const double y : {-5e-3, -2e-3, 0.0, 2e-3, 4e-3, 5.5e-3, 6.5e-3})
    for (const double load : {3e4, 1.2e5}) {
      Problem p = chosen(standard_problem());
      p.state.position.y = y;
      p.vertical_force = load;
      const PairSolution s = pair.solve(p), fine = pair.solve(finer(p, s));
      ASSERT_EQ(s.status, Status::ok) << s.message;
      ASSERT_EQ(s.patches.size(), fine.patches.size());
      for (std::size_t k = 0; k < s.patches.size(); ++k) {
        SCOPED_TRACE(::testing::Message() << "y " << y << ", load " << load << ", patch " << k + 1);
        const PatchSolution &patch = s.patches[k], &right = fine.patches[k];
        EXPECT_GE(std::min(span_of(patch).nx, span_of(patch).ny), kLeastAcross);
        EXPECT_LT(patch.contact.elements_contact, 2000);
        ASSERT_TRUE(patch.refinement);
        const kalker::Refinement& r = *patch.refinement;
        EXPECT_LE(std::abs(patch.contact.max_pressure - right.contact.max_pressure),
                  r.pressure * patch.contact.max_pressure);
        EXPECT_LE(std::abs(area(patch) - area(right)), r.area * area(patch));
        const double bound = 0.3 * patch.contact.force_n;
        EXPECT_LE(
            std::hypot(patch.contact.force_x - right.contact.force_x, patch.contact.force_y - right.contact.force_y),
            r.force * bound);
        EXPECT_LT(r.pressure, 0.05);
        EXPECT_LT(r.force, 0.05);
      }
    }
}

TEST(ElementChoice, AtAGivenHeightTheForceIsEstimated) {
  Pair pair(standard_geometry());
  Problem p = chosen(standard_problem());
  const PairSolution loaded = pair.solve(p);
  p.vertical_force.reset();
  p.state.position.z = loaded.z;
  const PairSolution s = pair.solve(p), fine = pair.solve(finer(p, s));
  ASSERT_EQ(s.patches.size(), 1U);
  const double force = s.patches.front().contact.force_n;
  EXPECT_NEAR(force, loaded.patches.front().contact.force_n, 5e-3 * force);
  EXPECT_LE(std::abs(force - fine.patches.front().contact.force_n), s.patches.front().refinement->force * force);
}

TEST(ElementChoice, BothSidesAlike) {
  Problem p = chosen(standard_problem());
  const PairSolution right = Pair(standard_geometry()).solve(p);
  p.side = Side::left;
  p.state.position.y *= -1.0, p.state.position.roll *= -1.0, p.state.position.yaw *= -1.0;
  p.state.velocity.y *= -1.0, p.state.velocity.roll *= -1.0, p.state.velocity.yaw *= -1.0;
  const PairSolution left = Pair(standard_geometry()).solve(p);
  ASSERT_EQ(left.patches.size(), right.patches.size());
  for (std::size_t k = 0; k < left.patches.size(); ++k) {
    EXPECT_EQ(left.patches[k].grid.dx, right.patches[k].grid.dx);
    EXPECT_EQ(left.patches[k].grid.dy, right.patches[k].grid.dy);
    EXPECT_EQ(left.patches[k].contact.max_pressure, right.patches[k].contact.max_pressure);
    EXPECT_EQ(left.patches[k].refinement->pressure, right.patches[k].refinement->pressure);
  }
}

TEST(ElementChoice, OneSideMayBeGiven) {
  Problem p = chosen(standard_problem());
  p.discretisation.choose_ds = false;
  p.discretisation.ds = 0.37e-3;
  const PatchSolution patch = Pair(standard_geometry()).solve(p).patches.at(0);
  EXPECT_DOUBLE_EQ(patch.grid.dy, 0.37e-3);
  EXPECT_GE(span_of(patch).nx, kLeastAcross);
}

/// A round contact of this radius [m] in the middle of a region, pressed as Hertz has it.
PatchSolution round_contact(double radius, const detection::ContactPatch& region, ElementSize size) {
  const auto half = [&](double side) { return static_cast<int>(std::ceil(radius / side)); };
  const int nx = half(size.dx), ny = half(size.ds);
  PatchSolution patch;
  patch.region = region;
  patch.grid = {-nx * size.dx, -ny * size.ds, size.dx, size.ds, 2 * nx + 1, 2 * ny + 1};
  for (int iy = 0; iy < patch.grid.ny; ++iy)
    for (int ix = 0; ix < patch.grid.nx; ++ix) {
      const double r = std::hypot(patch.grid.x(ix), patch.grid.y(iy)) / radius;
      patch.contact.pressure.push_back(std::sqrt(std::max(0.0, 1.0 - r * r)));
    }
  return patch;
}

// Heights that are tried on the way to a balance throw away what was chosen: in the end it is chosen all the same, and
// where it cannot be any more, that is said.
TEST(ElementChoice, NothingStaysOnFewElementsUnsaid) {
  constexpr double kRadius = 5e-3;
  ElementChoice choice(standard_geometry(), chosen(standard_problem()), false);
  const auto region = [](double half, double y) {
    detection::ContactPatch patch;
    patch.extent.box = {-half, half, y - half, y + half};
    return patch;
  };
  const auto learn = [&](const detection::ContactPatch& here) {
    const PatchSolution patch = round_contact(kRadius, here, choice.of(here, 0.0));
    const PatchSolution* one = &patch;
    return choice.learn({&one, 1});
  };
  const auto across = [&](const detection::ContactPatch& here) {
    const ElementSize size = choice.of(here, 0.0);
    return 2.0 * kRadius / std::max(size.dx, size.ds);
  };
  const detection::ContactPatch here = region(8e-3, 0.0), deep = region(30e-3, 0.0), aside = region(8e-3, 0.1);
  choice.begin_balance();
  EXPECT_TRUE(choice.few());
  ASSERT_TRUE(learn(here));
  int chosen_again = 0;
  do {
    EXPECT_GE(across(here), kLeastAcross);
    choice.of(deep, 0.0);
  } while (learn(here) && ++chosen_again < 10);
  EXPECT_LE(chosen_again, 2);
  EXPECT_GE(across(here), kLeastAcross);
  EXPECT_FALSE(choice.few_stay());
  EXPECT_FALSE(learn(aside));
  EXPECT_TRUE(choice.few_stay()) << "nothing was chosen there";
  choice.begin_balance();
  EXPECT_FALSE(choice.few_stay() || choice.few());
  EXPECT_TRUE(learn(aside));
  EXPECT_GE(across(aside), kLeastAcross);
}

TEST(ElementChoice, OneRasterInTime) {
  Problem p = chosen(standard_problem());
  p.regime = kalker::Regime::transient;
  EXPECT_FALSE(chooses_elements(p));
  EXPECT_EQ(Pair(standard_geometry()).solve(p).patches.at(0).grid.dx, p.discretisation.dx);
  p.regime = kalker::Regime::steady;
  EXPECT_TRUE(chooses_elements(p));
  p.damping = Damping{};
  EXPECT_FALSE(chooses_elements(p));
}

}  // namespace
}  // namespace treadmark::wheelrail
