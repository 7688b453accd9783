// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/force_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/vehicle/contacts/cubic_weights.hpp"
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {
namespace {

using wheelrail::Side;

constexpr double kRolling = 0.46, kForward = 20.0, kCarried = 8e4;

wheelrail::Geometry tabulated_bodies() {
  static const wheelrail::Geometry bodies{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
                                          analytic::make_standard_surface({"S1002"}, Body::wheel, kRolling), true,
                                          true};
  return bodies;
}

wheelrail::Problem tabulated_problem() {
  wheelrail::Problem p;
  p.track.cant = 1.0 / 40.0;
  p.discretisation.dx = p.discretisation.ds = 0.5e-3;
  return p;
}

/// On the tread, coarse.
const std::shared_ptr<const ContactTable>& turned_table() {
  static const auto table = build_contact_table(tabulated_bodies(), tabulated_problem(), kCarried,
                                                {.lateral_range = 3e-3,
                                                 .growth = 0.0,
                                                 .step = 0.5e-3,
                                                 .relative_loads = {0.4, 1.0, 2.0},
                                                 .heavier = {},
                                                 .roll = {6e-3, 4},
                                                 .yaw = {12e-3, 2}});
  return table;
}

ForceTable tread_forces(Side side = Side::right) { return {turned_table(), side, nullptr}; }

WheelMotion running(double y, double roll, double yaw, double load) {
  WheelMotion w;
  const Vec3 arm = turned_table()->nominal().X_TW.origin - turned_table()->nominal().X_TWs.origin;
  w.motion.wheelset.y = y - (rotation_x(roll) * rotation_z(yaw) * arm - arm).y();
  w.motion.wheelset.roll = roll, w.motion.wheelset.yaw = yaw;
  w.motion.wheelset_velocity.x = kForward;
  w.motion.wheelset_velocity.y = kForward * yaw;
  w.motion.wheelset_velocity.pitch = -1.001 * kForward / kRolling;
  w.vertical_load = load;
  return w;
}

TEST(NodeWeights, ParabolasAreExactAndEvenFunctionsStayEven) {
  const auto sum = [](const NodeWeights& w, auto f) {
    double value = 0.0, slope = 0.0;
    for (int i = 0; i < w.count; ++i) {
      value += w.value[static_cast<std::size_t>(i)] * f(w.first + i);
      slope += w.slope[static_cast<std::size_t>(i)] * f(w.first + i);
    }
    return std::pair(value, slope);
  };
  for (const int last : {2, 3, 7})
    for (double x = 0.0; x <= last; x += 0.13) {
      const auto [value, slope] = sum(node_weights(x, last, false), [](int i) { return 2.0 - 3.0 * i + 0.7 * i * i; });
      EXPECT_NEAR(value, 2.0 - 3.0 * x + 0.7 * x * x, 1e-12);
      EXPECT_NEAR(slope, -3.0 + 1.4 * x, 1e-12);
    }
  for (const int last : {1, 2, 5})
    for (double x = 0.0; x <= last; x += 0.13) {
      const auto [value, slope] = sum(node_weights(x, last, true), [](int i) { return 2.0 + 0.7 * i * i; });
      EXPECT_NEAR(value, 2.0 + 0.7 * x * x, 1e-12);
      EXPECT_NEAR(slope, 1.4 * x, 1e-12);
    }
  EXPECT_EQ(node_weights(0.4, 0, false).value[0], 1.0);
}

TEST(ForceTable, ErrorsAreAsStatedAtOtherPoints) {
  const ForceTable table = tread_forces();
  const TableCheck stated = check_table(table, tabulated_bodies(), tabulated_problem(), {.points = 60, .seed = 1});
  ASSERT_EQ(stated.errors.size(), 6u);
  EXPECT_EQ(stated.compared, 60);
  EXPECT_NEAR(stated.beyond, 1.0 - std::pow(0.01, 1.0 / 60.0), 1e-12);
  const TableCheck others = check_table(table, tabulated_bodies(), tabulated_problem(), {.points = 40, .seed = 77});
  for (const TableError& error : others.errors) {
    const TableError& bound = stated.of(error.number);
    constexpr double kBeyond = 1.5;  // of 60 points a few of a hundred may lie above the worst one
    EXPECT_LT(error.worst, kBeyond * bound.worst) << error.number;
    EXPECT_LT(error.rms, bound.worst) << error.number;
    EXPECT_GT(error.worst, 0.0) << error.number;
  }
  // What a table with rolls 3 mrad apart is good for; twice as far they make it six times worse.
  EXPECT_LT(stated.of("z").worst, 2e-6);
  EXPECT_LT(stated.of("normal_force").rms, 0.02);
  EXPECT_LT(stated.of("fy").rms, 0.02);
  EXPECT_THROW(stated.of("nothing"), Error);
}

TEST(ForceTable, AtANodeTheWheelStandsWhereItWasSolved) {
  wheelrail::Problem p = table_problem(tabulated_problem());
  for (const double roll : {-6e-3, 0.0, 6e-3})
    for (const double yaw : {0.0, -6e-3, 12e-3}) {
      const WheelMotion w = running(1e-3, roll, yaw, kCarried);
      p.state.position = w.motion.wheelset;
      p.vertical_force = kCarried;
      wheelrail::Pair pair(tabulated_bodies());
      const wheelrail::PairSolution s = pair.solve(p);
      ASSERT_EQ(s.status, Status::ok);
      const RelativePlace place{1e-3, 0.0, roll, yaw};
      const Vec3 moved = s.placement.X_TW.origin - turned_table()->nominal().X_TW.origin;
      const LocalContact local(*turned_table(), place);
      ASSERT_TRUE(local.covered());
      EXPECT_NEAR(local.height_under_load(kCarried), moved.z(),
                  1e-8);  // forces are balanced to 1e-5 of an approach of 70 um, both times
    }
}

TEST(ForceTable, ForcesAreTheGradientOfTheEnergy) {
  const ContactTable& table = *turned_table();
  Random random(5);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  for (int i = 0; i < 60; ++i) {
    RelativePlace at{between(-2.5e-3, 2.5e-3), 0.0, between(-5e-3, 5e-3), between(-10e-3, 10e-3)};
    at.z = LocalContact(table, at).height_under_load(between(2e4, 1.5e5));
    const ElasticContact c = elastic_contact(table, at);
    ASSERT_GT(c.normal_force, 0.0);
    const double upright = 1.0 / std::sqrt(1.0 + c.slope * c.slope), vertical = c.normal_force * upright;
    const auto energy = [&](double dy, double dz, double droll) {
      RelativePlace moved = at;
      moved.y += dy, moved.z += dz, moved.roll += droll;
      return elastic_contact(table, moved).energy;
    };
    constexpr double kStep = 1e-8, kTurn = 1e-8;
    EXPECT_NEAR((energy(0.0, kStep, 0.0) - energy(0.0, -kStep, 0.0)) / (2.0 * kStep), vertical, 1e-5 * vertical);
    // Down the slope the wheel sinks without force.
    EXPECT_NEAR((energy(kStep, 0.0, 0.0) - energy(-kStep, 0.0, 0.0)) / (2.0 * kStep), -vertical * c.slope,
                1e-4 * vertical);
    EXPECT_NEAR((energy(0.0, 0.0, kTurn) - energy(0.0, 0.0, -kTurn)) / (2.0 * kTurn),
                vertical * (c.arm_y + c.slope * c.arm_z), 1e-5 * vertical);
  }
}

// Across the nodes of roll, yaw and lateral place: with twice as many steps each is half as high, where a jump would
// stay.
TEST(ForceTable, ForcesRunWithoutJumps) {
  ForceTable table = tread_forces();
  const auto force = [&](double y, double roll, double yaw) {
    const WheelForces f = table.at(running(y, roll, yaw, kCarried));
    EXPECT_EQ(f.reaction.status, Status::ok) << f.reaction.message;
    return Vec3(f.reaction.longitudinal_creep_force, f.reaction.on_rail.force.y(), f.reaction.normal_force);
  };
  const auto greatest_step = [](auto at, double from, double to, int steps) {
    double greatest = 0.0;
    Vec3 before = at(from);
    for (int i = 1; i <= steps; ++i) {
      const Vec3 here = at(from + (to - from) * i / steps);
      greatest = std::max(greatest, (here - before).norm());
      before = here;
    }
    return greatest;
  };
  const auto runs = [&](auto at, double from, double to) {
    const double coarse = greatest_step(at, from, to, 400), fine = greatest_step(at, from, to, 800);
    EXPECT_LT(fine, 0.7 * coarse);
    EXPECT_LT(coarse, 0.05 * kCarried);
  };
  runs([&](double roll) { return force(0.3e-3, roll, 4e-3); }, -6e-3, 6e-3);
  runs([&](double yaw) { return force(0.3e-3, 2e-3, yaw); }, -12e-3, 12e-3);
  runs([&](double y) { return force(y, 2e-3, 4e-3); }, -2.7e-3, 2.7e-3);
}

TEST(ForceTable, SheetsGrowAsTheUprightOneDoes) {
  const auto table = build_contact_table(tabulated_bodies(), tabulated_problem(), kCarried,
                                         {.lateral_range = 2e-3,
                                          .growth = 2e-3,
                                          .step = 1e-3,
                                          .element_size = 1e-3,
                                          .relative_loads = {1.0},
                                          .heavier = {3.0},
                                          .roll = {4e-3, 2}});
  EXPECT_EQ(table->most_load(), 3.0 * kCarried);
  const LocalContact local(*table, {3e-3, 0.0, 1.5e-3, 0.0});
  ASSERT_TRUE(local.covered());
  for (const double load : {0.5 * kCarried, 2.0 * kCarried}) {
    const ElasticContact c = local.at(local.height_under_load(load));
    EXPECT_NEAR(c.normal_force / std::sqrt(1.0 + c.slope * c.slope), load, 1e-9 * load);
    double weights = 0.0;
    for (std::size_t i = 0; i < c.count; ++i)
      if (c.parts[i].strongest) weights += c.parts[i].weight;
    EXPECT_NEAR(weights, 1.0, 1e-12) << "of both sheets beside the place";
    EXPECT_GT(c.count, 1u);
  }
}

TEST(ForceTable, AGivenLoadAndItsHeightBelongTogether) {
  ForceTable table = tread_forces();
  for (const double y : {-2e-3, 0.0, 2.1e-3}) {
    const WheelMotion loaded = running(y, 3e-3, -7e-3, 0.9 * kCarried);
    const WheelForces found = table.at(loaded);
    ASSERT_EQ(found.reaction.status, Status::ok);
    EXPECT_NEAR(found.reaction.on_rail.force.z(), 0.9 * kCarried, 1e-6 * kCarried);
    WheelMotion elsewhere = loaded;
    elsewhere.motion.wheelset.z = 0.7;
    EXPECT_EQ(table.at(elsewhere).z, found.z) << "a given height does not count";
    WheelMotion at_height = loaded;
    at_height.vertical_load = 0.0;
    at_height.motion.wheelset.z = found.z;
    const WheelForces again = table.at(at_height);
    EXPECT_NEAR(again.reaction.on_rail.force.z(), found.reaction.on_rail.force.z(), 1e-9 * kCarried);
    EXPECT_EQ(again.t_gamma, found.t_gamma);
    EXPECT_NEAR(found.t_gamma, found.reaction.frictional_power / kForward, 1e-12);
  }
}

TEST(ForceTable, NothingIsExtrapolated) {
  ForceTable table = tread_forces();
  const auto refused = [&](const WheelMotion& w, const char* why) {
    const WheelForces f = table.at(w);
    EXPECT_EQ(f.reaction.status, Status::failed);
    EXPECT_NE(f.reaction.message.find(why), std::string::npos) << f.reaction.message;
    for (const auto& column : columns<WheelForces>()) EXPECT_TRUE(std::isnan(column.access.get(f))) << column.stored;
    EXPECT_FALSE(f.reaction.derailed);
  };
  refused(running(4e-3, 0.0, 0.0, kCarried), "aside");
  refused(running(0.0, 7e-3, 0.0, kCarried), "rolls");
  refused(running(0.0, 0.0, -13e-3, kCarried), "yawed");
  refused(running(0.0, 0.0, 0.0, 2.1 * kCarried), "presses");
  WheelMotion deep = running(0.0, 0.0, 0.0, 0.0);
  deep.motion.wheelset.z = 5e-3;
  refused(deep, "presses");
  deep.motion.wheelset.z = -5e-3;
  EXPECT_EQ(table.at(deep).reaction.status, Status::no_contact);
  for (const auto& column : columns<WheelForces>())
    EXPECT_TRUE(std::isfinite(column.access.get(table.at(deep)))) << column.stored;
  deep.vertical_load = -1.0;
  EXPECT_THROW(table.at(deep), Error);
  deep.vertical_load = 0.0, deep.motion.wheelset.y = std::nan("");
  EXPECT_THROW(table.at(deep), Error);
}

TEST(ForceTable, MotionsWithoutForcesGiveAStatusAndNoNumbers) {
  using wheelrail::SixMotion;
  const auto creep = build_creep_table(combine(tabulated_problem().material).poisson, {2, 2, 4.0, 8, 6});
  for (const auto& creep_forces : {std::shared_ptr<const CreepTable>(), creep}) {
    ForceTable table(turned_table(), Side::right, creep_forces);
    for (const double load : {0.0, kCarried})
      for (const double rate : {1e-300, 1e10, 1e100, 1e200, 1e307})
        for (double SixMotion::*member :
             {&SixMotion::x, &SixMotion::y, &SixMotion::z, &SixMotion::roll, &SixMotion::yaw, &SixMotion::pitch}) {
          WheelMotion w = running(0.3e-3, 1e-3, 2e-3, kCarried);
          w.motion.wheelset.z = table.at(w).z;
          w.vertical_load = load;
          w.motion.wheelset_velocity.*member = rate;
          const WheelForces f = table.at(w);
          for (const auto& column : columns<WheelForces>())
            EXPECT_EQ(std::isfinite(column.access.get(f)), f.reaction.status == Status::ok)
                << column.stored << " at a rate of " << rate << ": " << f.reaction.message;
        }
    WheelMotion dragged = running(0.3e-3, 0.0, 0.0, kCarried);
    dragged.motion.wheelset_velocity = {};
    dragged.motion.wheelset_velocity.y = 1.0;
    const WheelForces f = table.at(dragged);
    EXPECT_EQ(f.reaction.status, Status::failed);
    EXPECT_NE(f.reaction.message.find("does not roll"), std::string::npos) << f.reaction.message;
    EXPECT_TRUE(std::isnan(f.reaction.normal_force));
  }
}

/// Between two sheets alike and beside one that is 20 times as soft the parabola has nothing left.
TEST(ForceTable, SheetsThatDifferTooMuchGiveNoAnswer) {
  const auto sheet = [](double energy) {
    const ContactUnderLoad contact{1e-4, energy, 0.0, 0.0, 0.4, {{1.0, 0.0, 0.0, 0.4, 1e-4, 0.0}}};
    return ContactTableColumns{{-5e-3, {contact}}, {5e-3, {contact}}};
  };
  const auto table = std::make_shared<const ContactTable>(
      std::vector<ContactTableColumns>{sheet(1.0), sheet(1.0), sheet(20.0)}, ContactTable::Loads{{kCarried}},
      wheelrail::Problem{}, wheelrail::Placement{}, TableAngles{4e-3, 2});
  ForceTable forces(table, Side::right, nullptr);
  WheelMotion w;
  w.motion.wheelset.roll = -2e-3;
  w.motion.wheelset_velocity.x = kForward, w.motion.wheelset_velocity.pitch = -kForward / kRolling;
  for (const double load : {0.0, kCarried}) {
    w.motion.wheelset.z = 1e-3;
    w.vertical_load = load;
    const WheelForces f = forces.at(w);
    EXPECT_EQ(f.reaction.status, Status::failed);
    EXPECT_NE(f.reaction.message.find("too much"), std::string::npos) << f.reaction.message;
    EXPECT_TRUE(std::isnan(f.reaction.normal_force));
  }
}

/// Points without a number spoil neither the worst nor the mean: they were not solved.
TEST(ForceTable, ErrorsThatAreNoNumbersAreNotCounted) {
  const auto point = [](double error, bool solved, bool answered) {
    CheckedPoint p{1e-3 * error, 0.0, 0.0, 1e5, solved, answered, {}};
    p.error.fill(error);
    return p;
  };
  std::vector<CheckedPoint> points = {point(0.3, true, true), point(-0.4, true, true), point(0.9, true, false),
                                      point(0.9, false, false)};
  const TableCheck clean = table_check_of({}, points);
  EXPECT_EQ(clean.compared, 2);
  EXPECT_EQ(clean.unanswered, 1);
  EXPECT_EQ(clean.unsolved, 1);
  constexpr double kHuge = 1e200;  // its square is none
  for (const double none : {kNaN, std::numeric_limits<double>::infinity(), kHuge})
    for (std::size_t number = 0; number < CheckedPoint::kNumbers; ++number)
      for (const std::size_t at : {std::size_t{0}, std::size_t{1}, points.size()}) {
        std::vector<CheckedPoint> with = points;
        with.insert(with.begin() + static_cast<std::ptrdiff_t>(at), point(0.1, true, true))->error[number] = none;
        const TableCheck check = table_check_of({}, with);
        EXPECT_EQ(check.compared, 2);
        EXPECT_EQ(check.unsolved, 2);
        for (const TableError& error : check.errors) {
          EXPECT_EQ(error.worst, 0.4);
          EXPECT_EQ(error.y, -0.4e-3);
          EXPECT_NEAR(error.rms, std::sqrt(0.5 * (0.09 + 0.16)), 1e-15);
        }
      }
  EXPECT_THROW(table_check_of({}, {point(kNaN, true, true)}), Error);
}

TEST(ForceTable, TheLeftWheelIsTheMirrorImage) {
  ForceTable right = tread_forces(), left = tread_forces(Side::left);
  const WheelMotion w = running(1.2e-3, 2e-3, 5e-3, kCarried);
  WheelMotion m = w;
  for (wheelrail::SixMotion* q : {&m.motion.wheelset, &m.motion.wheelset_velocity})
    q->y = -q->y, q->roll = -q->roll, q->yaw = -q->yaw;
  const WheelForces a = right.at(w), b = left.at(m);
  EXPECT_EQ(a.reaction.on_rail.force.x(), b.reaction.on_rail.force.x());
  EXPECT_EQ(a.reaction.on_rail.force.y(), -b.reaction.on_rail.force.y());
  EXPECT_EQ(a.reaction.spin_moment, -b.reaction.spin_moment);
  EXPECT_NEAR(a.contact_angle, -b.contact_angle, 1e-15);
  EXPECT_EQ(a.z, b.z);
}

TEST(ForceTable, TheComparisonDoesNotDependOnThreads) {
  const auto checked = [](int threads) {
    const ThreadLimit limit(threads);
    return check_table(tread_forces(), tabulated_bodies(), tabulated_problem(), {.points = 12, .seed = 3});
  };
  const TableCheck one = checked(1), two = checked(2);
  for (const TableError& error : one.errors) {
    EXPECT_EQ(error.worst, two.of(error.number).worst);
    EXPECT_EQ(error.rms, two.of(error.number).rms);
  }
}

TEST(ForceTable, OptionsWithoutMeaningAreRefused) {
  const auto check_with = [](const TableCheckOptions& o) {
    return check_table(tread_forces(), tabulated_bodies(), tabulated_problem(), o);
  };
  EXPECT_THROW(check_with({.points = 0}), Error);
  EXPECT_THROW(check_with({.points = 1, .speed = 0.0}), Error);
  EXPECT_THROW(check_with({.points = 1, .creepage = 1.0}), Error);
  EXPECT_THROW(build_contact_table(tabulated_bodies(), tabulated_problem(), kCarried, {.roll = {5e-3, 1}}), Error);
  EXPECT_THROW(build_contact_table(tabulated_bodies(), tabulated_problem(), kCarried, {.yaw = {0.5, 2}}), Error);
}

TEST(ForceTable, EveryNumberHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const auto& column : columns<WheelMotion>()) EXPECT_TRUE(names.insert(column.stored).second) << column.stored;
  names.clear();
  for (const auto& column : columns<WheelForces>()) EXPECT_TRUE(names.insert(column.stored).second) << column.stored;
  WheelMotion w;
  double value = 1.0;
  for (const auto& column : columns<WheelMotion>()) column.access.put(w, value++);
  value = 1.0;
  for (const auto& column : columns<WheelMotion>()) EXPECT_EQ(column.access.get(w), value++) << column.stored;
}

}  // namespace
}  // namespace treadmark::vehicle
