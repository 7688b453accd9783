// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/io/cases/contact_program/contact_digits.hpp"
#include "treadmark/tests/io/cases/contact_writer.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

TEST(ContactInputModule1, ConvertsEveryValueToSi) {
  const CaseFile f = parse_input(ContactWriter(1).set("EWHEEL", 5).str() + "0\n");
  ASSERT_EQ(f.cases.size(), 1u);
  EXPECT_EQ(f.cases[0].number, 1);
  EXPECT_EQ(f.cases[0].where.line, 1);
  const WheelRailCase& c = rail_case(f, 0);
  EXPECT_EQ(c.side, Side::right);
  EXPECT_EQ(c.regime, Regime::steady);
  EXPECT_TRUE(c.vertical_force_prescribed);
  EXPECT_DOUBLE_EQ(c.vertical_force, 125000.0);
  EXPECT_DOUBLE_EQ(c.discretisation.dx, 0.4e-3);
  EXPECT_DOUBLE_EQ(c.discretisation.ds, 0.5e-3);
  EXPECT_DOUBLE_EQ(c.discretisation.angle_separation, 90 * kDegree);
  EXPECT_DOUBLE_EQ(c.discretisation.separation, 8e-3);
  EXPECT_DOUBLE_EQ(c.discretisation.combination, 4e-3);
  EXPECT_FALSE(c.discretisation.turning);
  EXPECT_DOUBLE_EQ(c.discretisation.near_miss, -1e-3);
  EXPECT_EQ(c.discretisation.conventions, Conventions::contact);
  EXPECT_FALSE(c.discretisation.linear_weight);
  EXPECT_EQ(c.discretisation.method, 2);
  EXPECT_EQ(c.discretisation.max_elements, 20000);
  EXPECT_TRUE(c.track.gauge_based);
  EXPECT_DOUBLE_EQ(c.track.gauge_height, 14e-3);
  EXPECT_DOUBLE_EQ(c.track.gauge_width, 1.435);
  EXPECT_DOUBLE_EQ(c.track.cant, 0.025);
  EXPECT_DOUBLE_EQ(c.track.curvature, 0.0);
  EXPECT_DOUBLE_EQ(c.track.dy, 0.1e-3);
  EXPECT_DOUBLE_EQ(c.track.dz, 0.2e-3);
  EXPECT_DOUBLE_EQ(c.track.roll, 0.3 * kDegree);
  EXPECT_DOUBLE_EQ(c.track.vy, 4e-3);
  EXPECT_DOUBLE_EQ(c.track.vz, 5e-3);
  EXPECT_DOUBLE_EQ(c.track.vroll, 0.6);
  const WheelsetDimensions& w = c.wheelset;
  const WheelsetState& s = c.state;
  EXPECT_DOUBLE_EQ(w.flange_back_distance, 1.36);
  EXPECT_DOUBLE_EQ(w.flange_back_position, -0.07);
  EXPECT_DOUBLE_EQ(w.nominal_radius, 0.46);
  EXPECT_FALSE(w.tape_line);
  EXPECT_DOUBLE_EQ(s.position.x, 1e-3);
  EXPECT_DOUBLE_EQ(s.position.y, 2e-3);
  EXPECT_DOUBLE_EQ(s.position.roll, 0.001);
  EXPECT_DOUBLE_EQ(s.position.yaw, 0.002);
  EXPECT_DOUBLE_EQ(s.position.pitch, -25 * kDegree);
  EXPECT_DOUBLE_EQ(s.velocity.x, 2.0);
  EXPECT_DOUBLE_EQ(s.velocity.y, 1e-3);
  EXPECT_DOUBLE_EQ(s.velocity.z, 2e-3);
  EXPECT_DOUBLE_EQ(s.velocity.roll, 0.1);
  EXPECT_DOUBLE_EQ(s.velocity.yaw, 0.2);
  EXPECT_DOUBLE_EQ(s.velocity.pitch, -4.0);
  EXPECT_DOUBLE_EQ(s.wheel_offset.x, 0.1e-3);
  EXPECT_DOUBLE_EQ(s.wheel_offset.y, 0.2e-3);
  EXPECT_DOUBLE_EQ(s.wheel_offset.z, 0.3e-3);
  EXPECT_DOUBLE_EQ(s.wheel_offset.roll, 1 * kDegree);
  EXPECT_DOUBLE_EQ(s.wheel_offset.yaw, 2 * kDegree);
  EXPECT_DOUBLE_EQ(s.wheel_offset.pitch, 3 * kDegree);
  EXPECT_DOUBLE_EQ(s.wheel_velocity.x, 1e-3);
  EXPECT_DOUBLE_EQ(s.wheel_velocity.y, 2e-3);
  EXPECT_DOUBLE_EQ(s.wheel_velocity.z, 3e-3);
  EXPECT_DOUBLE_EQ(s.wheel_velocity.roll, 0.1);
  EXPECT_DOUBLE_EQ(s.wheel_velocity.yaw, 0.2);
  EXPECT_DOUBLE_EQ(s.wheel_velocity.pitch, 0.3);
  EXPECT_DOUBLE_EQ(c.material.shear_modulus_1, 82e9);
  EXPECT_DOUBLE_EQ(c.material.shear_modulus_2, 82e9);
  EXPECT_DOUBLE_EQ(c.material.poisson_1, 0.28);
  EXPECT_DOUBLE_EQ(c.material.layer_flexibility, 0.0);
  EXPECT_EQ(c.friction.kind, FrictionLaw::Kind::coulomb);
  EXPECT_DOUBLE_EQ(c.friction.kinetic, 0.3);
  EXPECT_EQ(c.solver.max_iterations, 999);
  EXPECT_EQ(c.solver.max_outer, 100);
  EXPECT_EQ(c.solver.max_force, 30);
  EXPECT_EQ(c.solver.max_coupling, 1);
  EXPECT_DOUBLE_EQ(c.solver.eps, 1e-5);
  const auto& rail = std::get<GeometryFile>(c.rail.geometry);
  EXPECT_EQ(rail.file, "folder/rail.prr");
  EXPECT_EQ(rail.options.mirror_z, -1);
  EXPECT_EQ(std::get<GeometryFile>(c.wheel.geometry).file, "folder/sub/wheel.prw");
  EXPECT_GT(c.wheel.where.line, c.rail.where.line);
}

