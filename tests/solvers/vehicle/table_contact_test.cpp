// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/vehicle/multibody.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {
namespace {

using std::numbers::pi;
using wheelrail::Side;

constexpr double kRadius = 0.46, kSpeed = 20.0, kLoad = 8e4;

wheelrail::Geometry standard_geometry() {
  const auto rail = analytic::make_standard_surface({"60E1"}, Body::rail, 0.0);
  return {rail, analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius), true, true};
}

wheelrail::Problem standard_problem(double cant) {
  wheelrail::Problem p;
  p.track.cant = cant;
  return p;
}

/// A coarse one, for what must hold in any table.
std::shared_ptr<const ContactTable> standard_table() {
  static const auto table = build_contact_table(standard_geometry(), standard_problem(1.0 / 40.0), kLoad,
                                                {.lateral_range = 9e-3, .step = 1e-3, .relative_loads = {0.5, 1.5}});
  return table;
}

std::shared_ptr<const ContactTable> tread_table(double cant) {
  return build_contact_table(standard_geometry(), standard_problem(cant), kLoad,
                             {.lateral_range = 6.5e-3, .step = 0.5e-3});
}

/// A standing wheel pressed into the rail so much over the touching height.
PairMotion pressed(const ContactTable& table, double y, double depth) {
  PairMotion m;
  m.wheelset.y = y;
  const TableStretch& there = *table.at(y);
  m.wheelset.z = there.energy_height.at(y).value - 0.6 * there.levels.front().compression.at(y).value + depth;
  return m;
}

PairMotion rolling(PairMotion m) {
  m.wheelset_velocity.x = kSpeed;
  m.wheelset_velocity.pitch = -kSpeed / kRadius;
  return m;
}

/// Displaced and turned in every way.
PairMotion general_motion(double y = 2.3e-3) {
  PairMotion m = rolling(pressed(*standard_table(), y, 1.2e-4));
  m.wheelset.roll = 4e-5;
  m.wheelset.yaw = 3e-3;
  m.rail = {2e-4, -1e-5, -6e-5, 0.01, -0.02, 0.03};
  m.wheelset_velocity.y = 0.03;
  m.wheelset_velocity.yaw = 0.01;
  m.wheelset_velocity.roll = 2e-3;
  m.wheelset_velocity.z = 1e-3;
  return m;
}

PairMotion mirror_image(PairMotion m) {
  for (wheelrail::SixMotion* q : {&m.wheelset, &m.wheelset_velocity})
    q->y = -q->y, q->roll = -q->roll, q->yaw = -q->yaw;
  m.rail.y = -m.rail.y, m.rail.roll = -m.rail.roll, m.rail.vy = -m.rail.vy, m.rail.vroll = -m.rail.vroll;
  return m;
}

double rolling_radius(const ContactReaction& r, const PairMotion& m) {
  const PatchTangent& t = r.tangents.at(0);
  return t.X_TC.origin.z() - r.least_gap * t.X_TC.rotation(2, 2) - (m.wheelset.z - kRadius);
}

double contact_angle(const ContactReaction& r) { return roll_yaw_pitch(r.tangents.at(0).X_TC.rotation).roll; }

TEST(TableContact, ABallIsHertzian) {
  constexpr double kCrown = 20.0;  // across the track; flat as far as the ball is concerned
  const wheelrail::Geometry ball{analytic::make_prismatic_surface(analytic::cylinder_chain(kCrown, 2.5e-3)),
                                 analytic::make_revolved_surface(analytic::barrel_chain(kRadius, 0.08), kRadius), true,
                                 true};
  wheelrail::Problem p;
  p.track.gauge_based = false;
  p.track.rail_y0 = 0.75;
  const auto table = build_contact_table(ball, p, kLoad, {.lateral_range = 6e-3, .step = 1e-3, .element_size = 0.4e-3});
  TableContact element(table, Side::right);
  for (const double y : {-4.3e-3, 0.0, 2.7e-3})
    for (const double approach : {3e-5, 8e-5, 1.5e-4, 2.4e-4}) {
      const double centres = kRadius + kCrown, angle = std::asin(y / centres);
      PairMotion m;
      m.wheelset.y = y;
      m.wheelset.z = centres - std::sqrt((centres - approach) * (centres - approach) - y * y);
      const ContactReaction r = element.evaluate(m);
      const kalker::HertzShape hertz = kalker::hertz_from_curvatures(0.5 / kRadius, 0.5 / kRadius + 0.5 / kCrown,
                                                                     {false, approach}, combine(p.material));
      ASSERT_EQ(r.status, Status::ok);
      EXPECT_NEAR(r.normal_force, hertz.force, 5e-3 * hertz.force);
      EXPECT_NEAR(-r.least_gap, approach, 3e-3 * approach);
      EXPECT_NEAR(r.elastic_energy, 0.4 * hertz.force * approach, 1e-2 * r.elastic_energy);
      EXPECT_NEAR(r.area, pi * hertz.semi_axis_x * hertz.semi_axis_y, 1e-2 * r.area);
      EXPECT_NEAR(r.max_pressure, kalker::hertz_max_pressure(hertz), 1e-2 * r.max_pressure);
      EXPECT_NEAR(contact_angle(r), angle, 2e-6);
      EXPECT_NEAR(r.contact_y, 0.75 + kCrown * std::sin(angle), 2e-5);
      EXPECT_NEAR(rolling_radius(r, m), kRadius * std::cos(angle), 2e-6);
    }
}

class AgainstPair : public ::testing::TestWithParam<double> {
 protected:
  wheelrail::PairSolution solve(double y, double load, bool creeps, const wheelrail::SixMotion& velocity = {}) {
    wheelrail::Problem p = standard_problem(GetParam());
    p.state.position.y = y;
    p.state.velocity = velocity;
    p.vertical_force = load;
    p.regime = creeps ? kalker::Regime::steady : kalker::Regime::frictionless;
    return wheelrail::Pair(standard_geometry()).solve(p);
  }
};

