// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/io/cases/parsed_cases.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

const std::string kPatch =
    "[patch]\nnormal_force_N = 1e3\nmx = 10\nmy = 8\nhertz.given = \"semi_axes\"\nhertz.semi_axis_x_mm = 4.0\n"
    "hertz.semi_axis_y_mm = 2.0\n";

TEST(TomlCase, SmallestWheelRailCase) {
  const CaseFile f = parse_study(kRail);
  ASSERT_EQ(f.cases.size(), 1u);
  EXPECT_EQ(f.title, "study");
  EXPECT_EQ(f.cases[0].number, 1);
  const WheelRailCase& c = rail_case(f, 0);
  EXPECT_EQ(std::get<StandardProfile>(c.rail.geometry).name, "60E1");
  EXPECT_EQ(std::get<StandardProfile>(c.wheel.geometry).name, "S1002");
  EXPECT_DOUBLE_EQ(c.vertical_force, 1e5);
  EXPECT_EQ(c.regime, Regime::steady);
  EXPECT_EQ(c.discretisation.conventions, Conventions::treadmark);
  EXPECT_EQ(c.rail.where.line, 1);
}

TEST(TomlCase, ShippedWheelFlatExample) {
  const CaseFile f = read_any_case(std::string(TREADMARK_SOURCE_DIR) + "/examples/wheel-flat.toml");
  ASSERT_EQ(f.cases.size(), 13u);
  const std::vector<double> pitch{-14, -10, -8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 14};
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_NEAR(rail_case(f, i).state.position.pitch, pitch[i] * kDegree, 1e-15);
    EXPECT_EQ(f.cases[i].number, static_cast<int>(i) + 1);
  }
  const WheelRailCase& c = rail_case(f, 6);
  ASSERT_EQ(c.wheel.defects.flats.size(), 1u);
  const WheelFlat& flat = c.wheel.defects.flats[0];
  EXPECT_EQ(flat.shape, WheelFlat::Shape::rounded);
  EXPECT_DOUBLE_EQ(flat.length, 0.16);
  EXPECT_DOUBLE_EQ(flat.depth, 1.4e-3);
  EXPECT_DOUBLE_EQ(flat.theta_center, 0.0);
  EXPECT_DOUBLE_EQ(flat.y_center, 6e-3);
  EXPECT_DOUBLE_EQ(flat.width, 60e-3);
  EXPECT_DOUBLE_EQ(c.track.cant, std::atan(1.0 / 40.0));
  EXPECT_DOUBLE_EQ(c.vertical_force, 125e3);
  EXPECT_DOUBLE_EQ(c.friction.kinetic, 0.3);
  EXPECT_DOUBLE_EQ(c.discretisation.dx, 0.5e-3);
  EXPECT_DOUBLE_EQ(c.wheelset.nominal_radius, 0.49);
  EXPECT_DOUBLE_EQ(c.state.velocity.x, 2.0);
  EXPECT_NEAR(c.state.velocity.pitch, -c.state.velocity.x / c.wheelset.nominal_radius, 1e-3);
}

/// Every number reaches a place of its own: it comes back as it was set, and no other number changes with it
/// (but for keys that name the same place in another unit or for both bodies).
TEST(TomlCase, EveryNumberKeyHasItsPlace) {
  int tested = 0;
  for (const CaseKey& key : case_keys()) {
    if (!key.get) continue;
    SCOPED_TRACE(key.info.path);
    Case fresh;
    if (key.info.scope == KeyScope::patch) fresh.content = BasicCase{};
    const double low = key.info.at_least.value_or(key.info.above.value_or(-0.7)),
                 high = key.info.at_most.value_or(low + 1.3);
    CaseValue value;
    value.data = low + 0.37 * (high - low);
    EXPECT_NO_THROW(check_value(key.info, value));
    Case changed = fresh;
    key.set(changed, value, "folder");
    EXPECT_NEAR(key.get(changed), value.number(), 1e-12 * (1.0 + std::abs(value.number())));
    EXPECT_NE(key.get(changed), key.get(fresh));
    int moved = 0;
    for (const CaseKey& other : case_keys())
      if (other.get && (other.info.scope == KeyScope::any || other.info.scope == key.info.scope ||
                        (key.info.scope == KeyScope::any && other.info.scope == KeyScope::wheel_rail))) {
        const double before = other.get(fresh), after = other.get(changed);
        // NaN: of a part that the case has not got; a key may bring it, with all its numbers.
        moved += &other == &key || (!std::isnan(before) && before != after) ? 1 : 0;
      }
    const std::set<std::string> of_both{"material.shear_modulus_GPa", "material.poisson_ratio", "material.creep_ratio",
                                        "material.relaxation_time_s"};
    const bool both_bodies = of_both.contains(key.info.path);
    EXPECT_LE(moved, both_bodies ? 3 : 2);
    EXPECT_GE(moved, 1);
    ++tested;
  }
  EXPECT_GT(tested, 80);
}