TEST(ContactInputModule1, KinksMayNeedNoStraightNeighbours) {
  const CaseFile f =
      parse_input(ContactWriter(1).line("rail", "'rail.prr' 0 1. 0. 0. 1.0\n 0 100d 20d 5d 0.0").str() + "0 MODULE\n");
  EXPECT_EQ(std::get<GeometryFile>(rail_case(f, 0).rail.geometry).options.smoothing.kink_width, 0.0);
}

TEST(ContactInputModule1, KeepsValuesThatLaterCasesDoNotGive) {
  ContactWriter later(1);
  for (const auto* digit : {"FRCLAW", "DISCNS", "INFLCF"}) later.set(digit, 1);
  later.set("ZTRACK", 0).set("EWHEEL", 2).set("GAUSEI", 1).line("position", "5.0 6.0 99000. 0.1 0.2 -26d");
  const CaseFile f = parse_input(ContactWriter(1).set("EWHEEL", 5).set("FRCLAW", 4).str() + later.str() + "0 MODULE\n");
  ASSERT_EQ(f.cases.size(), 2u);
  EXPECT_EQ(f.cases[1].number, 2);
  const WheelRailCase &a = rail_case(f, 0), &b = rail_case(f, 1);
  EXPECT_DOUBLE_EQ(b.state.position.x, 5e-3);
  EXPECT_DOUBLE_EQ(b.vertical_force, 99000.0);
  EXPECT_DOUBLE_EQ(b.state.position.pitch, -26 * kDegree);
  EXPECT_EQ(std::get<GeometryFile>(b.rail.geometry).file, std::get<GeometryFile>(a.rail.geometry).file);
  EXPECT_EQ(std::get<GeometryFile>(b.wheel.geometry).options, std::get<GeometryFile>(a.wheel.geometry).options);
  EXPECT_DOUBLE_EQ(b.track.cant, a.track.cant);
  EXPECT_DOUBLE_EQ(b.track.dy, a.track.dy);
  EXPECT_DOUBLE_EQ(b.state.wheel_offset.roll,
                   a.state.wheel_offset.roll);  // deviations stay when E = 2 does not give them
  EXPECT_DOUBLE_EQ(b.friction.half_velocity_1, a.friction.half_velocity_1);
  EXPECT_EQ(b.friction.kind, FrictionLaw::Kind::exponential);
  EXPECT_DOUBLE_EQ(b.material.shear_modulus_1, 82e9);
  EXPECT_DOUBLE_EQ(b.discretisation.dx, a.discretisation.dx);
  EXPECT_EQ(b.solver.max_iterations, 999);
}

