// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "solution_bytes.hpp"
#include "standard_pair.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/kalker/contact_span.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"
#include "treadmark/solvers/wheelrail/element_choice.hpp"
#include "treadmark/solvers/wheelrail/root_search.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr double kLoad = 6e4;
/// Shares of an element by which a contact may lie elsewhere than its height says, over the accuracy of forces.
constexpr double kPlace = 500.0;

double distance_of_places(const PairSolution& a, const PairSolution& b) {
  return (a.patches.at(0).frame.X_TC.origin - b.patches.at(0).frame.X_TC.origin).norm();
}

TEST(TotalForces, LongitudinalForceIsFoundByThePitchRate) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  for (const double target : {-9000.0, -200.0, 0.0, 4000.0, 1.2e4}) {
    p.longitudinal_force = target;
    const PairSolution s = pair.solve(p);
    ASSERT_EQ(s.status, Status::ok) << target << ": " << s.message;
    EXPECT_NEAR(s.load.wheelset.force.x(), target, 2.0 * p.solver.eps * 0.3 * kLoad);
    EXPECT_NEAR(s.load.track.force.z(), kLoad, 2.0 * p.solver.eps * kLoad);
    // The same state with the rate that was found gives the same forces.
    Problem again = p;
    again.longitudinal_force.reset();
    again.state.velocity.pitch = s.pitch_rate;
    EXPECT_NEAR(pair.solve(again).load.wheelset.force.x(), target, 5.0 * p.solver.eps * 0.3 * kLoad);
  }
}

TEST(TotalForces, BrakingPullsTheRailForward) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  p.state.position = {};
  p.state.velocity = {.x = 10.0};
  p.longitudinal_force = 5e3;
  const PairSolution braking = pair.solve(p);
  p.longitudinal_force = -5e3;
  const PairSolution driving = pair.solve(p);
  EXPECT_GT(braking.pitch_rate, driving.pitch_rate)
      << "forward rolling has a negative rate: a braked wheel turns slower";
  EXPECT_LT(braking.patches.at(0).kinematics.xi, 0.0);
  EXPECT_GT(driving.patches.at(0).kinematics.xi, 0.0);
}

TEST(TotalForces, MoreThanFrictionAllowsIsNoBalance) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  p.longitudinal_force = 0.4 * kLoad;
  const PairSolution s = pair.solve(p);
  EXPECT_EQ(s.status, Status::not_converged);
  EXPECT_NE(s.message.find("no longitudinal balance"), std::string::npos) << s.message;
  p.longitudinal_force.reset();
  EXPECT_EQ(pair.solve(p).status, Status::ok);
}

/// What holds where a rail on springs is in balance.
void expect_spring_balance(const PairSolution& s, const RailSprings& k, double tolerance) {
  ASSERT_EQ(s.status, Status::ok) << s.message;
  EXPECT_NEAR(k.stiffness_y * s.rail_deflection_y, s.load.track.force.y() + k.force_y, tolerance);
  if (k.stiffness_z > 0.0) {
    EXPECT_NEAR(k.stiffness_z * s.rail_deflection_z, s.load.track.force.z() + k.force_z, tolerance);
  } else {
    EXPECT_EQ(s.rail_deflection_z, 0.0);
  }
}

TEST(TotalForces, RailOnSpringsUnderAPrescribedLoad) {
  Pair pair(standard_geometry());
  PhaseTimes sum;
  for (const Side side : {Side::right, Side::left})
    for (const double stiffness_z : {0.0, 2e7}) {
      Problem p = standard_problem();
      p.side = side;
      p.rail_springs =
          RailSprings{.stiffness_y = 2e7, .stiffness_z = stiffness_z, .force_y = 1500.0, .force_z = -800.0};
      const PairSolution s = pair.solve(p);
      sum += s.times;
      expect_spring_balance(s, *p.rail_springs, 5e-5 * kLoad);
      EXPECT_NEAR(s.load.track.force.z(), kLoad, 2.0 * p.solver.eps * kLoad);
      // A rigid rail that lies where the springs let it go carries the same.
      Problem rigid = p;
      rigid.rail_springs.reset();
      rigid.track.dy += s.rail_deflection_y;
      rigid.track.dz += s.rail_deflection_z;
      const PairSolution r = pair.solve(rigid);
      EXPECT_NEAR(r.z, s.z, 1e-9);
      EXPECT_NEAR((r.load.track.force - s.load.track.force).norm(), 0.0, 1e-4 * kLoad);
      EXPECT_LT(distance_of_places(r, s), 2.0 * kPlace * p.solver.eps * p.discretisation.dx);
    }
  // Far from the springs' balance the height is found less exactly.
  EXPECT_LE(sum.searches, 34);
  EXPECT_LE(sum.tangential_solves, 26);
}

