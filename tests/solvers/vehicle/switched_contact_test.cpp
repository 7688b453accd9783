// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/switched_contact.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hertz_spring.hpp"
#include "small_vehicles.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/vehicle/wheel_loop.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kWheelRadius = 0.46, kSideY = 0.75;

std::shared_ptr<FullContact> full_contact(double rail_x, std::vector<Squat> squats = {},
                                          kalker::Regime regime = kalker::Regime::steady) {
  SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  rail.defects.squats = std::move(squats);
  const SurfaceSpec wheel{Body::wheel, kWheelRadius, StandardProfile{"S1002"}, {}};
  wheelrail::Problem p;
  p.track.cant = 1.0 / 40.0;
  p.wheelset.nominal_radius = kWheelRadius;
  p.regime = regime;
  p.discretisation.dx = p.discretisation.ds = 1e-3;
  const bool prismatic = rail.defects.empty();
  return std::make_shared<FullContact>(
      wheelrail::Geometry{create_surface(rail), create_surface(wheel), prismatic, true}, p, rail_x);
}

PairMotion at(double x) {
  PairMotion m;
  m.time = x / 20.0;
  m.wheelset.x = x;
  m.wheelset.z = 2.8e-4;
  m.wheelset_velocity.x = 20.0;
  m.wheelset_velocity.pitch = -20.0 / kWheelRadius * 1.001;
  return m;
}

TEST(FullContact, PassesItsRailFromWhereItStands) {
  const std::vector<Squat> squats{{.length = 40e-3, .width = 40e-3, .depth = 0.1e-3, .x_center = 0.5, .y_center = 0.0}};
  const auto here = full_contact(0.5, squats), behind = full_contact(0.2, squats), none = full_contact(0.0);
  const ContactReaction in_dip = here->evaluate(at(0.0)), before = behind->evaluate(at(0.0)),
                        later = behind->evaluate(at(0.3)), sound = none->evaluate(at(0.0));
  EXPECT_NEAR(later.normal_force, in_dip.normal_force, 1e-9 * sound.normal_force);
  EXPECT_NEAR(before.normal_force, sound.normal_force, 1e-4 * sound.normal_force);
  EXPECT_LT(in_dip.normal_force, 0.9 * sound.normal_force);
}

class SwitchedContactTest : public ::testing::Test {
 protected:
  SwitchedContactTest() { stretch.from = 1.0, stretch.to = 1.2, stretch.rail_x = 0.4; }
  std::shared_ptr<FullContact> full = full_contact(0.0);
  std::shared_ptr<HertzSpring> table = std::make_shared<HertzSpring>(1e11, kSideY);
  FullStretch stretch;
};

TEST_F(SwitchedContactTest, IsEitherOfBothOutsideOfTheirTransition) {
  SwitchedContact both(full, table, stretch);
  const auto alone = full_contact(0.0);
  // 0.4 m ahead of where it is counted from.
  for (const double x : {0.0, 0.6, 0.8, 2.0})
    EXPECT_EQ(both.evaluate(at(x)).on_rail.force, HertzSpring(1e11, kSideY).evaluate(at(x)).on_rail.force) << x;
  for (const double x : {0.65, 0.7, 0.75})
    EXPECT_NEAR(both.evaluate(at(x)).normal_force, alone->evaluate(at(x)).normal_force, 1e-9 * 1e5) << x;
}

TEST_F(SwitchedContactTest, ForcesGoOverWithoutAJump) {
  SwitchedContact both(full, table, stretch);
  const double of_table = both.evaluate(at(0.5)).normal_force, of_full = both.evaluate(at(0.7)).normal_force;
  ASSERT_GT(std::abs(of_full - of_table), 0.01 * of_full) << "nothing to see";
  // Half-way in both, and never outside of either.
  EXPECT_NEAR(both.evaluate(at(0.625)).normal_force, 0.5 * (of_table + of_full), 1e-4 * of_full);
  double last = of_table, largest_step = 0.0;
  for (double x = 0.6; x <= 0.65; x += 0.001) {
    const ContactReaction r = both.evaluate(at(x));
    largest_step = std::max(largest_step, std::abs(r.normal_force - last));
    last = r.normal_force;
    EXPECT_NEAR(r.on_rail.force.z(), -r.on_wheelset.force.z(), 1e-9 * of_full);
  }
  // The steepest of 3 t^2 - 2 t^3 is 1.5.
  EXPECT_LT(largest_step, 1.6 * std::abs(of_full - of_table) / 50.0);
  EXPECT_NEAR(last, of_full, 0.01 * std::abs(of_full - of_table));
}