TEST(TomlCase, UnitsComeFromTheName) {
  EXPECT_DOUBLE_EQ(unit_of_key("a.b_mm"), 1e-3);
  EXPECT_DOUBLE_EQ(unit_of_key("a.b_GPa"), 1e9);
  EXPECT_DOUBLE_EQ(unit_of_key("b_MPa"), 1e6);
  EXPECT_DOUBLE_EQ(unit_of_key("b_N"), 1.0);
  EXPECT_DOUBLE_EQ(unit_of_key("b_deg"), kDegree);
  EXPECT_DOUBLE_EQ(unit_of_key("b_mm3"), 1e-9);
  EXPECT_DOUBLE_EQ(unit_of_key("b_mm_s"), 1e-3);
  EXPECT_DOUBLE_EQ(unit_of_key("b_m_s"), 1.0);
  EXPECT_DOUBLE_EQ(unit_of_key("b_rad_m"), 1.0);
  EXPECT_DOUBLE_EQ(unit_of_key("b_mm_per_MPa"), 1e-9);
  EXPECT_DOUBLE_EQ(unit_of_key("b_MPa_per_mm"), 1e9);
  EXPECT_DOUBLE_EQ(unit_of_key("b_J_per_kg_K"), 1.0);
  EXPECT_DOUBLE_EQ(unit_of_key("b_kg_per_m3"), 1.0);
  EXPECT_DOUBLE_EQ(unit_of_key("coefficient"), 1.0);
}