TEST(TotalForces, RailOnSpringsUnderAPrescribedHeight) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  p.vertical_force.reset();
  p.rail_springs = RailSprings{.stiffness_y = 5e7, .stiffness_z = 4e7, .force_y = 0.0, .force_z = 0.0};
  for (const double z : {0.3e-3, 1.5e-3}) {
    p.state.position.z = z;
    const PairSolution s = pair.solve(p);
    expect_spring_balance(s, *p.rail_springs, 1e-3 * kLoad);
    EXPECT_NEAR(s.z, z, 1e-12);
    EXPECT_GT(s.load.track.force.z(), 0.0);
  }
  p.state.position.z = -1e-3;
  EXPECT_EQ(pair.solve(p).status, Status::no_contact);
}

/// Springs at rest, and the contact that the same force makes on a rail that lies where they let it go, on the same
/// elements; of chosen ones at least as many as promised.
void expect_contact_of_its_force(const Problem& p, const PairSolution& s) {
  const double load = s.load.track.force.norm();
  expect_spring_balance(s, *p.rail_springs, 2.0 * p.solver.eps * load);
  if (s.status != Status::ok || s.patches.empty()) return;
  EXPECT_NEAR(s.z, p.state.position.z, 1e-12);
  Problem rigid = p;
  rigid.rail_springs.reset();
  rigid.track.dy += s.rail_deflection_y;
  rigid.track.dz += s.rail_deflection_z;
  rigid.vertical_force = s.load.track.force.z();
  const bool chosen = p.discretisation.choose_dx;
  if (chosen) {
    for (const PatchSolution& patch : s.patches) {
      const kalker::ContactSpan span = kalker::contact_span(patch.grid, patch.contact.pressure);
      EXPECT_GE(std::min(span.nx, span.ny), kLeastAcross);
    }
    if (s.patches.size() > 1) return;
    rigid.discretisation.choose_dx = rigid.discretisation.choose_ds = false;
    rigid.discretisation.dx = s.patches[0].grid.dx, rigid.discretisation.ds = s.patches[0].grid.dy;
  }
  const PairSolution r = Pair(standard_geometry()).solve(rigid);
  ASSERT_EQ(r.status, Status::ok) << r.message;
  ASSERT_EQ(r.patches.size(), s.patches.size());
  // Of chosen elements the search has other steps.
  const double accuracy = chosen ? 1e-3 : 1e-4;
  EXPECT_NEAR(r.z, s.z, accuracy * s.patches[0].approach);
  EXPECT_NEAR((r.load.track.force - s.load.track.force).norm(), 0.0, accuracy * load);
  for (std::size_t k = 0; k < r.patches.size(); ++k)
    EXPECT_NEAR(r.patches[k].contact.max_pressure / s.patches[k].contact.max_pressure, 1.0, 10.0 * accuracy);
}

// Where a rail stands under a load is chosen, and springs of any stiffness are unloaded so far aside that they hold it
// there.
TEST(TotalForces, SpringsOfAnyStiffnessFindTheContactOfTheirForce) {
  constexpr int kProblems = 36;
  Pair pair(standard_geometry());
  Random random(11);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  for (int i = 0; i < kProblems; ++i) {
    Problem p = standard_problem();
    p.state.position.y = between(-3e-3, 4e-3);
    p.discretisation.choose_dx = p.discretisation.choose_ds = i % 3 == 2;
    // there the height is sought, not solved for
    if (i % 4 == 3) p.reference_surface = ReferenceSurface::plane_surface_slip;
    // creep forces may rise as a soft spring gives way, and there may be no balance
    const bool rolls = i % 2 == 1;
    if (!rolls) p.regime = kalker::Regime::frictionless;
    RailSprings k{.stiffness_y = std::pow(10.0, between(rolls ? 7.5 : 5.0, 13.0)),
                  .stiffness_z = std::pow(10.0, between(5.0, 13.0))};
    const double load = std::pow(10.0, between(3.5, 5.1)),
                 dy = std::min(3e-4, 1e4 / k.stiffness_y) * between(-1.0, 1.0);
    SCOPED_TRACE(::testing::Message() << i << ": y " << p.state.position.y << " m, " << load << " N, springs "
                                      << k.stiffness_y << " and " << k.stiffness_z << " N/m, deflection " << dy
                                      << " m");
    p.vertical_force = load;
    Problem rigid = p;
    rigid.track.dy += dy;
    const PairSolution r = pair.solve(rigid);
    ASSERT_EQ(r.status, Status::ok) << r.message;
    k.force_y = k.stiffness_y * dy - r.load.track.force.y();
    k.force_z = between(-1e3, 1e3);
    p.state.position.z = r.z + (load + k.force_z) / k.stiffness_z;
    p.vertical_force.reset();
    p.rail_springs = k;
    const PairSolution s = pair.solve(p);
    expect_contact_of_its_force(p, s);
    EXPECT_NEAR(s.load.track.force.z(), load, 0.02 * load);
    if (i % 6 == 0) {
      EXPECT_EQ(SolutionBytes::of(Pair(standard_geometry()).solve(p)), SolutionBytes::of(s));
    }
  }
}