TEST(ContactInputModule1, ReadsOptionalValuesOfTheirLinesOnly) {
  const CaseFile f = parse_input(ContactWriter(1)
                                     .line("grid", "0.4 0.5 1.0 90d 8.0 4.0 11.0 0.5")
                                     .line("track", "-1.0 750.0 1.5 0.02 0.001")
                                     .line("wheelset", "1360. -70. 460. 0.5")
                                     .line("solver", "10 11 12 13 1d-6 50")
                                     .str() +
                                 "0\n");
  const WheelRailCase& c = rail_case(f, 0);
  EXPECT_DOUBLE_EQ(c.discretisation.turning.value(), 11e-3);
  EXPECT_DOUBLE_EQ(c.discretisation.near_miss, 0.5e-3);
  EXPECT_FALSE(c.track.gauge_based);
  EXPECT_DOUBLE_EQ(c.track.rail_y0, 0.75);
  EXPECT_DOUBLE_EQ(c.track.rail_z0, 1.5e-3);
  EXPECT_DOUBLE_EQ(c.track.cant, 0.02);
  EXPECT_DOUBLE_EQ(c.track.curvature, 1.0);
  EXPECT_DOUBLE_EQ(c.wheelset.tape_line.value(), 0.5e-3);
  EXPECT_EQ(c.solver.max_coupling, 13);
  EXPECT_EQ(c.discretisation.max_elements, 100);  // the limit is not below 100
  // An unused tape line is written as a large number.
  const CaseFile unused = parse_input(ContactWriter(1).line("wheelset", "1360. -70. 460. 1000.").str() + "0\n");
  EXPECT_FALSE(rail_case(unused, 0).wheelset.tape_line);
}

TEST(ContactInputModule1, ErrorHandlingOfAProfileIsNoted) {
  const auto notes = [](const std::string& options) {
    return parse_input(ContactWriter(1).line("wheel", "'b.prw' -1 1.0 4.0 0 2\n 0 160d 25d 5d 3.0\n " + options).str() +
                       "0\n")
        .notes;
  };
  EXPECT_THAT(notes("0 0.25"), ::testing::IsEmpty());
  EXPECT_THAT(notes("2 0.25"), ::testing::ElementsAre(
                                   ::testing::AllOf(::testing::StartsWith("ERRHND = 2 at "),
                                                    ::testing::HasSubstr("errors in a profile always stop the run"))));
}