TEST(TomlCase, ReadsTrackWheelsetAndDiscretisation) {
  const CaseFile f = parse_study(R"(
title = "everything"
[case]
side = "left"
regime = "none"
[rail]
shape.standard = "60E1"
backend = "analytic"
[wheel.shape]
standard = "S1002"
[track]
rail_y_mm = 750.0
rail_z_mm = 1
cant_deg = 1.5
curvature_per_m = 0.002
irregularity_y_mm = 0.5
irregularity_roll_rad = 0.01
irregularity_vz_m_s = 0.3
[wheelset]
z_mm = 0.25
y_mm = -3
roll_deg = 0.1
yaw_rad = 0.02
pitch_deg = -37
velocity_m_s = 40
tape_line_y_mm = 2
deviation_yaw_deg = 0.5
deviation_vx_m_s = 0.25
[discretisation]
dx_mm = 0.2
turning_mm = 12
near_miss_mm = 0.5
weight = "linear"
method = "grid_steep"
max_elements = 5000
reference_search_mesh = true
[material]
shear_modulus_GPa = 80
rail_poisson_ratio = 0.3
wheel_poisson_ratio = 0.3
layer_flexibility_mm_per_MPa = 1.5e-4
[friction]
law = "exponential"
coefficient = 0.14
amplitude_1 = 0.19
half_velocity_1_m_s = 1.25
memory_distance_mm = 0.003
memory_velocity_mm_s = 1.0
[solver]
tolerance = 1e-6
max_set_iterations = 50
)");
  const WheelRailCase& c = rail_case(f, 0);
  EXPECT_EQ(f.title, "everything");
  EXPECT_EQ(c.side, Side::left);
  EXPECT_EQ(c.regime, Regime::frictionless);
  EXPECT_EQ(c.rail.backend, "analytic");
  EXPECT_FALSE(c.track.gauge_based);
  EXPECT_DOUBLE_EQ(c.track.rail_y0, 0.75);
  EXPECT_DOUBLE_EQ(c.track.rail_z0, 1e-3);
  EXPECT_DOUBLE_EQ(c.track.cant, 1.5 * kDegree);
  EXPECT_DOUBLE_EQ(c.track.curvature, 0.002);
  EXPECT_DOUBLE_EQ(c.track.dy, 0.5e-3);
  EXPECT_DOUBLE_EQ(c.track.roll, 0.01);
  EXPECT_DOUBLE_EQ(c.track.vz, 0.3);
  EXPECT_FALSE(c.vertical_force_prescribed);
  EXPECT_DOUBLE_EQ(c.state.position.z, 0.25e-3);
  EXPECT_DOUBLE_EQ(c.state.position.y, -3e-3);
  EXPECT_DOUBLE_EQ(c.state.position.roll, 0.1 * kDegree);
  EXPECT_DOUBLE_EQ(c.state.position.yaw, 0.02);
  EXPECT_DOUBLE_EQ(c.state.position.pitch, -37 * kDegree);
  EXPECT_DOUBLE_EQ(c.state.velocity.x, 40.0);
  EXPECT_DOUBLE_EQ(c.wheelset.tape_line.value(), 2e-3);
  EXPECT_DOUBLE_EQ(c.state.wheel_offset.yaw, 0.5 * kDegree);
  EXPECT_DOUBLE_EQ(c.state.wheel_velocity.x, 0.25);
  EXPECT_DOUBLE_EQ(c.discretisation.dx, 0.2e-3);
  EXPECT_DOUBLE_EQ(c.discretisation.turning.value(), 12e-3);
  EXPECT_DOUBLE_EQ(c.discretisation.near_miss, 0.5e-3);
  EXPECT_TRUE(c.discretisation.linear_weight);
  EXPECT_EQ(c.discretisation.method, 6);
  EXPECT_EQ(c.discretisation.max_elements, 5000);
  EXPECT_EQ(c.discretisation.conventions, Conventions::contact);
  EXPECT_DOUBLE_EQ(c.material.shear_modulus_1, 80e9);
  EXPECT_DOUBLE_EQ(c.material.shear_modulus_2, 80e9);
  EXPECT_DOUBLE_EQ(c.material.poisson_1, 0.3);
  EXPECT_DOUBLE_EQ(c.material.layer_flexibility, 1.5e-13);
  EXPECT_EQ(c.friction.kind, FrictionLaw::Kind::exponential);
  EXPECT_DOUBLE_EQ(c.friction.half_velocity_1, 1.25);
  EXPECT_DOUBLE_EQ(c.friction.memory_distance, 3e-6);
  EXPECT_DOUBLE_EQ(c.friction.memory_velocity, 1e-3);
  EXPECT_DOUBLE_EQ(c.solver.eps, 1e-6);
  EXPECT_EQ(c.solver.max_outer, 50);
}

TEST(TomlCase, ShapesFromFilesAndArcs) {
  const CaseFile f = parse_study(R"(
wheelset.vertical_force_N = 1e5
[wheel.shape]
file = 'profiles\wheel.prw'
mirror_y = true
mirror_z = "no"
scale_to_mm = 1000
smoothing_wavelength_mm = 6
smoothing_method = "weighted_bspline"
kink_high_deg = 20
kink_width_mm = 3
zigzag_threshold_deg = 120
max_omit = 0.2
[rail.shape]
start_y_mm = -30
start_angle_deg = -10
arcs = [ { length_mm = 20, radius_mm = 80 }, { length_mm = 20, curvature_per_m = 3.5 }, { length_mm = 5 } ]
)");
  const GeometryFile& wheel = std::get<GeometryFile>(rail_case(f, 0).wheel.geometry);
  EXPECT_EQ(wheel.file, "folder/profiles/wheel.prw");
  EXPECT_EQ(wheel.options.mirror_y, 1);
  EXPECT_EQ(wheel.options.mirror_z, -1);
  EXPECT_DOUBLE_EQ(wheel.options.scale, 1000.0);
  EXPECT_EQ(wheel.options.smoothing.method, SmoothingOptions::Method::weighted_bspline);
  EXPECT_DOUBLE_EQ(wheel.options.smoothing.strength, 6e-3);
  EXPECT_DOUBLE_EQ(wheel.options.smoothing.kink_high, 20 * kDegree);
  EXPECT_DOUBLE_EQ(wheel.options.smoothing.kink_low, 4 * kDegree);
  EXPECT_DOUBLE_EQ(wheel.options.smoothing.kink_width, 3e-3);
  EXPECT_DOUBLE_EQ(wheel.options.zigzag_threshold, 120 * kDegree);
  const ArcChain& rail = std::get<ArcChain>(rail_case(f, 0).rail.geometry);
  ASSERT_EQ(rail.segments.size(), 3u);
  EXPECT_DOUBLE_EQ(rail.start_y, -30e-3);
  EXPECT_DOUBLE_EQ(rail.start_angle, -10 * kDegree);
  EXPECT_DOUBLE_EQ(rail.segments[0].curvature, 12.5);
  EXPECT_DOUBLE_EQ(rail.segments[1].curvature, 3.5);
  EXPECT_DOUBLE_EQ(rail.segments[2].curvature, 0.0);
}