Problem rolling_straight() {
  Problem p;
  p.track.cant = 1.0 / 40.0;
  p.state.velocity = {.x = 20.0, .pitch = -20.0 / kStandardRadius};
  p.discretisation.dx = p.discretisation.ds = 0.4e-3;
  return p;
}

// From springs as stiff as a contact on: heights and deflections that are found in a few searches.
TEST(TotalForces, StiffSpringsTakeFewSearches) {
  struct Held {
    double y, z, stiffness_y, stiffness_z;
    bool chosen;
  };
  constexpr int kMost = 16;
  for (const Held& scene : {Held{0.0, 0.183e-3, 1e7, 6e8, true}, Held{0.0, 0.232e-3, 1e9, 1e10, false},
                            Held{0.0, 0.232e-3, 1e9, 1e10, true}, Held{5.5e-3, -0.28e-3, 1e9, 1e9, true},
                            Held{5.5e-3, 1.135e-3, 1e7, 1e8, false}, Held{5.5e-3, 1.135e-3, 1e12, 1e8, false},
                            Held{0.0, 1.682e-3, 1e6, 1e8, false}}) {
    SCOPED_TRACE(::testing::Message() << "y " << scene.y << ", z " << scene.z << ", springs " << scene.stiffness_y
                                      << " and " << scene.stiffness_z << (scene.chosen ? ", chosen" : ""));
    Problem p = rolling_straight();
    p.state.position = {.y = scene.y, .z = scene.z};
    p.discretisation.choose_dx = p.discretisation.choose_ds = scene.chosen;
    p.rail_springs = RailSprings{.stiffness_y = scene.stiffness_y, .stiffness_z = scene.stiffness_z};
    const PairSolution s = Pair(standard_geometry()).solve(p);
    EXPECT_GT(s.load.track.force.z(), 0.0);
    expect_contact_of_its_force(p, s);
    EXPECT_LE(s.times.searches, kMost);
  }
}

// A rail that gives way until no wheel is over it: nothing is left of where it was before.
TEST(TotalForces, ARailThatGivesWayFromBelowTheWheelHasNoNumbers) {
  Problem p = rolling_straight();
  p.vertical_force = 1e5;
  p.rail_springs = RailSprings{.stiffness_y = 1e3, .stiffness_z = 1e3};
  const PairSolution s = Pair(standard_geometry()).solve(p);
  EXPECT_EQ(s.status, Status::no_contact);
  EXPECT_NE(s.message.find("off the rail"), std::string::npos) << s.message;
  EXPECT_TRUE(s.patches.empty());
  EXPECT_EQ(s.load.track.force.norm(), 0.0);
  EXPECT_TRUE(std::isnan(s.least_gap));
  for (const double number : {s.z, s.rail_deflection_y, s.rail_deflection_z}) EXPECT_EQ(number, 0.0);
}

TEST(TotalForces, SpringsAndLongitudinalForceAtOnce) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  p.longitudinal_force = 3000.0;
  p.rail_springs = RailSprings{.stiffness_y = 3e7, .stiffness_z = 3e7};
  const PairSolution s = pair.solve(p);
  expect_spring_balance(s, *p.rail_springs, 5e-5 * kLoad);
  EXPECT_NEAR(s.load.wheelset.force.x(), 3000.0, 1.0);
}