TEST_F(SwitchedContactTest, TransientRollingBeginsAnewInTheStretch) {
  const auto transient = full_contact(0.0, {}, kalker::Regime::transient);
  SwitchedContact both(transient, table, stretch);
  const auto accepted = [&](double x) {
    const ContactReaction r = both.evaluate(at(x));
    EXPECT_EQ(r.status, Status::ok) << r.message;
    both.accept();
    return r;
  };
  const ContactReaction first = accepted(0.7);
  EXPECT_TRUE(transient->holds(0.7 / 20.0));
  accepted(0.701);
  accepted(0.9);
  EXPECT_FALSE(transient->holds(0.9 / 20.0));
  EXPECT_EQ(table->instants, 1);
  // A step of 0.2 m would break the rule of transient rolling.
  EXPECT_EQ(accepted(0.7).on_rail.force, first.on_rail.force);
}

TEST_F(SwitchedContactTest, SavedStatesGoOn) {
  const auto make = [&] {
    return SwitchedContact(full_contact(0.0, {}, kalker::Regime::transient),
                           std::make_shared<HertzSpring>(1e11, kSideY), stretch);
  };
  SwitchedContact one = make(), other = make();
  for (const double x : {0.63, 0.631, 0.632}) one.evaluate(at(x)), one.accept();
  ByteWriter out;
  one.save(out);
  ByteReader in(out.bytes());
  other.restore(in);
  for (const double x : {0.633, 0.634}) {
    EXPECT_EQ(one.evaluate(at(x)).on_rail.force, other.evaluate(at(x)).on_rail.force);
    one.accept(), other.accept();
  }
  ByteWriter of_one, of_other;
  one.save(of_one), other.save(of_other);
  EXPECT_EQ(of_one.bytes(), of_other.bytes());
}

TEST_F(SwitchedContactTest, StretchesThatAreTooShortAreRefused) {
  stretch.to = stretch.from + 1.5 * stretch.blend;
  EXPECT_THROW(SwitchedContact(full, table, stretch), Error);
  stretch.to = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(SwitchedContact(full, table, stretch));
  EXPECT_THROW(SwitchedContact(nullptr, table, stretch), Error);
}

/// Worth a thread of its own, and fails if told.
class CostlySpring : public HertzSpring {
 public:
  using HertzSpring::HertzSpring;
  bool costly() const override { return true; }
  ContactReaction evaluate(const PairMotion& m) override {
    if (!failure.empty()) throw Error(ErrorKind::numerical, failure);
    return HertzSpring::evaluate(m);
  }
  std::string failure;
};

TEST(WheelLoop, ThreadsChangeNothing) {
  VehicleOnTrack v = on_hertz_springs(wheel_on_mass(1800, 9000, 2e6, 4e3), rails_on_springs(100, 5e7, 1e5), 20.0, 1e11);
  std::vector<std::shared_ptr<CostlySpring>> springs;
  SystemState state{0.0, Vector::Zero(v.system.size()), Vector::Zero(v.system.size())};
  state.q[v.system.wheelsets[0].coordinate[2]] = 1e-4;
  const std::vector<ContactReaction> cheap = evaluate_wheels(v, state);
  for (WheelOnRail& wheel : v.wheels) {
    springs.push_back(std::make_shared<CostlySpring>(1e11, wheel.rail_marker.y()));
    wheel.element = springs.back();
  }
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const std::vector<ContactReaction> costly = evaluate_wheels(v, state);
    for (std::size_t i = 0; i < cheap.size(); ++i) {
      EXPECT_GT(cheap[i].normal_force, 0.0);
      EXPECT_EQ(costly[i].on_rail.force, cheap[i].on_rail.force);
    }
    // Of several errors always the same one.
    springs[0]->failure = "left", springs[1]->failure = "right";
    try {
      evaluate_wheels(v, state);
      ADD_FAILURE() << "no error";
    } catch (const Error& e) {
      EXPECT_EQ(e.message(), "left");
    }
    for (const auto& spring : springs) spring->failure.clear();
  }
}

}  // namespace
}  // namespace treadmark::vehicle