TEST(TomlCase, SmoothingIsAWordOrAWavelength) {
  using Method = SmoothingOptions::Method;
  const auto options = [](const std::string& line) {
    const CaseFile f = parse_study(
        "wheelset.vertical_force_N = 1e5\nrail.shape.standard = \"60E1\"\nwheel.shape.file = \"w.csv\"\n" + line);
    return std::get<GeometryFile>(rail_case(f, 0).wheel.geometry).options.smoothing;
  };
  EXPECT_EQ(options("").method, Method::by_noise);
  EXPECT_EQ(options("wheel.shape.smoothing = \"auto\"\n").method, Method::by_noise);
  EXPECT_EQ(options("wheel.shape.smoothing = \"none\"\n").method, Method::spline);
  EXPECT_EQ(options("wheel.shape.smoothing = \"none\"\n").strength, 0.0);
  EXPECT_EQ(options("wheel.shape.smoothing = 6\n").method, Method::weighted_spline);
  EXPECT_DOUBLE_EQ(options("wheel.shape.smoothing = 6\n").strength, 6e-3);
  EXPECT_EQ(options("wheel.shape.smoothing_lambda_mm3 = 0\n").method, Method::spline);
}

TEST(TomlCase, CasesOverrideDefaultsAndListsSweep) {
  const CaseFile f = parse_study(kRail + R"(
wheelset.y_mm = 1
[[cases]]
[[cases]]
wheelset.y_mm = 2
friction.coefficient = 0.1
[[cases]]
wheelset.pitch_deg = [-1, 0, 1.5]
wheelset.y_mm = [3, 4, 5]
[[cases]]
wheelset.z_mm = 0.1
wheel.shape.file = "other.prw"
)",
                                 {});
  ASSERT_EQ(f.cases.size(), 6u);
  EXPECT_DOUBLE_EQ(rail_case(f, 0).state.position.y, 1e-3);
  EXPECT_DOUBLE_EQ(rail_case(f, 1).state.position.y, 2e-3);
  EXPECT_DOUBLE_EQ(rail_case(f, 1).friction.kinetic, 0.1);
  EXPECT_DOUBLE_EQ(rail_case(f, 2).friction.kinetic, 0.3);
  EXPECT_DOUBLE_EQ(rail_case(f, 4).state.position.y, 5e-3);
  EXPECT_DOUBLE_EQ(rail_case(f, 4).state.position.pitch, 1.5 * kDegree);
  EXPECT_FALSE(rail_case(f, 5).vertical_force_prescribed);
  EXPECT_TRUE(rail_case(f, 4).vertical_force_prescribed);
  EXPECT_EQ(std::get<GeometryFile>(rail_case(f, 5).wheel.geometry).file, "folder/other.prw");
  EXPECT_LT(f.cases[0].where.line, f.cases[1].where.line);
}

TEST(TomlCase, PatchWithHertzianGeometry) {
  const CaseFile f = parse_study(kPatch + R"(
creepage_x = -1e-3
spin_rad_m = 0.5
rolling_step_mm = 0.4
rolling_direction_deg = 180
velocity_m_s = 30
normal_model = "parabolic"
tangential_model = "fastsim"
fastsim_k0 = 0.5
[case]
regime = "steady"
[[cases]]
patch.creepage_y = [0.0, 1e-3]
[[cases]]
patch.force_x_relative = -0.5
)");
  ASSERT_EQ(f.cases.size(), 3u);
  const BasicCase& c = basic_case(f, 1);
  EXPECT_DOUBLE_EQ(c.normal_force, 1e3);
  EXPECT_EQ(c.regime, Regime::steady);
  EXPECT_DOUBLE_EQ(c.xi, -1e-3);
  EXPECT_DOUBLE_EQ(c.eta, 1e-3);
  EXPECT_DOUBLE_EQ(c.phi, 0.5);
  EXPECT_DOUBLE_EQ(c.dq, 0.4e-3);
  EXPECT_DOUBLE_EQ(c.chi, std::numbers::pi);
  EXPECT_EQ(c.normal_model, NormalModel::parabolic);
  EXPECT_EQ(c.tangential_model, TangentialModel::fastsim);
  EXPECT_DOUBLE_EQ(c.fastsim.k0, 0.5);
  const HertzInput& h = std::get<HertzInput>(c.geometry);
  EXPECT_EQ(h.given, HertzInput::Given::semi_axes);
  EXPECT_DOUBLE_EQ(h.aa, 4e-3);
  EXPECT_DOUBLE_EQ(basic_case(f, 2).fx_relative.value(), -0.5);
  EXPECT_DOUBLE_EQ(basic_case(f, 2).xi, 0.0);
}