TEST_P(AgainstPair, ElasticForcesAndPlacesOfContact) {
  const auto table = build_contact_table(standard_geometry(), standard_problem(GetParam()), kLoad);
  TableContact element(table, Side::right);
  for (const double y_mm : {-10.1, -6.1, -3.1, -1.1, 0.1, 1.1, 2.1, 3.1, 6.1, 9.1})
    for (const double load : {2e4, 5e4, 1e5, 1.5e5}) {
      SCOPED_TRACE(::testing::Message() << "y = " << y_mm << " mm, " << 1e-3 * load << " kN");
      const wheelrail::PairSolution s = solve(1e-3 * y_mm, load, false);
      ASSERT_EQ(s.status, Status::ok) << s.message;
      PairMotion m;
      m.wheelset.y = 1e-3 * y_mm;
      m.wheelset.z = s.z;
      const ContactReaction r = element.evaluate(m);
      ASSERT_EQ(r.status, Status::ok) << r.message;
      EXPECT_NEAR(r.on_rail.force.z(), load, 0.03 * load);
      const double angle = std::atan(-s.load.track.force.y() / s.load.track.force.z());
      EXPECT_NEAR(contact_angle(r), angle, 0.002 + 0.03 * std::abs(angle));
      if (s.patches.size() > 1 || r.patches > 1) continue;
      const wheelrail::PatchSolution& patch = s.patches.front();
      const double radius = patch.frame.X_TC.apply({0.0, 0.0, patch.approach}).z() - (s.z - kRadius);
      EXPECT_NEAR(rolling_radius(r, m), radius, 1.5e-4 * (1.0 + std::abs(std::tan(angle))));
      EXPECT_NEAR(r.area, patch.contact.elements_contact * patch.grid.cell_area(), 0.15 * r.area);
    }
}

TEST_P(AgainstPair, LateralCreepForces) {
  const auto table = tread_table(GetParam());
  TableContact element(table, Side::right);
  for (const double y_mm : {-6.1, -3.1, 3.1})
    for (const double eta : {-1e-2, -2e-3, -6e-4, 1.2e-3, 3e-3}) {
      SCOPED_TRACE(::testing::Message() << "y = " << y_mm << " mm, eta = " << eta);
      PairMotion m = pressed(*table, 1e-3 * y_mm, 1e-4);
      // Rolling without longitudinal creepage.
      const double radius = rolling_radius(element.evaluate(m), m);
      m.wheelset_velocity = {kSpeed, -eta * kSpeed, 0.0, 0.0, 0.0, -kSpeed / radius};
      const wheelrail::PairSolution s = solve(m.wheelset.y, kLoad, true, m.wheelset_velocity);
      ASSERT_EQ(s.status, Status::ok) << s.message;
      m.wheelset.z = s.z;
      const ContactReaction r = element.evaluate(m);
      double lateral = 0.0;
      for (const wheelrail::PatchSolution& patch : s.patches) lateral += patch.contact.force_y;
      // On the gauge side spin counts as much as the creepage and may cancel it out.
      EXPECT_NEAR(r.lateral_creep_force, lateral, y_mm < 0.0 ? 0.15 * std::abs(lateral) : 0.1 * 0.3 * kLoad);
    }
}

INSTANTIATE_TEST_SUITE_P(Cants, AgainstPair, ::testing::Values(0.0, 1.0 / 40.0));

/// From where the tread leaves the rail to the tip of the flange, or where the profiles end.
struct Wheel {
  const char* name;
  std::function<std::shared_ptr<const Surface>()> make;
  double least_y, most_y;  ///< that the table must reach [m]
};
void PrintTo(const Wheel& wheel, std::ostream* out) { *out << wheel.name; }

/// Two rims beside a hollow of a depth of some mm, no flange.
std::shared_ptr<const Surface> hollow_wheel(double turn) {
  ArcChain chain;
  chain.start_y = -45e-3;
  chain.segments = {
      {15e-3, 0.0}, {5e-3, -turn / 5e-3}, {40e-3, 2.0 * turn / 40e-3}, {5e-3, -turn / 5e-3}, {15e-3, 0.0}};
  return analytic::make_revolved_surface(chain, kRadius);
}

std::shared_ptr<const Surface> named_wheel(const char* name) {
  return analytic::make_standard_surface({name}, Body::wheel, kRadius);
}

class WholeRange : public ::testing::TestWithParam<Wheel> {};

/// Whether a contact comes or goes between the places and loads of the table round these.
bool contacts_change(const ContactTable& table, double y, double load) {
  const TableStretch& there = *table.at(y);
  const auto after = ranges::upper_bound(there.columns, y, {}, &ContactTableColumn::y);
  const auto above = ranges::upper_bound(there.levels, load, {}, &LoadLevel::load);
  if (after == there.columns.begin() || after == there.columns.end() || above == there.levels.begin() ||
      above == there.levels.end())
    return false;
  const auto i = static_cast<std::size_t>(after - there.columns.begin());
  const std::size_t contacts = above->parts[i].size();
  for (const auto* level : {&*above, &*(above - 1)})
    for (const std::size_t column : {i - 1, i})
      if (level->parts[column].size() != contacts) return true;
  return false;
}