// The normal problem finds the height: elements are laid where the contact may be, and where it is. 15 cases.
TEST(TotalForces, AHeightTakesTwoLooks) {
  Pair pair(standard_geometry());
  PhaseTimes sum;
  for (const double y : {-4e-3, -2e-3, 0.0, 1.5e-3, 3e-3})
    for (const double load : {3e4, 6e4, 1.2e5}) {
      Problem p = standard_problem();
      p.state.position.y = y;
      p.vertical_force = load;
      const PairSolution s = pair.solve(p);
      ASSERT_EQ(s.status, Status::ok) << s.message;
      EXPECT_NEAR(s.load.track.force.z(), load, 2.0 * p.solver.eps * load);
      p.vertical_force.reset();
      p.state.position.z = s.z;
      const PairSolution t = pair.solve(p);
      EXPECT_NEAR(t.load.track.force.z(), load, 5.0 * p.solver.eps * load);
      EXPECT_LT(distance_of_places(t, s), kPlace * p.solver.eps * p.discretisation.dx);
      sum += s.times;
    }
  for (const int searches : {sum.searches, sum.distances, sum.tangential_solves}) EXPECT_LE(searches, 40);
  EXPECT_LE(sum.normal_solves, 65);
}

/// Positions of a wheel around a flat, on elements of which contact has hundreds.
std::vector<Problem> over_a_flat() {
  std::vector<Problem> all;
  for (int i = 0; i < 26; ++i) {
    Problem p = standard_problem();
    p.vertical_force = 1.25e5;
    p.discretisation.dx = p.discretisation.ds = 0.4e-3;
    p.state.position = {0.0, 0.0, 0.0, 0.0, 0.0, 4e-3 * (i - 12)};
    p.state.velocity = {.x = 2.0, .pitch = -2.0 / kStandardRadius};
    all.push_back(p);
  }
  return all;
}

// Few elements tell about the height and the friction: those that are given are laid once, where they belong.
TEST(TotalForces, AHeightOfManyElementsTakesOneOfThem) {
  const std::vector<WheelFlat> flat = {{.length = 0.05, .depth = 0.05 * 0.05 / (8.0 * kStandardRadius)}};
  const Geometry geometry{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
                          analytic::make_standard_surface({"S1002"}, Body::wheel, kStandardRadius, flat), true, false};
  Pair pair(geometry), backwards(geometry);
  const std::vector<Problem> problems = over_a_flat();
  std::vector<PairSolution> other;
  for (std::size_t i = problems.size(); i-- > 0;) other.push_back(backwards.solve(problems[i]));
  PhaseTimes sum;
  int single = 0;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    Problem p = problems[i];
    const PairSolution s = pair.solve(p);
    ASSERT_EQ(s.status, Status::ok) << i << ": " << s.message;
    EXPECT_EQ(SolutionBytes::of(s), SolutionBytes::of(other[problems.size() - 1 - i])) << "order matters at " << i;
    const double load = *p.vertical_force;
    EXPECT_NEAR(s.load.track.force.z(), load, 2.0 * p.solver.eps * load);
    // What a prescribed height gives does not know of few elements.
    p.vertical_force.reset();
    p.state.position.z = s.z;
    const PairSolution t = pair.solve(p);
    EXPECT_NEAR((t.load.track.force - s.load.track.force).norm(), 0.0, 5.0 * p.solver.eps * load) << i;
    ASSERT_EQ(t.patches.size(), s.patches.size());
    if (s.patches.size() > 1) continue;  // their heights are sought
    EXPECT_LT(distance_of_places(t, s), kPlace * p.solver.eps * p.discretisation.dx) << i;
    EXPECT_NEAR(t.patches[0].contact.max_pressure / s.patches[0].contact.max_pressure, 1.0, 1e-4) << i;
    sum += s.times;
    ++single;
  }
  EXPECT_GE(single, 15);
  for (const int laid : {sum.searches, sum.distances}) EXPECT_LE(laid, single + 4);
  for (const int solved : {sum.normal_solves, sum.tangential_solves}) EXPECT_LE(solved, 2 * single);
  EXPECT_GE(sum.looks, single) << "looks are counted, too";
}

// They are for elements of one size: those that are given are laid at once.
TEST(TotalForces, CoefficientsOfATableFindTheHeight) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  const double dx = p.discretisation.dx = p.discretisation.ds = 0.25e-3;
  const PairSolution own = pair.solve(p);
  ASSERT_EQ(own.status, Status::ok) << own.message;
  const auto kernel = kalker::make_influence_kernel(p.material, {}, dx, dx, 1.0, 0.0);
  NumericalInfluence table{.nx = 3, .ny = 3, .dx = dx, .dy = dx, .values = {}};
  for (const int iy : {-1, 0, 1})
    for (const int ix : {-1, 0, 1}) {
      const kalker::InfluenceBlock b = kernel->at(ix * dx, iy * dx);
      table.values.push_back({b.nn, b.nx, b.ny, b.xn, b.xx, b.xy, b.yn, b.yx, b.yy});
    }
  p.influence.kind = kalker::InfluenceSettings::Kind::table;
  p.influence.table = std::make_shared<const NumericalInfluence>(table);
  const PairSolution read = pair.solve(p);
  ASSERT_EQ(read.status, Status::ok) << read.message;
  EXPECT_GT(own.times.looks, read.times.looks) << "the other one looks at few elements";
  EXPECT_NEAR(read.z, own.z, 1e-4 * own.patches.at(0).approach);
  EXPECT_NEAR((read.load.track.force - own.load.track.force).norm(), 0.0, 1e-4 * kLoad);
}

