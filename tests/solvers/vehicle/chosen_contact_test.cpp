// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/chosen_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kRound = 0.46, kRunning = 20.0;  // [m], [m/s]
constexpr double kWrongFrom = 1e-3;               // where the table is wrong [m]

std::shared_ptr<FullContact> round_contact() {
  wheelrail::Problem p;
  p.track.cant = 1.0 / 40.0;
  p.wheelset.nominal_radius = kRound;
  p.regime = kalker::Regime::steady;
  p.discretisation.dx = p.discretisation.ds = 1e-3;
  return std::make_shared<FullContact>(
      wheelrail::Geometry{create_surface({Body::rail, 0.0, StandardProfile{"60E1"}, {}}),
                          create_surface({Body::wheel, kRound, StandardProfile{"S1002"}, {}}), true, true},
      p);
}

PairMotion running_at(double x, double y = 0.0) {
  PairMotion m;
  m.time = x / kRunning;
  m.wheelset.x = x;
  m.wheelset.y = y;
  m.wheelset.z = 2.8e-4;
  m.wheelset_velocity.x = kRunning;
  m.wheelset_velocity.pitch = -kRunning / kRound * 1.001;
  return m;
}

/// Of forces, over the load, of one contact solved from different starts.
constexpr double kSolver = 1e-4;

/// The full contact, but for errors that are known: its forces on the rail, at equal normal force, are 10 % too large
/// where the wheel stands aside; it may have no solution.
class KnownTable : public ContactElement {
 public:
  static constexpr double kError = 0.1;
  ContactReaction evaluate(const PairMotion& m) override {
    ContactReaction r = full_->evaluate(m);
    if (m.wheelset.x >= ends) r.status = Status::failed;
    if (std::abs(m.wheelset.y) > kWrongFrom) r.on_rail.force *= 1.0 + kError;
    return r;
  }
  void accept() override { ++accepted; }
  void save(ByteWriter& out) const override { out.put(accepted); }
  void restore(ByteReader& in) override { in.get(accepted); }

  double ends = std::numeric_limits<double>::infinity();
  int accepted = 0;

 private:
  std::shared_ptr<FullContact> full_ = round_contact();
};

class ChosenContactTest : public ::testing::Test {
 protected:
  ChosenContactTest() { settings.usual_load = 5e4; }

  ChosenContact chosen() const { return ChosenContact(round_contact(), table, settings); }
  /// Goes to x in steps of 10 mm, aside where told to; the reaction of the last one.
  ContactReaction run(ChosenContact& contact, double from, double to, double y) const {
    ContactReaction last;
    for (double x = from; x < to + 1e-9; x += 0.01) {
      last = contact.evaluate(running_at(x, y));
      EXPECT_FALSE(is_unsolved(last)) << x << ": " << last.message;
      contact.accept();
    }
    return last;
  }

  std::shared_ptr<KnownTable> table = std::make_shared<KnownTable>();
  ChoiceSettings settings;
};

TEST(TableDeviation, CountsForcesAtEqualLoadAndHalfOfTheLoad) {
  ContactReaction table, full;
  full.normal_force = 1e5;
  full.on_rail.force = {0.0, 1e4, 1e5};
  full.frictional_power = 20.0 * 100.0;  // a wear number of 100 N
  table = full;
  EXPECT_EQ(table_error(table, full, 20.0, 5e3).force, 0.0);
  // The same in all but the load.
  table.normal_force *= 1.08, table.on_rail.force *= 1.08, table.frictional_power *= 1.08;
  EXPECT_NEAR(table_error(table, full, 20.0, 5e3).force, 0.04, 1e-12);
  EXPECT_NEAR(table_error(table, full, 20.0, 5e3).wear, 0.0, 1e-12);
  table = full;
  table.on_rail.force.y() += 2e3;
  table.frictional_power *= 0.75;
  EXPECT_NEAR(table_error(table, full, 20.0, 5e3).force, 0.02, 1e-12);
  EXPECT_NEAR(table_error(table, full, 20.0, 5e3).wear, 0.25, 1e-12);
  // Little wear counts as 0.0003 of the load, 30 N.
  full.frictional_power = 20.0 * 3.0, table.frictional_power = 20.0 * 6.0;
  EXPECT_NEAR(table_error(table, full, 20.0, 5e3).wear, 0.1, 1e-12);
  // Nearly off the rail a tenth of the usual load counts.
  full.normal_force = 100.0, full.on_rail.force = {0.0, 0.0, 100.0};
  table.normal_force = 0.0, table.on_rail.force.setZero();
  EXPECT_NEAR(table_error(table, full, 20.0, 5e3).force, 0.02, 1e-12);
}