TEST_P(WholeRange, ElasticForcesAreThoseOfTheSolvedContact) {
  const wheelrail::Geometry bodies{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0), GetParam().make(), true,
                                   true};
  const wheelrail::Problem problem = standard_problem(1.0 / 40.0);
  const auto table = build_contact_table(bodies, problem, kLoad);
  TableContact element(table, Side::right);
  constexpr double kForce = 0.03, kForceBetween = 0.06;  // of the vertical force at the same height
  const auto solve = [&](double y, double load) {
    wheelrail::Problem p = problem;
    p.state.position.y = y;
    p.vertical_force = load;
    p.regime = kalker::Regime::frictionless;
    return wheelrail::Pair(bodies).solve(p);
  };
  // Of what gives way without loss: the tangent of the force is how the height less the energy over the load changes
  // aside, under the same load.
  const auto slope = [&](double y, double load) {
    constexpr double kStep = 0.1e-3;  // heights are good to 10 nm, from elements to elements
    double height[2];
    for (const int way : {0, 1}) {
      const wheelrail::PairSolution s = solve(y + (way == 0 ? -kStep : kStep), load);
      height[way] = s.status == Status::ok ? s.z : std::nan("");
      for (const wheelrail::PatchSolution& patch : s.patches) height[way] -= patch.contact.elastic_energy / load;
    }
    return (height[1] - height[0]) / (2.0 * kStep);
  };
  double least = 0.0, most = 0.0;
  for (const int way : {-1, 1})
    for (double y = 0.3e-3 * way; table->at(y) != nullptr; y += 3.1e-3 * way)
      for (const double load : {3e4, 1e5, 7.5e5}) {
        SCOPED_TRACE(::testing::Message() << "y = " << 1e3 * y << " mm, " << 1e-3 * load << " kN");
        const wheelrail::PairSolution s = solve(y, load);
        if (s.status != Status::ok) continue;  // more than the material could bear, or at the end of a profile
        if (load < kLoad) least = std::min(least, y), most = std::max(most, y);
        PairMotion m;
        m.wheelset.y = y;
        m.wheelset.z = s.z;
        const ContactReaction r = element.evaluate(m);
        ASSERT_EQ(r.status, Status::ok) << r.message;
        const double most_off = contacts_change(*table, y, load) ? kForceBetween : kForce;
        EXPECT_NEAR(r.on_rail.force.z(), load, most_off * load);
        if (load > 2.0 * kLoad) continue;
        const double angle = std::atan(slope(y, load));
        if (std::isnan(angle)) continue;  // at the end of a profile
        EXPECT_NEAR(std::atan(-r.on_rail.force.y() / r.on_rail.force.z()), angle, 0.002 + 0.06 * std::abs(angle));
      }
  EXPECT_LT(least, GetParam().least_y);
  EXPECT_GT(most, GetParam().most_y);
  // Beyond, the wheel is off the rail: no failure of the solver.
  for (const int way : {-1, 1}) {
    PairMotion off;
    while (table->at(off.wheelset.y) != nullptr) off.wheelset.y += 1e-3 * way;
    const ContactReaction r = element.evaluate(off);
    EXPECT_EQ(r.status, Status::failed);
    EXPECT_TRUE(r.derailed) << r.message;
  }
}

INSTANTIATE_TEST_SUITE_P(Wheels, WholeRange,
                         ::testing::Values(Wheel{"S1002", [] { return named_wheel("S1002"); }, -58e-3, 17e-3},
                                           Wheel{"cone10", [] { return named_wheel("cone 1:10"); }, -55e-3, 30e-3},
                                           Wheel{"cone4", [] { return named_wheel("cone 1:4"); }, -45e-3, 20e-3},
                                           Wheel{"hollow", [] { return hollow_wheel(0.1); }, -18e-3, 20e-3},
                                           Wheel{"deep", [] { return hollow_wheel(0.25); }, -18e-3, 20e-3}),
                         [](const auto& wheel) { return wheel.param.name; });

/// Also where the central position is the last one with contact on a side.
TEST(TableContact, ATableGrowsToTheSideThatIsAskedFor) {
  const ContactUnderLoad contact{1e-4, 1.0, 0.0, 0.0, 0.4, {{1.0, 0.0, 0.0, 0.4, 1e-4, 0.0}}};
  constexpr double kStep = 1e-3, kMost = 2.5e-3;
  int asked = 0;
  ContactTable::Growth growth;
  growth.beyond = [&](const TableTurn&, double from) -> ColumnsBeyond {
    constexpr int kEnough = 20;
    if (++asked > kEnough) throw Error(ErrorKind::numerical, "the table does not come nearer");
    if (std::abs(from) > kMost) return {};
    const double to = from + std::copysign(kStep, from);
    return {{{std::min(from, to), {contact}}, {std::max(from, to), {contact}}}};
  };
  for (const double side : {-1.0, 1.0}) {
    const double other = -side * kStep;  // where the middle reaches to on the other side
    const ContactTableColumns middle{{std::min(0.0, other), {contact}}, {std::max(0.0, other), {contact}}};
    const ContactTable table(std::vector<ContactTableColumns>{middle}, ContactTable::Loads{{1e5}}, wheelrail::Problem{},
                             wheelrail::Placement{}, {}, {}, growth);
    const TableStretch* const there = table.at(1.5 * side * kStep);
    ASSERT_NE(there, nullptr);
    EXPECT_EQ(there->y_min + there->y_max, 3.0 * side * kStep);
    EXPECT_EQ(table.at(4.0 * side * kStep), nullptr);
  }
}

/// A table that ends for want of a solution says so, with what the solver says and where; a wheel derails only where
/// wheel and rail part.
TEST(TableContact, WhereTheSolverFailsNothingHasDerailed) {
  const wheelrail::Geometry bodies = standard_geometry();
  const wheelrail::Problem good = standard_problem(0.025);
  wheelrail::Problem hurried = good;
  hurried.max_force_iterations = hurried.solver.max_iterations = 1;
  const ContactTableOptions options{.lateral_range = 2e-3, .step = 0.5e-3, .relative_loads = {1.0}, .heavier = {}};
  const auto table_of = [&](const wheelrail::Problem& beyond) {
    return contact_table_of(solve_contact_sheets(bodies, good, kLoad, options), bodies, good, kLoad, options,
                            {[&, beyond](const TableTurn& turn, double from) {
                               return solve_columns_beyond(bodies, beyond, kLoad, turn, from, options);
                             },
                             {}});
  };
  TableContact failing(table_of(hurried), Side::right), whole(table_of(good), Side::right);
  for (const double side : {-1.0, 1.0}) {
    PairMotion m = pressed(*standard_table(), 3e-3 * side, 1e-4);
    EXPECT_EQ(whole.evaluate(m).status, Status::ok);
    const ContactReaction r = failing.evaluate(m);
    EXPECT_EQ(r.status, Status::failed);
    EXPECT_FALSE(r.derailed) << r.message;
    EXPECT_NE(r.message.find(side < 0.0 ? "-2 mm aside" : "2 mm aside"), std::string::npos) << r.message;
    EXPECT_NE(r.message.find("under 80 kN"), std::string::npos) << r.message;
    EXPECT_NE(r.message.find("iterations"), std::string::npos) << r.message;
    m.wheelset.y = 90e-3 * side;
    EXPECT_FALSE(failing.evaluate(m).derailed);
    EXPECT_TRUE(whole.evaluate(m).derailed);
  }
}