TEST(TotalForces, DissimilarBodiesReachThePrescribedLoad) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  p.discretisation.dx = p.discretisation.ds = 1e-3;
  p.material.shear_modulus_1 = 27e9;
  p.material.poisson_1 = 0.34;
  const PairSolution s = pair.solve(p);
  ASSERT_EQ(s.status, Status::ok) << s.message;
  EXPECT_NEAR(s.load.track.force.z(), kLoad, 2.0 * p.solver.eps * kLoad);
}

TEST(TotalForces, AWheelInsideTheRailAndOneBesideItAreStatuses) {
  Pair pair(standard_geometry());
  Problem p = standard_problem();
  const PairSolution before = pair.solve(p);
  Problem inside = p;
  inside.vertical_force.reset();
  inside.state.position.z = 30e-3;
  PairSolution s = pair.solve(inside);
  EXPECT_EQ(s.status, Status::failed);
  EXPECT_NE(s.message.find("inside the rail"), std::string::npos) << s.message;
  Problem derailed = p;
  derailed.state.position.y = 0.4;
  s = pair.solve(derailed);
  EXPECT_EQ(s.status, Status::no_contact);
  EXPECT_NE(s.message.find("off the rail"), std::string::npos) << s.message;
  const PairSolution after = pair.solve(p);
  EXPECT_EQ(after.z, before.z);
  EXPECT_EQ(after.load.track.force, before.load.track.force);
}

TEST(TotalForces, NumbersThatAreNoneAreRefused) {
  Pair pair(standard_geometry());
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  const auto refused = [&](auto change) {
    Problem p = standard_problem();
    change(p);
    EXPECT_THROW(pair.solve(p), Error);
  };
  refused([&](Problem& p) { p.state.position.roll = nan; });
  refused([&](Problem& p) { p.state.velocity.pitch = infinite; });
  refused([&](Problem& p) { p.vertical_force = nan; });
  refused([&](Problem& p) { p.track.cant = nan; });
  refused([&](Problem& p) { p.material.shear_modulus_1 = 0.0; });
  refused([&](Problem& p) { p.longitudinal_force = 1.0, p.regime = kalker::Regime::frictionless; });
  refused([&](Problem& p) { p.longitudinal_force = 1.0, p.state.velocity.x = 0.0; });
  refused([&](Problem& p) { p.rail_springs = RailSprings{.stiffness_y = 0.0}; });
  refused([&](Problem& p) { p.roller = Roller{.nominal_radius = 0.0}; });
  EXPECT_EQ(pair.solve(standard_problem()).status, Status::ok);
}

TEST(RootSearch, FindsRootsOfGrowingFunctionsFromFarAway) {
  const auto iterate = [](auto f, double start) {
    RootSearch search({.tolerance = 1e-9, .first_step = 1e-3, .reach = 1e3, .resolution = 1e-14});
    double x = start;
    int n = 0;
    RootSearch::State state;
    while (++n, (state = search.add(x, f(x))) == RootSearch::State::search && n < 200) x = search.next();
    return std::tuple(state, x, n);
  };
  const auto [state, x, n] = iterate([](double v) { return std::tanh(v - 7.0) + 0.2; }, 0.0);
  EXPECT_EQ(state, RootSearch::State::found);
  EXPECT_NEAR(std::tanh(x - 7.0), -0.2, 1e-8);
  EXPECT_LT(n, 40);
  EXPECT_EQ(std::get<0>(iterate([](double v) { return v < 0.5 ? -1.0 : 2.0; }, 0.0)), RootSearch::State::jump);
  EXPECT_EQ(std::get<0>(iterate([](double) { return -1.0; }, 0.0)), RootSearch::State::nowhere);
  EXPECT_LT(std::get<2>(iterate([](double v) { return 3.0 * v - 2e-3; }, 0.0)), 6);
}

}  // namespace
}  // namespace treadmark::wheelrail