TEST_F(ChosenContactTest, IsTheTableUntilItBegins) {
  ChosenContact contact = chosen();
  const ContactReaction r = run(contact, 0.0, 0.2, 2.0 * kWrongFrom);
  EXPECT_EQ(r.full_share, 0.0);
  EXPECT_EQ(r.on_rail.force, table->evaluate(running_at(0.2, 2.0 * kWrongFrom)).on_rail.force);
  EXPECT_FALSE(contact.costly());
  EXPECT_EQ(contact.longest_travel(), std::numeric_limits<double>::infinity());
}

TEST_F(ChosenContactTest, StaysWithATableThatAgrees) {
  ChosenContact contact = chosen();
  contact.begin();
  const ContactReaction r = run(contact, 0.0, 0.2, 0.0);
  EXPECT_EQ(r.full_share, 0.0);
  EXPECT_LT(r.table_error, kSolver);
  EXPECT_EQ(contact.longest_travel(), std::numeric_limits<double>::infinity());
}

/// Where the wheel stands aside the table is wrong by what is known; forces go over within 50 mm, and back once the
/// table has been right over half a metre.
TEST_F(ChosenContactTest, GoesOverWhereTheTableIsWrongAndBackWhenItIsNot) {
  ChosenContact contact = chosen();
  contact.begin();
  run(contact, 0.0, 0.1, 0.0);
  ContactReaction r = run(contact, 0.11, 0.11, 2.0 * kWrongFrom);  // found out at its end
  EXPECT_EQ(r.full_share, 0.0);
  EXPECT_EQ(contact.longest_travel(), settings.full_travel);
  EXPECT_TRUE(contact.costly());
  double before = 0.0;
  for (double x = 0.12; x < 0.175; x += 0.01) {
    r = run(contact, x, x, 2.0 * kWrongFrom);
    EXPECT_GE(r.full_share, before);
    before = r.full_share;
    const ContactReaction full = round_contact()->evaluate(running_at(x, 2.0 * kWrongFrom));
    EXPECT_NEAR(r.table_error, KnownTable::kError * full.on_rail.force.norm() / full.normal_force, kSolver);
    // The table is 10 % more, and the forces of both are mixed.
    EXPECT_NEAR(r.on_rail.force.norm(), (1.0 + KnownTable::kError * (1.0 - r.full_share)) * full.on_rail.force.norm(),
                kSolver * full.normal_force);
  }
  EXPECT_EQ(r.full_share, 1.0);
  r = run(contact, 0.18, 0.6, 0.0);
  EXPECT_EQ(r.full_share, 1.0) << "it waits";
  r = run(contact, 0.61, 0.8, 0.0);
  EXPECT_EQ(r.full_share, 0.0);
  EXPECT_FALSE(contact.costly());
  // Known by now.
  r = run(contact, 0.81, 0.82, 2.0 * kWrongFrom);
  EXPECT_GT(r.full_share, 0.0);
}

TEST_F(ChosenContactTest, AMotionBetweenWithinAndBeyondTheToleranceDoesNotChatter) {
  ChosenContact contact = chosen();
  contact.begin();
  int changes = 0;
  bool full = false;
  for (int i = 0; i < 150; ++i) {
    const double x = 0.01 * i;
    const ContactReaction r = run(contact, x, x, i % 2 == 0 ? 0.0 : 2.0 * kWrongFrom);
    changes += (r.full_share > 0.5) != full;
    full = r.full_share > 0.5;
  }
  EXPECT_EQ(changes, 1);
}