/// Whoever asks, in whatever order: the same stretches, which go over into each other without a jump of the force.
TEST(TableContact, ATableGrowsTheSameWayWhateverIsAskedFirst) {
  const auto table = [] {
    return build_contact_table(standard_geometry(), standard_problem(0.025), kLoad,
                               {.lateral_range = 3e-3, .growth = 2e-3, .step = 0.5e-3, .relative_loads = {1.0}});
  };
  const auto one = table(), other = table();
  TableContact first(one, Side::right), second(other, Side::right);
  const std::vector<double> places{-7.9e-3, 3.2e-3, -3.1e-3, 5.9e-3, -4.9e-3};
  for (const double y : places) first.evaluate(pressed(*one, y, 1e-4));
  for (auto y = places.rbegin(); y != places.rend(); ++y) {
    const ContactReaction a = first.evaluate(pressed(*one, *y, 1e-4)), b = second.evaluate(pressed(*other, *y, 1e-4));
    ASSERT_EQ(a.status, Status::ok) << a.message;
    EXPECT_EQ(a.on_rail.force, b.on_rail.force) << "y = " << *y;
    EXPECT_EQ(a.on_wheelset.moment, b.on_wheelset.moment) << "y = " << *y;
  }
  for (const double edge : {-5e-3, -3e-3, 3e-3, 5e-3}) {
    const PairMotion inside = pressed(*one, edge - 1e-12, 1e-4);
    PairMotion outside = inside;
    outside.wheelset.y += 2e-12;
    const Vec3 jump = first.evaluate(outside).on_rail.force - first.evaluate(inside).on_rail.force;
    EXPECT_LT(jump.norm(), 1e-6 * kLoad) << "y = " << edge;
  }
}

TEST(TableContact, ClosedLoopsGainNoWork) {
  const auto table = standard_table();
  TableContact element(table, Side::right);
  constexpr int kSteps = 200000;
  double gained = 0.0, moved = 0.0;
  // Across tread and flange root, at loads of all levels.
  const auto place = [&](double t) {
    return pressed(*table, 1e-3 + 5.6e-3 * std::cos(t), 8e-5 + 6e-5 * std::sin(2.0 * t + 0.4));
  };
  for (int i = 0; i < kSteps; ++i) {
    const double t = 2.0 * pi * i / kSteps, dt = 2.0 * pi / kSteps;
    const PairMotion from = place(t), to = place(t + dt);
    PairMotion middle = from;
    middle.wheelset.y = 0.5 * (from.wheelset.y + to.wheelset.y);
    middle.wheelset.z = 0.5 * (from.wheelset.z + to.wheelset.z);
    const Vec3 force = element.evaluate(middle).on_wheelset.force;
    const double work = force.y() * (to.wheelset.y - from.wheelset.y) + force.z() * (to.wheelset.z - from.wheelset.z);
    gained += work;
    moved += std::abs(work);
  }
  EXPECT_NEAR(gained, 0.0, 1e-6 * moved);
}

TEST(TableContact, ForcesAreTheGradientOfTheEnergyInEveryCoordinate) {
  TableContact element(standard_table(), Side::right);
  for (const double y : {-5.2e-3, 0.3e-3, 2.3e-3, 5.9e-3}) {
    PairMotion m = general_motion(y);
    m.wheelset_velocity = {};
    m.rail.vy = m.rail.vz = m.rail.vroll = 0.0;
    const ContactReaction r = element.evaluate(m);
    PairVector force = generalised_force(r, m);
    // Yaw moves the contact along the rail, which the energy does not know of.
    const double profile_x = -standard_table()->nominal().X_TW.origin.y() * std::sin(m.wheelset.yaw);
    force(5) -= (r.contact_x - profile_x) * r.on_wheelset.force.y();
    const auto energy = [&](int i, double step) {
      PairMotion moved = m;
      wheelrail::SixMotion& w = moved.wheelset;
      double* coordinates[] = {&w.x,   &w.y,          &w.z,          &w.roll,         &w.pitch,
                               &w.yaw, &moved.rail.y, &moved.rail.z, &moved.rail.roll};
      *coordinates[i] += step;
      return element.evaluate(moved).elastic_energy;
    };
    for (int i = 0; i < kPairCoordinates; ++i) {
      const double h = 1e-9;
      const double gradient = (energy(i, h) - energy(i, -h)) / (2.0 * h);
      EXPECT_NEAR(force(i), -gradient, 2e-5 * force.cwiseAbs().maxCoeff()) << "coordinate " << i << ", y = " << y;
    }
  }
}

TEST(TableContact, ActionIsReaction) {
  TableContact element(standard_table(), Side::right);
  const PairMotion m = general_motion();
  const ContactReaction r = element.evaluate(m);
  ASSERT_EQ(r.status, Status::ok);
  EXPECT_EQ(r.on_wheelset.force, -r.on_rail.force);
  const Vec3 marker = standard_table()->nominal().X_TR.origin + Vec3(0.0, m.rail.y, m.rail.z);
  const Vec3 centre(0.0, m.wheelset.y, m.wheelset.z - kRadius);
  const Vec3 sum =
      r.on_rail.moment + marker.cross(r.on_rail.force) + r.on_wheelset.moment + centre.cross(r.on_wheelset.force);
  // Friction acts on each body where its creepage is taken: as far apart as the undeformed bodies are in each other.
  const double friction = std::hypot(r.longitudinal_creep_force, r.lateral_creep_force);
  EXPECT_NEAR(sum.norm(), std::abs(r.least_gap) * friction, 1e-9 * r.on_rail.moment.norm());
}

class AtPlace : public ::testing::TestWithParam<double> {};

