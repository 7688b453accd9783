// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/wheelrail_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/app/cases/case_sequence.hpp"
#include "treadmark/app/cases/contact_program/element_table.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"

namespace treadmark::app {
namespace {

using ::testing::ElementsAre;

TEST(ToProblem, CarriesEverySetting) {
  io::WheelRailCase c;
  c.roller = {-0.5, 12.0};
  c.longitudinal_force = -3e3;
  c.rail_springs = RailSprings{1e5, 2e5, 3.0, 4.0, 5e-4};
  c.damping = Damping{1e-4, 2e-4, 3e6, 4e6};
  c.regime = Regime::transient;
  c.history = HistoryUse::keep_going;
  c.reference_surface = ReferenceSurface::curved;
  c.influence.kind = io::InfluenceInput::Kind::angle_corrected;
  c.influence.variant = 2;
  c.thermal.emplace().plastic_fraction = 0.5;
  c.sensitivities = true;
  c.material.layer_yield = 30e6;
  const wheelrail::Problem p = to_problem(c, false);
  EXPECT_EQ(p.roller.value().nominal_radius, -0.5);
  EXPECT_EQ(p.roller.value().pitch_rate, 12.0);
  EXPECT_EQ(p.longitudinal_force, std::optional(-3e3));
  const wheelrail::RailSprings s = p.rail_springs.value();
  EXPECT_THAT((std::vector{s.stiffness_y, s.stiffness_z, s.force_y, s.force_z, s.first_step_y}),
              ElementsAre(1e5, 2e5, 3.0, 4.0, 5e-4));
  const wheelrail::Damping d = p.damping.value();
  EXPECT_THAT((std::vector{d.normal, d.tangential, d.max_rate_normal, d.max_rate_tangential}),
              ElementsAre(1e-4, 2e-4, 3e6, 4e6));
  EXPECT_EQ(p.regime, kalker::Regime::transient);
  EXPECT_EQ(p.history, kalker::HistoryUse::keep_going);
  EXPECT_EQ(p.reference_surface, wheelrail::ReferenceSurface::curved);
  EXPECT_EQ(p.influence.kind, kalker::InfluenceSettings::Kind::angle_corrected);
  EXPECT_EQ(p.influence.variant, 2);
  EXPECT_EQ(p.thermal.value().plastic_fraction, 0.5);
  EXPECT_TRUE(p.sensitivities);
  EXPECT_EQ(p.material.layer_yield, 30e6);
  const wheelrail::Problem plain = to_problem({}, true);
  EXPECT_FALSE(plain.roller || plain.longitudinal_force || plain.rail_springs || plain.damping || plain.thermal ||
               plain.sensitivities);
  EXPECT_EQ(plain.regime, kalker::Regime::steady);
  EXPECT_EQ(plain.reference_surface, wheelrail::ReferenceSurface::plane);
}

TEST(ToProblem, RegimesAndHistories) {
  io::WheelRailCase c;
  for (const Regime regime : {Regime::frictionless, Regime::shift, Regime::steady}) {
    c.regime = regime;
    EXPECT_EQ(to_problem(c, true).regime, regime);
  }
  using H = HistoryUse;
  for (const H history : {H::start, H::normal_only, H::same_instant}) {
    c.history = history;
    EXPECT_EQ(to_problem(c, true).history, history);
  }
}

TEST(ProfileRadius, OfWheelRailAndRoller) {
  io::WheelRailCase c;
  c.wheelset.nominal_radius = 0.46;
  EXPECT_EQ(profile_radius(c, Body::wheel), 0.46);
  EXPECT_EQ(profile_radius(c, Body::rail), 0.0);
  c.roller = {-0.9, 1.0};
  EXPECT_EQ(profile_radius(c, Body::rail), -0.9);
}

/// A solved patch of 4 x 3 elements in contact with one pressure, put together by hand.
wheelrail::PairSolution solved() {
  wheelrail::PairSolution s;
  s.placement.X_TR = {Vec3(0.0, 0.75, 0.01), rotation_x(-0.025)};
  s.placement.X_TW = {Vec3(0.001, 0.76, -0.46), rotation_x(0.02) * rotation_z(0.03)};
  s.pitch_rate = -4.25;
  s.rail_deflection_y = 1e-4;
  s.rail_deflection_z = 2e-4;
  wheelrail::PatchSolution p;
  p.grid = {-1.5e-3, -1e-3, 1e-3, 1e-3, 4, 3};
  p.frame.X_TC = {Vec3(0.1, 0.2, 0.3), rotation_x(0.5)};
  p.frame.angle = 0.5;
  p.distance.assign(p.grid.size(), 0.0);
  kalker::ContactSolution& c = p.contact;
  c.pressure.assign(p.grid.size(), 1e9);
  c.traction_x.assign(p.grid.size(), 1e8);
  c.traction_y.assign(p.grid.size(), 0.0);
  c.state.assign(p.grid.size(), kalker::ElementState::slip);
  c.force_n = 12e3;
  c.force_x = 1.2e3;
  c.moment_n = 3.0;
  p.reference_C = Vec2(0.5e-3, -0.25e-3);
  p.force_C = Vec3(1e3, 20.0, 13e3);
  p.moment_C = Vec3(0.0, 0.0, 2.0);
  p.id = 4;
  p.came_from = {1, 2};
  p.load.track = {Vec3(1, 2, 3), Vec3(4, 5, 6)};
  p.load.wheel.force = Vec3(7, 8, 9);
  p.reference_wheelset = Vec3(0.01, 0.02, 0.03);
  p.angle_rail = 0.525;
  s.load = p.load;
  s.patches.push_back(p);
  return s;
}

TEST(ToResult, GridsOfASequenceHaveAnotherOriginThanTheReference) {
  io::WheelRailCase c;
  c.regime = Regime::transient;
  const io::CaseResult r = to_result(c, solved());
  const io::PatchResult& p = r.patches.at(0);
  EXPECT_NEAR((p.fields.X_TC.apply({0.5e-3, -0.25e-3, 0.0}) - Vec3(0.1, 0.2, 0.3)).norm(), 0.0, 1e-15);
  EXPECT_EQ(p.x_tr, 0.1);
  EXPECT_EQ(p.reference_x, 0.5e-3);
  EXPECT_EQ(p.mn, 2.0) << "about the contact reference";
  EXPECT_EQ(p.fn, 12e3);
  EXPECT_TRUE(p.has_rolling);
  EXPECT_FALSE(p.local || r.rail_deflection || r.roller);
  EXPECT_EQ(p.id, 4u);
  EXPECT_THAT(p.came_from, ElementsAre(1u, 2u));
  EXPECT_EQ(p.loads.value().track.moment, Vec3(4, 5, 6));
  EXPECT_EQ(r.loads.value().wheel.force, Vec3(7, 8, 9));
  EXPECT_EQ(p.y_wheelset, 0.02);
  EXPECT_EQ(p.angle_rail, 0.525);
}

TEST(ToResult, ForcesOfConformalContactAreTheResultant) {
  io::WheelRailCase c;
  wheelrail::PairSolution s = solved();
  s.patches[0].row_angle.assign(3, 0.1);
  s.patches[0].extra_slip_x.assign(12, 1e-3);
  const io::PatchResult p = to_result(c, s).patches.at(0);
  EXPECT_EQ(p.fn, 13e3);
  EXPECT_EQ(p.fx, 1e3);
  EXPECT_EQ(p.fs, 20.0);
  EXPECT_EQ(p.local.value().fn, 12e3);
  EXPECT_NEAR(p.fx_relative, 1.2e3 / (0.3 * 12e3), 1e-12);
  EXPECT_EQ(p.fields.row_angle.size(), 3u);
  EXPECT_EQ(p.fields.extra_slip_x.size(), 12u);
}

TEST(FrictionOf, FollowsInclinationSideAndPlace) {
  io::WheelRailCase c;
  EXPECT_EQ(friction_of(c, 0.5).kinetic, c.friction.kinetic);
  FrictionLaw low, high;
  low.kinetic = 0.2;
  high.kinetic = 0.4;
  c.friction_variation = {io::FrictionVariation::Kind::inclination, {-1.0, 1.0}, {low, high}};
  EXPECT_NEAR(friction_of(c, 0.5).kinetic, 0.35, 1e-15);
  EXPECT_NEAR(to_result(c, solved()).patches.at(0).fx_relative, 1.2e3 / (0.35 * 12e3), 1e-12);
  c.side = Side::left;
  EXPECT_NEAR(friction_of(c, 0.5).kinetic, 0.25, 1e-15);
  c.friction_variation.kind = io::FrictionVariation::Kind::along_track;
  c.state.position.x = -1.0;
  EXPECT_NEAR(friction_of(c, 0.5).kinetic, 0.2, 1e-15);
  EXPECT_NEAR(to_problem(c, true).friction.kinetic, 0.2, 1e-15);
}

TEST(ToResult, TellsWhatWasFound) {
  io::WheelRailCase c;
  c.state.velocity.pitch = -4.0;
  EXPECT_EQ(to_result(c, solved()).vpitch, -4.0);
  c.longitudinal_force = 100.0;
  c.rail_springs.emplace();
  c.roller = {0.5, 8.0};
  c.damping.emplace();
  const io::CaseResult r = to_result(c, solved());
  EXPECT_EQ(r.vpitch, -4.25);
  EXPECT_EQ(r.rail_deflection.value(), Vec2(1e-4, 2e-4));
  EXPECT_EQ(r.roller.value().nominal_radius, 0.5);
  EXPECT_EQ(r.patches.at(0).fn, 13e3) << "with damping";
}

TEST(ToResult, PointsBelowTheSurfaceCountFromTheReference) {
  io::WheelRailCase c;
  c.subsurface.blocks.resize(3);
  c.subsurface.blocks[0] = {false, {}, {}, {0.0, 1e-3}, {0.0}, {1e-3}};
  c.subsurface.blocks[1] = {true, {1, 3, 4, 900}, {2}, {}, {}, {1e-3, 2e-3}};
  c.subsurface.blocks[2] = {true, {900}, {}, {}, {}, {1e-3}};
  const io::PatchResult p = to_result(c, solved()).patches.at(0);
  ASSERT_EQ(p.subsurface.size(), 2u) << "the last block has no element of this patch";
  EXPECT_NEAR((p.subsurface[0].values[0].point - Vec3(0.5e-3, -0.25e-3, 1e-3)).norm(), 0.0, 1e-15);
  EXPECT_EQ(p.subsurface[1].nx, 2);
  EXPECT_EQ(p.subsurface[1].nz, 2);
  EXPECT_LT(p.subsurface[0].values[0].stress(2, 2), 0.0);
}

TEST(ElementTable, HeadOfAWheelOnARail) {
  io::WheelRailCase c;
  c.side = Side::left;
  c.roller = {0.5, 1.0};
  c.reference_surface = ReferenceSurface::curved;
  c.regime = Regime::transient;
  c.state.position.x = 0.2;
  c.state.position.pitch = -0.3;
  c.material.layer_flexibility = 1e-12;
  c.thermal.emplace();
  io::MatFileHead h = mat_head(c, solved(), 0, 17);
  EXPECT_EQ(h.configuration, 4);
  EXPECT_EQ(h.discretisation, 4);
  EXPECT_EQ(h.tangential, 2);
  EXPECT_EQ(h.material_model, 4);
  EXPECT_EQ(h.heat, 1);
  EXPECT_EQ(h.case_number, 17);
  EXPECT_EQ(h.patches, 1);
  EXPECT_EQ(h.patch, 1);
  EXPECT_EQ(h.s_ws, 0.0);
  EXPECT_EQ(h.pitch_ws, -0.3);
  EXPECT_EQ(h.roller_radius, 0.5);
  EXPECT_EQ(h.rail_y, 0.75);
  EXPECT_NEAR(h.rail_roll, -0.025, 1e-15);
  EXPECT_NEAR(h.wheel_roll, 0.02, 1e-15);
  EXPECT_NEAR(h.wheel_yaw, 0.03, 1e-15);
  EXPECT_EQ(h.wheel_z, -0.46);
  EXPECT_EQ(h.spin_x, 0.5e-3);
  c.roller.reset();
  c.side = Side::right;
  c.reference_surface = ReferenceSurface::plane;
  c.discretisation.method = 5;
  h = mat_head(c, solved(), 0, 1);
  EXPECT_EQ(h.configuration, 1);
  EXPECT_EQ(h.discretisation, 5);
  EXPECT_EQ(h.s_ws, 0.2);
  EXPECT_EQ(h.roller_radius, 0.0);
}

TEST(GroupsInTime, CasesThatDependOnOthersFollowThem) {
  io::CaseFile file;
  using R = Regime;
  using H = HistoryUse;
  const auto add = [&](int sequence, R regime, H history, bool damped = false) {
    io::WheelRailCase c;
    c.regime = regime;
    c.history = history;
    if (damped) c.damping.emplace();
    io::Case one;
    one.sequence = sequence;
    one.content = c;
    file.cases.push_back(one);
  };
  add(0, R::steady, H::start);
  add(0, R::steady, H::keep_going);  // steady rolling has no history
  add(1, R::transient, H::start);
  add(0, R::transient, H::keep_going);  // goes on from case 1
  add(1, R::shift, H::keep_going);
  add(0, R::steady, H::keep_going, true);  // damped against case 3
  add(1, R::transient, H::start);
  add(1, R::transient, H::same_instant);
  EXPECT_THAT(groups_in_time(file),
              ElementsAre(ElementsAre(0), ElementsAre(1, 3, 5), ElementsAre(2, 4), ElementsAre(6, 7)));
}

}  // namespace
}  // namespace treadmark::app