TEST_F(ChosenContactTest, ToleratesWhatItIsTold) {
  settings.tolerance.force = 0.2;
  ChosenContact contact = chosen();
  contact.begin();
  const ContactReaction r = run(contact, 0.0, 0.2, 2.0 * kWrongFrom);
  EXPECT_EQ(r.full_share, 0.0);
  EXPECT_GT(r.table_error, 0.09);
}

TEST_F(ChosenContactTest, TheFullContactTakesThePlaceOfATableWithoutSolution) {
  table->ends = 0.105;
  ChosenContact contact = chosen();
  contact.begin();
  run(contact, 0.0, 0.1, 0.0);
  const ContactReaction r = run(contact, 0.11, 0.13, 0.0);
  EXPECT_EQ(r.full_share, 1.0);
  const ContactReaction full = round_contact()->evaluate(running_at(0.13));
  EXPECT_LT((r.on_rail.force - full.on_rail.force).norm(), kSolver * full.normal_force);
}

TEST_F(ChosenContactTest, IsFullWhereTheRailIsAnotherOne) {
  settings.rail_x = 5.0;
  settings.always_full = {{5.3, 5.4}};
  ChosenContact contact = chosen();
  contact.begin();
  run(contact, 0.0, 0.1, 0.0);
  EXPECT_NEAR(contact.longest_travel(), 0.3 - 0.075 - 0.1, 1e-9);
  EXPECT_EQ(run(contact, 0.11, 0.22, 0.0).full_share, 0.0);
  EXPECT_EQ(run(contact, 0.23, 0.3, 0.0).full_share, 1.0);
  EXPECT_EQ(run(contact, 0.31, 0.85, 0.0).full_share, 1.0);
  EXPECT_EQ(run(contact, 0.86, 1.0, 0.0).full_share, 0.0);
  settings.always_full = {{4.9, 5.1}};
  ChosenContact within = chosen();
  within.begin();
  EXPECT_EQ(within.evaluate(running_at(0.0)).full_share, 1.0);
}

TEST_F(ChosenContactTest, StaysFullWhereTheWayToTheNextSuchPlaceIsTooShort) {
  settings.rail_x = 5.0;
  settings.always_full = {{4.9, 5.1}, {5.7, 5.8}};
  ChosenContact contact = chosen();
  contact.begin();
  run(contact, 0.0, 0.59, 0.0);
  for (const double x : {0.6, 0.62, 0.64, 0.66, 0.7}) EXPECT_EQ(run(contact, x, x, 0.0).full_share, 1.0) << x;
}

TEST_F(ChosenContactTest, SavedStatesGoOn) {
  ChosenContact one = chosen();
  one.begin();
  run(one, 0.0, 0.1, 0.0);
  run(one, 0.11, 0.13, 2.0 * kWrongFrom);
  ByteWriter out;
  one.save(out);
  table = std::make_shared<KnownTable>();
  ChosenContact other = chosen();
  ByteReader in(out.bytes());
  other.restore(in);
  EXPECT_TRUE(in.at_end());
  for (const double x : {0.14, 0.15, 0.16, 0.17}) {
    EXPECT_EQ(run(one, x, x, 2.0 * kWrongFrom).on_rail.force, run(other, x, x, 2.0 * kWrongFrom).on_rail.force);
    ByteWriter of_one, of_other;
    one.save(of_one), other.save(of_other);
    EXPECT_EQ(of_one.bytes(), of_other.bytes()) << x;
  }
}

TEST_F(ChosenContactTest, BadSettingsAreRefused) {
  EXPECT_THROW(ChosenContact(nullptr, table, settings), Error);
  EXPECT_THROW(ChosenContact(round_contact(), nullptr, settings), Error);
  settings.tolerance.wear = 0.0;
  EXPECT_THROW(chosen(), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