TEST_P(AtPlace, FrictionTakesWhatTheForcesDoAndTheSpringDoesNotStore) {
  TableContact element(standard_table(), Side::right);
  const PairMotion m = general_motion(GetParam());
  const ContactReaction r = element.evaluate(m);
  const wheelrail::SixMotion& v = m.wheelset_velocity;
  PairVector rates;
  rates << v.x, v.y, v.z, v.roll, v.pitch, v.yaw, m.rail.vy, m.rail.vz, m.rail.vroll;
  PairMotion later = m;
  const double dt = 1e-7;
  later.wheelset.y += v.y * dt, later.wheelset.z += v.z * dt, later.wheelset.roll += v.roll * dt,
      later.wheelset.yaw += v.yaw * dt;
  later.rail.y += m.rail.vy * dt, later.rail.z += m.rail.vz * dt, later.rail.roll += m.rail.vroll * dt;
  const double stored = (element.evaluate(later).elastic_energy - r.elastic_energy) / dt;
  const double power = generalised_force(r, m).dot(rates);
  EXPECT_GT(r.frictional_power, 0.0);
  EXPECT_NEAR(power + stored + r.frictional_power, 0.0, 1e-3 * r.frictional_power);
}

/// On the tread; on tread and flange root at a time.
INSTANTIATE_TEST_SUITE_P(Places, AtPlace, ::testing::Values(2.3e-3, 5.3e-3));

/// A cone on a rail with two crests, canted until the cone lies on both: two contacts of half the load each, at one
/// angle, on circles of which one is by what they are apart times the sine of this angle larger.
struct TwoCrests {
  double incline = 0.2, crest_radius = 0.1;        ///< [rad], [m]
  double half_turn = 0.15, valley_length = 30e-3;  ///< of a crest to either side [rad]; [m]
  double apart = (2.0 * crest_radius + valley_length / half_turn) * std::sin(half_turn);  ///< crests [m]

  wheelrail::Geometry bodies() const {
    const double aside = crest_radius * std::sin(half_turn), arc = 2.0 * crest_radius * half_turn;
    ArcChain rail, cone;
    rail.start_y = -0.5 * apart - aside;
    rail.start_z = crest_radius * (1.0 - std::cos(half_turn));
    rail.start_angle = -half_turn;
    rail.segments = {
        {arc, 1.0 / crest_radius}, {valley_length, -2.0 * half_turn / valley_length}, {arc, 1.0 / crest_radius}};
    constexpr double kHalfWidth = 70e-3;
    cone.start_y = -kHalfWidth;
    cone.start_z = kHalfWidth * std::tan(incline);
    cone.start_angle = -incline;
    cone.segments = {{2.0 * kHalfWidth / std::cos(incline), 0.0}};
    return {analytic::make_prismatic_surface(rail), analytic::make_revolved_surface(cone, kRadius), true, true};
  }
  wheelrail::Problem problem(double friction) const {
    wheelrail::Problem p;
    p.track.gauge_based = false;
    p.track.rail_y0 = 0.75;
    p.track.cant = incline;
    p.friction.kinetic = friction;
    return p;
  }
  std::shared_ptr<const ContactTable> table(double friction) const {
    return build_contact_table(bodies(), problem(friction), kLoad, {.lateral_range = 2e-3, .step = 0.5e-3});
  }
};

/// Where wheel and rail touch at two places, each slides on a circle of its own. So far apart they slide altogether,
/// and by Coulomb's law: a wheel that rolls freely on the mean circle loses the bound of friction of both over half the
/// difference of both circles, though no force is left. One ellipse at the place of the resultant would roll.
TEST(TableContact, TwoContactsSlideByThemselves) {
  constexpr double kFriction = 0.3;
  constexpr double kSpin = 0.02;        // of the bound, what the spin of the cone turns forces by
  constexpr double kOfTheTable = 0.02;  // between loads and places that were solved
  const TwoCrests crests;
  const auto table = crests.table(kFriction);
  TableContact element(table, Side::right);
  const double bound = kFriction * kLoad / std::cos(crests.incline);
  const double circle = 0.5 * crests.apart * std::sin(crests.incline);  // off the mean one [m]
  for (const double y : {0.0, 0.3e-3})
    for (const double faster : {0.0, 0.05, -0.05}) {
      SCOPED_TRACE(::testing::Message() << "y = " << 1e3 * y << " mm, turns faster by " << faster);
      PairMotion m;
      m.wheelset.y = y;
      const double mean = kRadius + y * std::tan(crests.incline);  // the rail stays where it is
      m.wheelset_velocity.x = kSpeed;
      m.wheelset_velocity.pitch = -(1.0 + faster) * kSpeed / mean;
      m.wheelset.z = element.under_load(m, kLoad).wheelset_z;
      const ContactReaction r = element.evaluate(m);
      ASSERT_EQ(r.status, Status::ok) << r.message;
      EXPECT_EQ(r.patches, 2);
      double lost = 0.0, force = 0.0;
      for (const double side : {-1.0, 1.0}) {
        const double creepage = (1.0 + faster) * (1.0 + side * circle / mean) - 1.0;
        lost += 0.5 * bound * kSpeed * std::abs(creepage);
        force -= std::copysign(0.5 * bound, creepage);
      }
      EXPECT_NEAR(r.frictional_power, lost, (kSpin + kOfTheTable) * lost);
      EXPECT_NEAR(r.longitudinal_creep_force, force, (kSpin + kOfTheTable) * bound);
    }
}