TEST(TomlCase, PatchWithGapFormula) {
  const BasicCase c = basic_case(parse_study(R"(
case.regime = "shift"
[patch]
approach_mm = 0.01
shift_x_mm = 0.005
mx = 3
my = 2
x0_mm = -1
y0_mm = -0.5
dx_mm = 1
dy_mm = 1
gap.kind = "quadratic"
gap.coefficients_si = [1, 0, 2.5, 0, 0, 0]
)"),
                                 0);
  EXPECT_FALSE(c.normal_force_prescribed);
  EXPECT_DOUBLE_EQ(c.approach, 1e-5);
  EXPECT_DOUBLE_EQ(c.xi, 5e-6);
  EXPECT_DOUBLE_EQ(c.x0, -1e-3);
  EXPECT_THAT(std::get<GapInput>(c.geometry).coefficients, ::testing::ElementsAre(1.0, 0.0, 2.5, 0.0, 0.0, 0.0));
}

TEST(TomlOverride, ValuesWordsAndListElements) {
  const std::string text =
      kRail + "[[wheel.flats]]\nlength_mm = 100\ndepth_mm = 1\n[[cases]]\nwheelset.y_mm = [1, 2]\n";
  const CaseFile f = parse_study(
      text, {"wheelset.y_mm=3", "wheel.backend = spline", "rail.shape.standard=60E1", "track.cant=1:20",
             "wheel.flats.0.depth_mm=0.5", "case.side=\"left\"", "discretisation.reference_search_mesh=true"});
  ASSERT_EQ(f.cases.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const WheelRailCase& c = rail_case(f, i);
    EXPECT_DOUBLE_EQ(c.state.position.y, 3e-3);
    EXPECT_EQ(c.wheel.backend, "spline");
    EXPECT_EQ(std::get<StandardProfile>(c.rail.geometry).name, "60E1");
    EXPECT_DOUBLE_EQ(c.track.cant, std::atan(0.05));
    EXPECT_DOUBLE_EQ(c.wheel.defects.flats.at(0).depth, 0.5e-3);
    EXPECT_DOUBLE_EQ(c.wheel.defects.flats.at(0).length, 0.1);
    EXPECT_EQ(c.side, Side::left);
    EXPECT_EQ(c.discretisation.conventions, Conventions::contact);
  }
}

TEST(TomlOverride, OneCaseStaysAsItWasOnError) {
  CaseFile f = parse_study(kRail);
  Case& c = f.cases[0];
  apply_override(c, "wheelset.y_mm=3");
  EXPECT_DOUBLE_EQ(rail_case(f, 0).state.position.y, 3e-3);
  EXPECT_THROW(apply_override(c, "wheelset.y_mm=x"), Error);
  EXPECT_THROW(apply_override(c, "wheelset.vertical_force_N=-1"), Error);
  EXPECT_THROW(apply_override(c, "roller.pitch_rate_rad_s=4"), Error);
  EXPECT_DOUBLE_EQ(rail_case(f, 0).state.position.y, 3e-3);
  EXPECT_FALSE(rail_case(f, 0).roller);
}

TEST(AnyCase, ExtensionDecides) {
  EXPECT_THROW(read_any_case("x.yaml"), Error);
  EXPECT_THROW(read_any_case("does-not-exist.toml"), Error);
  EXPECT_THROW(read_any_case("does-not-exist.inp"), Error);
  EXPECT_THROW(read_any_case(std::string(TREADMARK_SOURCE_DIR) + "/examples"), Error);
}

}  // namespace
}  // namespace treadmark::io