TEST(ContactInputModule1, ReadsProfileOptions) {
  const CaseFile f = parse_input(ContactWriter(1)
                                     .line("rail", "'a.prr' 1 1000. 5.0 1 1\n 1 20d 30d 0.1 3.0")
                                     .line("wheel", "'b.prw' -1 1.0 4.0 0 2\n 0 160d 25d 5d 3.0\n 1 0.25")
                                     .str() +
                                 "0\n");
  const ProfileOptions& rail = std::get<GeometryFile>(rail_case(f, 0).rail.geometry).options;
  EXPECT_EQ(rail.mirror_y, 1);
  EXPECT_EQ(rail.mirror_z, 1);
  EXPECT_DOUBLE_EQ(rail.scale, 1000.0);
  EXPECT_EQ(rail.smoothing.method, SmoothingOptions::Method::weighted_spline);
  EXPECT_DOUBLE_EQ(rail.smoothing.strength, 5e-3);        // wavelength
  EXPECT_DOUBLE_EQ(rail.zigzag_threshold, 45 * kDegree);  // raised to 45 degrees
  EXPECT_DOUBLE_EQ(rail.smoothing.kink_high, 30 * kDegree);
  EXPECT_DOUBLE_EQ(rail.smoothing.kink_low, 0.1);
  EXPECT_DOUBLE_EQ(rail.smoothing.kink_width, 3e-3);
  const ProfileOptions& wheel = std::get<GeometryFile>(rail_case(f, 0).wheel.geometry).options;
  EXPECT_EQ(wheel.mirror_y, 0);
  EXPECT_DOUBLE_EQ(wheel.smoothing.strength, 4e-9);  // lambda
  EXPECT_DOUBLE_EQ(wheel.zigzag_threshold, 160 * kDegree);
  EXPECT_EQ(wheel.error_handling, 1);
  EXPECT_DOUBLE_EQ(wheel.max_omit, 0.25);
  EXPECT_FALSE(rail == wheel);
  EXPECT_TRUE(rail == rail);
}

TEST(ContactInputModule1, SecondIntegerOfTheModelLineHoldsTheWeight) {
  const auto with = [](const std::string& second) {
    return parse_input(ContactWriter(1).line("word2", "0022033 " + second).str() + "0\n");
  };
  EXPECT_TRUE(rail_case(with("10"), 0).discretisation.linear_weight);
  EXPECT_FALSE(rail_case(with("20"), 0).discretisation.linear_weight);
  EXPECT_FALSE(rail_case(with("1"), 0).discretisation.linear_weight);  // M2 = 1 without earlier damping
  EXPECT_THROW(with("30"), Error);
  EXPECT_THROW(with("-1"), Error);
}

TEST(ContactInputModule1, PositionInsteadOfForce) {
  const WheelRailCase c = rail_case(parse_input(ContactWriter(1).set("NORM", 0).set("CONFIG", 0).str() + "0\n"), 0);
  EXPECT_FALSE(c.vertical_force_prescribed);
  EXPECT_DOUBLE_EQ(c.state.position.z, 0.3e-3);
  EXPECT_EQ(c.side, Side::left);
}

TEST(ContactInputModule1, ElasticLayerHasAFlexibility) {
  const WheelRailCase c = rail_case(parse_input(ContactWriter(1).set("MATER", 4).str() + "0\n"), 0);
  EXPECT_DOUBLE_EQ(c.material.layer_flexibility, 1.25e-3 / 8.2e9);
  const std::string strong = ContactWriter(1).set("MATER", 4).line("layer", "8200. 1.25 1e11 5.0").str();
  EXPECT_NO_THROW(parse_input(strong + "0\n"));
  EXPECT_DOUBLE_EQ(rail_case(parse_input(strong + "0\n"), 0).material.layer_yield, 0.0);
  // With M = 0 the kept layer does not count.
  ContactWriter later(1);
  later.set("INFLCF", 0);
  EXPECT_DOUBLE_EQ(rail_case(parse_input(ContactWriter(1).set("MATER", 4).str() + later.str() + "0\n"), 1)
                       .material.layer_flexibility,
                   0.0);
}