/// Where friction is not used up creep damps a turn of the wheelset by what both contacts are apart.
TEST(TableContact, CreepDampsAtEachContact) {
  const TwoCrests crests;
  constexpr double kFriction = 20.0;  // of which contacts use little
  const auto table = crests.table(kFriction);
  TableContact element(table, Side::right);
  PairMotion m = rolling(pressed(*table, 0.0, 1e-4));
  const ContactReaction r = element.evaluate(m);
  ASSERT_EQ(r.patches, 2);
  const PairMatrix damping = pair_tangent(r, m, table->nominal().X_TR.origin, kRadius).damping;
  // By rates of the wheelset along the track and about the vertical.
  const auto numeric = [&](double wheelrail::SixMotion::*rate, double step, int of) {
    double force[2];
    for (const int way : {0, 1}) {
      PairMotion moved = m;
      moved.wheelset_velocity.*rate += way == 0 ? -step : step;
      force[way] = generalised_force(element.evaluate(moved), moved)(of);
    }
    return -(force[1] - force[0]) / (2.0 * step);
  };
  constexpr double kSpin = 0.01;  // which tangents leave out
  const double along = numeric(&wheelrail::SixMotion::x, 1e-4, 0),
               turning = numeric(&wheelrail::SixMotion::yaw, 1e-4, 5);
  EXPECT_NEAR(damping(0, 0), along, kSpin * along);
  EXPECT_NEAR(damping(5, 5), turning, kSpin * turning);
  // About the axis between both.
  const double apart = crests.apart * std::cos(crests.incline);
  EXPECT_NEAR(damping(5, 5) - damping(0, 5) * damping(0, 5) / damping(0, 0), 0.25 * apart * apart * damping(0, 0),
              0.02 * 0.25 * apart * apart * damping(0, 0));
}

/// A wheelset that follows a curve yaws with it: its flange, which touches ahead of the axle, comes no nearer to a rail
/// that bends.
TEST(TableContact, FollowingABentRailTakesNoWorkBesideFriction) {
  TableContact element(standard_table(), Side::right);
  PairMotion m = general_motion(5.9e-3);
  m.wheelset.yaw = 8e-3;
  m.rail = {};
  constexpr double kSpeed = 20.0, kCurvature = 1.0 / 150.0;
  const auto missing = [&](double curvature) {
    m.curvature = curvature;
    const ContactReaction r = element.evaluate(m);
    PairVector rates = PairVector::Zero();
    const wheelrail::SixMotion& v = m.wheelset_velocity;
    rates.head<6>() << v.x, v.y, v.z, v.roll, v.pitch, v.yaw;
    return (generalised_force(r, m).dot(rates) + r.frictional_power) / r.frictional_power;
  };
  m.wheelset_velocity = {
      kSpeed * (1.0 - kCurvature * m.wheelset.y), 0.0, 0.0, 0.0, kSpeed * kCurvature, -kSpeed / kRadius};
  EXPECT_NEAR(missing(kCurvature), 0.0, 1e-4);
  EXPECT_GT(std::abs(missing(0.0)), 1e-3);
}

TEST(TableContact, LeftIsTheExactMirrorImage) {
  TableContact right(standard_table(), Side::right), left(standard_table(), Side::left);
  const PairMotion m = general_motion();
  const ContactReaction r = right.evaluate(m), l = left.evaluate(mirror_image(m));
  const auto flipped = [](Vec3 v) { return Vec3(v.x(), -v.y(), v.z()); };
  EXPECT_EQ(l.on_rail.force, flipped(r.on_rail.force));
  EXPECT_EQ(l.on_wheelset.moment, Vec3(-flipped(r.on_wheelset.moment)));
  EXPECT_EQ(l.on_rail.moment, Vec3(-flipped(r.on_rail.moment)));
  EXPECT_EQ(l.lateral_creep_force, -r.lateral_creep_force);
  EXPECT_EQ(l.longitudinal_creep_force, r.longitudinal_creep_force);
  EXPECT_EQ(l.frictional_power, r.frictional_power);
  EXPECT_EQ(l.contact_y, -r.contact_y);
  EXPECT_EQ(l.tangents[0].X_TC.origin, flipped(r.tangents[0].X_TC.origin));
  EXPECT_EQ(roll_yaw_pitch(l.tangents[0].X_TC.rotation).roll, -contact_angle(r));
  // Tangents too belong to the mirrored point: both give the same stiffness in the mirrored coordinates.
  const Vec3 marker = standard_table()->nominal().X_TR.origin;
  const PairTangent tr = pair_tangent(r, m, marker, kRadius),
                    tl = pair_tangent(l, mirror_image(m), flipped(marker), kRadius);
  EXPECT_NEAR(tl.stiffness(1, 2), -tr.stiffness(1, 2), 1e-9 * tr.stiffness(2, 2));
}

TEST(TableContact, RadiusDifferenceIsOdd) {
  const auto table = standard_table();
  TableContact right(table, Side::right), left(table, Side::left);
  const auto difference = [&](double y) {
    const PairMotion at_right = pressed(*table, y, 1e-4), at_left = mirror_image(pressed(*table, -y, 1e-4));
    return rolling_radius(right.evaluate(at_right), at_right) - rolling_radius(left.evaluate(at_left), at_left);
  };
  EXPECT_EQ(difference(0.0), 0.0);
  for (const double y : {1e-3, 3e-3, 5.5e-3}) {
    EXPECT_EQ(difference(y), -difference(-y));
    // The wheel that comes closer to its flange rolls on the larger circle: on the right that of a wheelset moved to
    // the right.
    EXPECT_GT(difference(y), 0.0);
  }
}

TEST(TableContact, BodiesThatMoveTogetherStayAsTheyAre) {
  TableContact element(standard_table(), Side::right);
  const PairMotion m = pressed(*standard_table(), 1.4e-3, 1e-4);
  const ContactReaction before = element.evaluate(m);
  // Rolled about the track's origin.
  const double roll = 2e-3;
  const auto turned = [&](const Vec3& p) { return Vec3(rotation_x(roll) * p - p); };
  PairMotion together = m;
  const Vec3 wheelset = turned({0.0, m.wheelset.y, m.wheelset.z - kRadius}),
             rail = turned(standard_table()->nominal().X_TR.origin);
  together.wheelset.y += wheelset.y(), together.wheelset.z += wheelset.z(), together.wheelset.roll = roll;
  together.rail.y = rail.y(), together.rail.z = rail.z(), together.rail.roll = roll;
  const ContactReaction after = element.evaluate(together);
  EXPECT_NEAR(after.normal_force, before.normal_force, 1e-8 * before.normal_force);
  EXPECT_NEAR(contact_angle(after), contact_angle(before) + roll, 1e-9);
}