TEST(ContactInputModule3, ConvertsEveryValueToSi) {
  const CaseFile f =
      parse_input(ContactWriter(3).line("kinematics", "9000. -0.001 0.002 0.0003 1.0 2.0").str() + "0\n");
  const BasicCase& c = basic_case(f, 0);
  EXPECT_TRUE(c.normal_force_prescribed);
  EXPECT_DOUBLE_EQ(c.normal_force, 9000.0);
  EXPECT_DOUBLE_EQ(c.xi, -0.001);
  EXPECT_DOUBLE_EQ(c.eta, 0.002);
  EXPECT_DOUBLE_EQ(c.phi, 0.3);  // rad/mm to rad/m
  EXPECT_DOUBLE_EQ(c.spin_x, 1e-3);
  EXPECT_DOUBLE_EQ(c.spin_y, 2e-3);
  EXPECT_DOUBLE_EQ(c.dq, 0.4e-3);
  EXPECT_DOUBLE_EQ(c.velocity, 30.0);
  EXPECT_DOUBLE_EQ(c.spin_offset_factor, 1.0 / 6.0);
  EXPECT_EQ(c.mx, 3);
  EXPECT_EQ(c.my, 2);
  EXPECT_DOUBLE_EQ(c.x0, -1e-3);
  EXPECT_DOUBLE_EQ(c.y0, -0.5e-3);
  EXPECT_DOUBLE_EQ(c.dx, 1e-3);
  const GapInput& gap = std::get<GapInput>(c.geometry);
  EXPECT_EQ(gap.kind, GapInput::Kind::quadratic);
  EXPECT_THAT(gap.coefficients, ::testing::ElementsAre(1.0, 0.0, 2.0, 0.0, 0.0, 0.0));
}

TEST(ContactInputModule3, ShiftIsALength) {
  const BasicCase c = basic_case(parse_input(ContactWriter(3).set("TANG", 1).str() + "0\n"), 0);
  EXPECT_EQ(c.regime, Regime::shift);
  EXPECT_DOUBLE_EQ(c.xi, -1e-6);
  EXPECT_DOUBLE_EQ(c.eta, 2e-6);
  EXPECT_DOUBLE_EQ(c.phi, 0.0003);
}

TEST(ContactInputModule3, ForcesReplaceCreepages) {
  const auto line = ".005 -0.8 0.1 0.0";
  const BasicCase one = basic_case(
      parse_input(ContactWriter(3).set("NORM", 0).set("FORCE", 1).line("kinematics", line).str() + "0\n"), 0);
  EXPECT_DOUBLE_EQ(one.approach, 5e-6);
  EXPECT_DOUBLE_EQ(one.fx_relative.value(), -0.8);
  EXPECT_FALSE(one.fy_relative);
  EXPECT_DOUBLE_EQ(one.eta, 0.1);
  const BasicCase two =
      basic_case(parse_input(ContactWriter(3).set("FORCE", 2).line("kinematics", line).str() + "0\n"), 0);
  EXPECT_DOUBLE_EQ(two.fy_relative.value(), 0.1);
}

struct Potential {
  const char *kind, *line;
  double x0, y0, dx, dy;
};
class ContactInputPotential : public ::testing::TestWithParam<Potential> {};
TEST_P(ContactInputPotential, GivesFirstCentreAndSteps) {
  const Potential& p = GetParam();
  const BasicCase c =
      basic_case(parse_input(ContactWriter(3).line("ipotcn", p.kind).line("potcon", p.line).str() + "0\n"), 0);
  constexpr double kRoundoff = 1e-15;
  EXPECT_NEAR(c.x0, p.x0, kRoundoff);
  EXPECT_NEAR(c.y0, p.y0, kRoundoff);
  EXPECT_NEAR(c.dx, p.dx, kRoundoff);
  EXPECT_NEAR(c.dy, p.dy, kRoundoff);
}
INSTANTIATE_TEST_SUITE_P(Kinds, ContactInputPotential,
                         ::testing::Values(Potential{"1", "4 5 -2 -1 1.0 0.5", -1.5e-3, -0.75e-3, 1e-3, 0.5e-3},
                                           Potential{"2", "4 5 -2 -1 2.0 1.5", -1.5e-3, -0.75e-3, 1e-3, 0.5e-3},
                                           Potential{"3", "4 5 -1.5 -.75 1.0 0.5", -1.5e-3, -0.75e-3, 1e-3, 0.5e-3},
                                           Potential{"4", "4 5 -1.5 -.75 1.5 1.25", -1.5e-3, -0.75e-3, 1e-3, 0.5e-3}));

TEST(ContactInputModule3, HertzianGeometry) {
  const auto read = [](const std::string& kind, const std::string& line) {
    return std::get<HertzInput>(
        basic_case(
            parse_input(ContactWriter(3).line("ipotcn", kind).line("potcon", line).line("hertz", "").str() + "0\n"), 0)
            .geometry);
  };
  using Given = HertzInput::Given;
  HertzInput h = read("-1", "4 5 0.001 0.002 1.2");
  EXPECT_EQ(h.given, Given::curvatures);
  EXPECT_DOUBLE_EQ(h.a1, 1.0);
  EXPECT_DOUBLE_EQ(h.b1, 2.0);
  EXPECT_DOUBLE_EQ(h.scale, 1.2);
  h = read("-2", "4 5 0.001 0.5 1.2");
  EXPECT_EQ(h.given, Given::curvature_and_ratio);
  EXPECT_DOUBLE_EQ(h.aob, 0.5);
  h = read("-3", "4 5 8.0 4.0 1.2");
  EXPECT_EQ(h.given, Given::semi_axes);
  EXPECT_DOUBLE_EQ(h.aa, 8e-3);
  EXPECT_DOUBLE_EQ(h.bb, 4e-3);
  h = read("-4", "4 5 0.001 4.0 1.2");
  EXPECT_EQ(h.given, Given::line_curvature);
  EXPECT_DOUBLE_EQ(h.a1, 1.0);
  EXPECT_DOUBLE_EQ(h.bb, 4e-3);
  h = read("-5", "4 5 8.0 4.0 1.2");
  EXPECT_EQ(h.given, Given::line_semi_axis);
  EXPECT_DOUBLE_EQ(h.aa, 8e-3);
}

TEST(ContactInputModule3, UndeformedDistances) {
  const auto read = [](const std::string& base, const std::string& lines) {
    return std::get<GapInput>(
        basic_case(parse_input(ContactWriter(3).line("ibase", base + " 1").line("gap", lines).str() + "0\n"), 0)
            .geometry);
  };
  using ::testing::DoubleEq;
  using ::testing::ElementsAre;
  EXPECT_THAT(read("1", "0.001 0.002 0.003 0.1 0.2 0.5").coefficients,
              ElementsAre(1.0, 2.0, 3.0, 0.1, 0.2, DoubleEq(0.5e-3)));
  const GapInput circular = read("2", "3 1.0 460. -10. 20.\n 0.1 0.2\n 0.3");
  EXPECT_EQ(circular.kind, GapInput::Kind::circular);
  EXPECT_THAT(circular.coefficients, ElementsAre(DoubleEq(1e-3), DoubleEq(0.46), DoubleEq(-10e-3), DoubleEq(20e-3),
                                                 DoubleEq(1e-4), DoubleEq(2e-4), DoubleEq(3e-4)));
  const GapInput wavy = read("3", "0.1 2.0 0.3 0.4 5.0 0.6 700. 800.");
  EXPECT_EQ(wavy.kind, GapInput::Kind::sinusoidal);
  EXPECT_THAT(wavy.coefficients, ElementsAre(DoubleEq(1e-4), DoubleEq(2000.), DoubleEq(3e-4), DoubleEq(4e-4),
                                             DoubleEq(5000.), DoubleEq(6e-4), DoubleEq(0.7), DoubleEq(0.8)));
  const GapInput each = read("9", "1 2 3\n4 5\n6 trailing");
  EXPECT_EQ(each.kind, GapInput::Kind::per_element);
  EXPECT_THAT(each.coefficients, ElementsAre(DoubleEq(1e-3), DoubleEq(2e-3), DoubleEq(3e-3), DoubleEq(4e-3),
                                             DoubleEq(5e-3), DoubleEq(6e-3)));
}