TEST(TableContact, RollInclinesTheWheelLikeTheSolvedContact) {
  // A wheelset rolled about its centre, the height found again for the same load.
  TableContact element(tread_table(0.0), Side::right);
  for (const double roll : {-1e-3, 1e-3})
    for (const double y : {-4e-3, 0.0, 2e-3}) {
      wheelrail::Problem p = standard_problem(0.0);
      p.regime = kalker::Regime::frictionless;
      p.state.position.y = y;
      p.state.position.roll = roll;
      p.vertical_force = kLoad;
      const wheelrail::PairSolution s = wheelrail::Pair(standard_geometry()).solve(p);
      ASSERT_EQ(s.status, Status::ok);
      PairMotion m;
      m.wheelset = p.state.position;
      m.wheelset.z = s.z;
      const ContactReaction r = element.evaluate(m);
      EXPECT_NEAR(r.on_rail.force.z(), kLoad, 0.03 * kLoad);
      EXPECT_NEAR(contact_angle(r), s.patches.at(0).frame.angle, 2e-3);
      EXPECT_NEAR(r.contact_y, s.patches[0].frame.X_TC.origin.y(), 2e-3);
    }
}

TEST(TableContact, StiffnessIsTheDerivativeOfTheForce) {
  const auto table = standard_table();
  TableContact element(table, Side::right);
  for (const double depth : {1e-5, 9e-5, 2.5e-4})
    for (const double y : {-3.2e-3, 1.7e-3, 8e-3}) {
      PairMotion m = pressed(*table, y, depth);
      const ContactReaction r = element.evaluate(m);
      const double h = 1e-9;
      m.wheelset.z += h;
      const double above = element.evaluate(m).on_rail.force.z();
      m.wheelset.z -= 2.0 * h;
      const double derivative = (above - element.evaluate(m).on_rail.force.z()) / (2.0 * h);
      const double cosine = r.tangents[0].X_TC.rotation(2, 2);
      EXPECT_NEAR(r.tangents[0].stiffness_n * cosine * cosine, derivative, 1e-4 * derivative);
    }
}

TEST(TableContact, TheTableDoesNotDependOnThreads) {
  const auto build = [](int threads) {
    const ThreadLimit limit(threads);
    return build_contact_table(standard_geometry(), standard_problem(0.025), kLoad,
                               {.lateral_range = 3e-3, .step = 1e-3});
  };
  const auto one = build(1), two = build(2);
  const auto bytes = [](const TableStretch* stretch) {
    ByteWriter out;
    write_columns(stretch->columns, out);
    return out.bytes();
  };
  EXPECT_EQ(bytes(&one->central()), bytes(&two->central()));
  EXPECT_EQ(bytes(one->heavier(one->central())), bytes(two->heavier(two->central())));
  EXPECT_EQ(bytes(one->at(-5e-3)), bytes(two->at(-5e-3)));
  // And back.
  const std::vector<std::byte> kept = bytes(one->at(5e-3));
  ByteReader in(kept);
  ByteWriter again;
  write_columns(read_columns(in), again);
  EXPECT_TRUE(in.at_end());
  EXPECT_EQ(again.bytes(), kept);
}

TEST(TableContact, OutsideTheTableAndInTheAir) {
  TableContact element(standard_table(), Side::right);
  PairMotion m = pressed(*standard_table(), 0.0, 1e-4);
  for (const auto& [y, what] : {std::pair{40e-3, "flange has climbed"}, {-90e-3, "tread has left"}}) {
    m.wheelset.y = y;
    const ContactReaction off = element.evaluate(m);
    EXPECT_EQ(off.status, Status::failed);
    EXPECT_TRUE(off.derailed);
    EXPECT_NE(off.message.find(what), std::string::npos) << off.message;
  }

  const ContactReaction lifted = element.evaluate(pressed(*standard_table(), 0.0, -2e-4));
  EXPECT_EQ(lifted.status, Status::no_contact);
  EXPECT_NEAR(lifted.least_gap, 2e-4, 2e-6);
  EXPECT_EQ(lifted.on_rail.force.norm(), 0.0);
  EXPECT_TRUE(lifted.tangents.empty());

  m.wheelset.roll = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(element.evaluate(m), Error);
}

/// Tables without sheets for rolls and yaws are to first order in them: good for what is small.
TEST(TableContact, TurnsThatAreNotSmallHaveNoAnswer) {
  TableContact element(standard_table(), Side::right);
  const PairMotion upright = rolling(pressed(*standard_table(), 0.0, 1e-4));
  for (double wheelrail::SixMotion::*turn : {&wheelrail::SixMotion::yaw, &wheelrail::SixMotion::roll})
    for (const double angle : {-1.0, -0.21, 0.21, 1.0}) {
      PairMotion m = upright;
      m.wheelset.*turn = angle;
      const ContactReaction r = element.evaluate(m);
      EXPECT_EQ(r.status, Status::failed) << angle;
      EXPECT_FALSE(r.derailed) << r.message;
      EXPECT_NE(r.message.find("200 mrad"), std::string::npos) << r.message;
    }
  PairMotion small = upright;
  small.wheelset.yaw = 0.19;
  const wheelrail::Placement& nominal = standard_table()->nominal();
  const Vec3 arm = nominal.X_TW.origin - nominal.X_TWs.origin;
  small.wheelset.y -= (rotation_z(small.wheelset.yaw) * arm - arm).y();
  const ContactReaction r = element.under_load(small, kLoad);
  EXPECT_EQ(r.status, Status::ok) << r.message;
}