TEST(ContactInputModule3, FastsimAndFrictionLaws) {
  const CaseFile f = parse_input(ContactWriter(3).set("MATER", 3).set("FRCLAW", 2).str() +
                                 ContactWriter(3).set("FRCLAW", 3).str() + "0\n");
  const BasicCase& c = basic_case(f, 0);
  EXPECT_EQ(c.tangential_model, TangentialModel::fastsim);
  EXPECT_DOUBLE_EQ(c.fastsim.k0, 0.9);
  EXPECT_DOUBLE_EQ(c.fastsim.alpha, 0.8);
  EXPECT_DOUBLE_EQ(c.fastsim.beta, 0.7);
  EXPECT_EQ(c.friction.kind, FrictionLaw::Kind::linear);
  EXPECT_DOUBLE_EQ(c.friction.kinetic, 0.2);
  EXPECT_DOUBLE_EQ(c.friction.amplitude_1, 0.1);
  EXPECT_DOUBLE_EQ(c.friction.half_velocity_1, 0.1);
  EXPECT_DOUBLE_EQ(c.friction.amplitude_2, 0.05);
  EXPECT_DOUBLE_EQ(c.friction.half_velocity_2, 0.2);
  EXPECT_DOUBLE_EQ(c.friction.memory_distance, 3e-6);
  EXPECT_DOUBLE_EQ(c.friction.memory_velocity, 1e-3);
  EXPECT_EQ(basic_case(f, 1).tangential_model, TangentialModel::full);
  EXPECT_EQ(basic_case(f, 1).friction.kind, FrictionLaw::Kind::rational);
}

TEST(ContactInputSequence, ReturnDigitSkipsCasesAndModuleLines) {
  // 0: run, no module line next; 2: skip, no module line next; 3: skip; 1: run.
  ContactWriter a(3), b(3), c(3), d(3);
  a.set("RETURN", 0);
  b.set("RETURN", 2).line("kinematics", "1. 0.1 0.2 0.3").line("friction", "0.7 0.7");
  c.set("RETURN", 3).set("FRCLAW", 1);
  d.set("FRCLAW", 1);
  const CaseFile f = parse_input(a.str() + b.str(false) + c.str(false) + d.str() + "0\n");
  ASSERT_EQ(f.cases.size(), 2u);
  EXPECT_EQ(f.cases[0].number, 1);
  EXPECT_EQ(f.cases[1].number, 4);
  EXPECT_DOUBLE_EQ(basic_case(f, 1).friction.kinetic, 0.7);  // a skipped case still gives values to keep
}

TEST(ContactInputSequence, ResultElementsKeepTheirOwnValues) {
  ContactWriter one(3), two(3), one_again(3);
  one.line("module", "3 7 1").line("friction", "0.1 0.1");
  two.line("module", "3 8 1").line("friction", "0.2 0.2");
  one_again.line("module", "3 7 1").set("FRCLAW", 1);
  const CaseFile f = parse_input(one.str() + two.str() + one_again.str() + "0\n");
  EXPECT_DOUBLE_EQ(basic_case(f, 2).friction.kinetic, 0.1);
}

TEST(ContactInputSequence, DebugLineAndSolverLinesAreRead) {
  for (const int solver : {0, 2, 3, 4, 5})
    EXPECT_NO_THROW(parse_input(ContactWriter(1).set("XFLOW", 1).set("GAUSEI", solver).str() + "0\n")) << solver;
  const CaseFile f =
      parse_input(ContactWriter(1).set("GAUSEI", 3).set("IESTIM", 1).set("MATFIL", 2).set("PVTIME", 0).str() + "0\n");
  EXPECT_EQ(f.notes.size(), 3u);
}

TEST(ContactInputSequence, LeadingZerosOfControlWordsMayBeMissing) {
  EXPECT_EQ(
      parse_input(ContactWriter(1).line("word1", "203100").line("word2", "22033").line("word3", "1").str() + "0\n")
          .cases.size(),
      1u);
}

TEST(ContactInputSequence, FileWithoutClosingLineIsNoted) {
  const CaseFile f = parse_input(ContactWriter(3).str());
  EXPECT_EQ(f.cases.size(), 1u);
  EXPECT_THAT(f.notes, ::testing::ElementsAre(::testing::HasSubstr("closing line")));
}

}  // namespace
}  // namespace treadmark::io