/// A contact that shrinks from load to load keeps its friction beyond the last one, where it grows like Hertz's.
TEST(TableContact, BeyondTheLastLoadNoContactVanishes) {
  constexpr double kLast = 2e5, kArea = 0.5e-4, kFriction = 0.3, kStiff = 1e9;
  const auto under = [](double load, double area) {
    return ContactUnderLoad{load / kStiff, 0.4 * load * load / kStiff,       0.0, 0.0,
                            0.4,           {{1.0, 0.0, 0.0, 0.4, area, 0.0}}};
  };
  ContactTableColumns columns;
  for (const double y : {-1e-3, 1e-3}) columns.push_back({y, {under(0.5 * kLast, 2.0 * kArea), under(kLast, kArea)}});
  wheelrail::Problem problem;
  problem.friction.kinetic = kFriction;
  const auto table =
      std::make_shared<const ContactTable>(std::vector<ContactTableColumns>{columns},
                                           ContactTable::Loads{{0.5 * kLast, kLast}}, problem, wheelrail::Placement{});
  TableContact element(table, Side::right);
  for (const double times : {0.999, 1.001, 2.0, 5.0, 20.0}) {
    PairMotion m;
    m.wheelset_velocity.x = kSpeed;  // it slides
    const ContactReaction r = element.under_load(m, times * kLast);
    ASSERT_EQ(r.status, Status::ok) << r.message;
    const double area = times < 1.0 ? kArea : kArea * std::cbrt(times * times);
    EXPECT_NEAR(r.area, area, 0.01 * area) << times;
    EXPECT_NEAR(std::hypot(r.longitudinal_creep_force, r.lateral_creep_force), kFriction * r.normal_force,
                0.01 * r.normal_force)
        << times;
  }
}

TEST(TableContact, SavedStatesAreTheirOwn) {
  TableContact element(standard_table(), Side::right);
  ByteWriter saved, other;
  element.save(saved);
  other.put(3.0);
  ByteReader own(saved.bytes()), foreign(other.bytes());
  EXPECT_NO_THROW(element.restore(own));
  EXPECT_TRUE(own.at_end());
  EXPECT_THROW(element.restore(foreign), Error);
}

FrictionLaw coulomb(double coefficient) {
  FrictionLaw law;
  law.kinetic = coefficient;
  return law;
}

TEST(TableContact, FrictionIsThatOfItsPlaceAlongTheRail) {
  // A wheel that does not turn slides all over: friction carries what it can.
  PairMotion locked = pressed(*standard_table(), 0.0, 1.2e-4);
  locked.wheelset_velocity.x = kSpeed;
  const FrictionAlong falling{{0.0, 0.5, 0.55}, {coulomb(0.3), coulomb(0.3), coulomb(0.05)}, 0.2};
  for (const Side side : {Side::left, Side::right}) {
    TableContact element(standard_table(), side, nullptr, falling);
    for (const auto& [travelled, coefficient] :
         {std::pair{-3.0, 0.3}, {0.3, 0.3}, {0.325, 0.175}, {0.34, 0.1}, {0.35, 0.05}, {9.0, 0.05}}) {
      locked.wheelset.x = travelled;
      const ContactReaction r = element.evaluate(locked);
      ASSERT_EQ(r.status, Status::ok);
      const double bound = coefficient * r.normal_force;
      EXPECT_NEAR(std::hypot(r.longitudinal_creep_force, r.lateral_creep_force), bound, 0.01 * bound) << travelled;
    }
  }
}

TEST(TableContact, StepsSeeAShortPlaceOfOtherFriction) {
  constexpr double kBegin = 0.48, kDeepest = 0.49, kEnd = 0.5, kRailX = 0.2;
  const FrictionAlong dip{{kBegin, kDeepest, kEnd}, {coulomb(0.3), coulomb(0.1), coulomb(0.3)}, kRailX};
  for (double start = 0.0; start < 0.3; start += 0.0031) {
    double x = start, least = 0.3;
    while (std::isfinite(dip.longest_travel(x)) && x < 1.0) {
      ASSERT_GT(dip.longest_travel(x), 0.0);
      x += dip.longest_travel(x);
      FrictionLaw law;
      dip.put(law, x);
      least = std::min(least, law.kinetic);
    }
    const bool ahead = start + kRailX < kDeepest;
    EXPECT_LE(ahead ? least : 0.0, 0.2 + 1e-12) << start;
  }
  // Places that no contact tells apart do not stop a vehicle.
  const FrictionAlong jump{{0.3, 0.3 + 1e-9, 1.0}, {coulomb(0.3), coulomb(0.1), coulomb(0.1)}};
  EXPECT_GE(jump.longest_travel(0.3 - 1e-9), 1e-3);

  PairMotion m = rolling(pressed(*standard_table(), 0.0, 1.2e-4));
  m.wheelset.x = 0.27;
  TableContact element(standard_table(), Side::right, nullptr, dip), other = element;
  element.evaluate(m);
  element.accept();
  EXPECT_NEAR(element.longest_travel(), 0.01 + 0.005, 1e-12);
  ByteWriter state;
  element.save(state);
  ByteReader in(state.bytes());
  other.restore(in);
  EXPECT_TRUE(in.at_end());
  EXPECT_EQ(other.longest_travel(), element.longest_travel());
  EXPECT_FALSE(std::isfinite(TableContact(standard_table(), Side::right).longest_travel()));
}

TEST(TableContact, WrongInputIsRefused) {
  EXPECT_THROW(TableContact(nullptr, Side::left), Error);
  const wheelrail::Problem good = standard_problem(0.025);
  const auto refused = [&](const wheelrail::Problem& p, double load, const ContactTableOptions& options,
                           bool round = true) {
    wheelrail::Geometry g = standard_geometry();
    g.round_wheel = round;
    EXPECT_THROW(build_contact_table(g, p, load, options), Error);
  };
  refused(good, 0.0, {});
  refused(good, kLoad, {}, false);
  refused(good, kLoad, {.step = -1e-3});
  refused(good, kLoad, {.relative_loads = {1.0, 0.5}});
  refused(good, kLoad, {.relative_loads = {}});
  refused(good, kLoad, {.relative_loads = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}, .heavier = {}});
  refused(good, kLoad, {.relative_loads = {0.3, 0.6, 1.0, 1.4, 2.0, 2.5}});
  wheelrail::Problem left = good, curved = good, far = good;
  left.side = Side::left;
  curved.track.curvature = 1e-3;
  far.track.gauge_width = 2.0;
  refused(left, kLoad, {});
  refused(curved, kLoad, {});
  refused(far, kLoad, {});
}

}  // namespace
}  // namespace treadmark::vehicle
