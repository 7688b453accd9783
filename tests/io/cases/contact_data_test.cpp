// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/tests/io/cases/parsed_cases.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

using namespace testing;
using treadmark::testing::content_of;

namespace fs = std::filesystem;
fs::path example(const fs::path& shared, const std::string& name) {
  return shared / "data" / "contact_examples" / name;
}

TEST(ContactData, Wheelflat) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "wheelflat.inp"));
  ASSERT_EQ(f.cases.size(), 26u);
  for (std::size_t i = 0; i < 26; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(f.cases[i].number, static_cast<int>(i) + 1);
    const WheelRailCase& c = rail_case(f, i);
    EXPECT_EQ(c.side, Side::right);
    EXPECT_EQ(c.regime, Regime::steady);
    EXPECT_NEAR(c.state.position.pitch, (-25.0 - static_cast<double>(i)) * kDegree, 1e-12);
    EXPECT_DOUBLE_EQ(c.state.velocity.x, 2.0);
    EXPECT_DOUBLE_EQ(c.state.velocity.pitch, -4.08190679);
    EXPECT_TRUE(c.vertical_force_prescribed);
    EXPECT_DOUBLE_EQ(c.vertical_force, 125e3);
    EXPECT_DOUBLE_EQ(c.wheelset.nominal_radius, 0.49);
    EXPECT_DOUBLE_EQ(c.track.cant, 0.02);
    EXPECT_DOUBLE_EQ(c.discretisation.dx, 0.4e-3);
    EXPECT_DOUBLE_EQ(c.discretisation.angle_separation, 90 * kDegree);
    EXPECT_EQ(c.discretisation.method, 2);
    EXPECT_DOUBLE_EQ(c.material.shear_modulus_1, 82e9);
    EXPECT_DOUBLE_EQ(c.friction.kinetic, 0.3);
    const auto& wheel = std::get<GeometryFile>(c.wheel.geometry);
    EXPECT_EQ(wheel.file, example(*shared, "S1002_flat.slcw"));
    EXPECT_EQ(wheel.options.mirror_z, -1);
    EXPECT_DOUBLE_EQ(wheel.options.smoothing.strength, 5e-9);
    EXPECT_EQ(std::get<GeometryFile>(c.rail.geometry).file, example(*shared, "r300_wide.prr"));
    EXPECT_DOUBLE_EQ(std::get<GeometryFile>(c.rail.geometry).options.smoothing.strength, 0.0);
  }
  EXPECT_EQ(f.cases[0].where.line, 7);
  EXPECT_EQ(f.sha256, sha256_hex(content_of(example(*shared, "wheelflat.inp"))));
}

TEST(ContactData, ManchesterBenchmark) {
  TREADMARK_REQUIRE_SHARED();
  for (const bool left : {true, false}) {
    const CaseFile f = read_contact_input(example(*shared, left ? "mbench_a22_left.inp" : "mbench_a22_right.inp"));
    ASSERT_EQ(f.cases.size(), 21u);
    for (std::size_t i = 0; i < 21; ++i) {
      SCOPED_TRACE(i);
      const WheelRailCase& c = rail_case(f, i);
      EXPECT_EQ(c.side, left ? Side::left : Side::right);
      EXPECT_NEAR(c.state.position.y, 0.5e-3 * static_cast<double>(i), 1e-12);
      EXPECT_NEAR(c.state.position.yaw, 1.2e-3 * static_cast<double>(i), 1e-12);
      EXPECT_DOUBLE_EQ(c.vertical_force, 10e3);
      EXPECT_DOUBLE_EQ(c.discretisation.dx, 0.2e-3);
      EXPECT_DOUBLE_EQ(c.track.gauge_width, 1.435);
      EXPECT_DOUBLE_EQ(c.track.cant, 0.0);
      EXPECT_DOUBLE_EQ(c.wheelset.nominal_radius, 0.46);
      EXPECT_EQ(std::get<GeometryFile>(c.wheel.geometry).file.filename(), "MBench_S1002_v3.prw");
    }
    EXPECT_DOUBLE_EQ(rail_case(f, 1).state.position.roll, -0.00002304);
    EXPECT_DOUBLE_EQ(rail_case(f, 2).state.velocity.pitch, -4.34657520);
  }
}

TEST(ContactData, Cattaneo) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "cattaneo.inp"));
  ASSERT_EQ(f.cases.size(), 2u);
  const BasicCase &first = basic_case(f, 0), &second = basic_case(f, 1);
  EXPECT_EQ(first.regime, Regime::frictionless);
  EXPECT_DOUBLE_EQ(first.normal_force, 9.1954);
  EXPECT_DOUBLE_EQ(first.material.shear_modulus_1, 200e6);
  EXPECT_DOUBLE_EQ(first.material.poisson_2, 0.42);
  const HertzInput& h = std::get<HertzInput>(first.geometry);
  EXPECT_EQ(h.given, HertzInput::Given::semi_axes);
  EXPECT_DOUBLE_EQ(h.aa, 1e-3);
  EXPECT_DOUBLE_EQ(h.scale, 1.26667);
  EXPECT_EQ(first.mx * first.my, 361);
  EXPECT_EQ(second.regime, Regime::shift);
  EXPECT_DOUBLE_EQ(second.fx_relative.value(), -0.875);
  EXPECT_DOUBLE_EQ(second.fy_relative.value(), 0.0);
  EXPECT_DOUBLE_EQ(second.dx, 0.13333e-3);
  EXPECT_NEAR(second.x0, -1.26667e-3 + 0.5 * 0.13333e-3, 1e-15);
  EXPECT_DOUBLE_EQ(std::get<GapInput>(second.geometry).coefficients.at(2), 10.0);
  EXPECT_DOUBLE_EQ(second.solver.eps, 1e-4);  // kept by G = 1
}

TEST(ContactData, Carter) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "carter2d.inp"));
  ASSERT_EQ(f.cases.size(), 1u);
  const BasicCase& c = basic_case(f, 0);
  EXPECT_DOUBLE_EQ(c.normal_force, 35780.0);
  EXPECT_DOUBLE_EQ(c.xi, -0.00024);
  EXPECT_DOUBLE_EQ(c.dq, 0.0401e-3);
  EXPECT_DOUBLE_EQ(c.velocity, 30.0);
  EXPECT_EQ(c.mx, 55);
  EXPECT_EQ(c.my, 1);
  EXPECT_DOUBLE_EQ(c.x0, -1.05e-3);
  EXPECT_DOUBLE_EQ(c.dy, 0.2);
  EXPECT_DOUBLE_EQ(std::get<GapInput>(c.geometry).coefficients.at(0), 1.0);
}

TEST(ContactData, TractionCurve) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "tractcurv.inp"));
  ASSERT_EQ(f.cases.size(), 120u);
  for (std::size_t i = 0; i < 120; ++i) {
    SCOPED_TRACE(i);
    const BasicCase& c = basic_case(f, i);
    const std::size_t series = i / 30;
    EXPECT_DOUBLE_EQ(c.normal_force, 106700.0);
    EXPECT_EQ(c.mx, 48);
    EXPECT_EQ(c.my, 44);
    const HertzInput& h = std::get<HertzInput>(c.geometry);
    EXPECT_DOUBLE_EQ(h.a1, 0.8);
    EXPECT_DOUBLE_EQ(h.aob, 0.5);
    EXPECT_DOUBLE_EQ(c.velocity, 10.0);
    EXPECT_EQ(c.tangential_model, series >= 2 ? TangentialModel::fastsim : TangentialModel::full);
    EXPECT_EQ(c.normal_model, series >= 2 ? NormalModel::parabolic : NormalModel::full);
    EXPECT_EQ(c.friction.kind, series % 2 == 1 ? FrictionLaw::Kind::exponential : FrictionLaw::Kind::coulomb);
    EXPECT_NEAR(c.material.layer_flexibility, series == 1 ? 1.25e-3 / 8.2e9 : 0.0, 1e-20);
    EXPECT_DOUBLE_EQ(c.fastsim.k0, series == 3 ? 0.54 : 1.0);
    if (i % 30 == 0) {
      EXPECT_DOUBLE_EQ(c.xi, 1e-5);
    }
  }
  EXPECT_DOUBLE_EQ(basic_case(f, 3).xi, 0.0012);
  EXPECT_DOUBLE_EQ(basic_case(f, 40).friction.kinetic, 0.14);
  EXPECT_DOUBLE_EQ(basic_case(f, 40).friction.amplitude_1, 0.19);
  EXPECT_DOUBLE_EQ(basic_case(f, 40).friction.half_velocity_1, 1.25);
  EXPECT_DOUBLE_EQ(basic_case(f, 40).friction.memory_distance, 3e-6);
  EXPECT_DOUBLE_EQ(basic_case(f, 119).friction.half_velocity_1, 0.99);
  EXPECT_DOUBLE_EQ(basic_case(f, 119).fastsim.alpha, 0.02);
}

TEST(ContactData, Bentall) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "bentall.inp"));
  ASSERT_EQ(f.cases.size(), 6u);
  const BasicCase& c = basic_case(f, 3);
  EXPECT_DOUBLE_EQ(c.material.shear_modulus_1, 23e9);
  EXPECT_DOUBLE_EQ(c.chi, std::numbers::pi);
  EXPECT_EQ(c.solver.max_coupling, 10);
  EXPECT_EQ(basic_case(f, 0).solver.max_coupling, 1);
  EXPECT_DOUBLE_EQ(c.friction.kinetic, 0.05);
  EXPECT_EQ(c.history, HistoryUse::start);
}

TEST(ContactData, CattaneoToCarter) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "catt_to_cart.inp"));
  ASSERT_EQ(f.cases.size(), 171u);
  EXPECT_EQ(basic_case(f, 0).regime, Regime::shift);
  EXPECT_EQ(basic_case(f, 0).history, HistoryUse::start);
  for (const std::size_t i : {1u, 2u, 6u}) {
    EXPECT_EQ(basic_case(f, i).regime, Regime::transient);
    EXPECT_EQ(basic_case(f, i).history, HistoryUse::keep_going);
    EXPECT_DOUBLE_EQ(basic_case(f, i).dq, 0.25e-3);
    EXPECT_EQ(f.cases[i].sequence, 0);
  }
}

TEST(ContactData, SpenceWithSubsurfacePoints) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "spence35.inp"));
  ASSERT_EQ(f.cases.size(), 35u);
  for (std::size_t i = 0; i < 35; ++i) {
    const BasicCase& c = basic_case(f, i);
    EXPECT_EQ(c.history, i == 0 ? HistoryUse::start : HistoryUse::keep_going);
    ASSERT_EQ(c.subsurface.blocks.size(), 1u) << i;
    EXPECT_EQ(c.subsurface.blocks[0].columns.size(), 45u);
    EXPECT_THAT(c.subsurface.blocks[0].rows, ::testing::ElementsAre(22));
    EXPECT_DOUBLE_EQ(c.subsurface.blocks[0].z.at(0), 1e-9);
    EXPECT_TRUE(c.subsurface.text_table);
  }
  EXPECT_DOUBLE_EQ(basic_case(f, 1).normal_force, 0.000088);
}

TEST(ContactData, FastsimAndKpec) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "fastsim.inp"));
  ASSERT_EQ(f.cases.size(), 8u);
  EXPECT_EQ(basic_case(f, 0).tangential_model, TangentialModel::full);
  EXPECT_EQ(basic_case(f, 1).tangential_model, TangentialModel::fastsim);
  EXPECT_EQ(basic_case(f, 1).normal_model, NormalModel::parabolic);
  EXPECT_EQ(basic_case(f, 3).tangential_model, TangentialModel::fastrip);
  const CaseFile k = read_contact_input(example(*shared, "mbench_a22_kpec.inp"));
  ASSERT_EQ(k.cases.size(), 9u);
  EXPECT_EQ(rail_case(k, 0).normal_model, NormalModel::kpec);
  EXPECT_EQ(rail_case(k, 3).normal_model, NormalModel::analyn);
  EXPECT_EQ(rail_case(k, 0).tangential_model, TangentialModel::fastsim);
  EXPECT_EQ(rail_case(k, 6).normal_model, NormalModel::full);
}

TEST(ContactData, VelocityDependentFriction) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "veldep_fric.inp"));
  ASSERT_EQ(f.cases.size(), 53u);
  const BasicCase &steady = basic_case(f, 0), &transient = basic_case(f, 1), &third = basic_case(f, 3);
  EXPECT_EQ(steady.solver.method, SolverSettings::Method::sweeps);
  EXPECT_EQ(steady.solver.first_slip, SolverSettings::FirstSlip::below);
  EXPECT_DOUBLE_EQ(steady.friction.kinetic, 0.18);
  EXPECT_DOUBLE_EQ(steady.friction.half_velocity_1, 0.1);
  EXPECT_EQ(transient.solver.method, SolverSettings::Method::automatic);
  EXPECT_EQ(transient.regime, Regime::transient);
  EXPECT_EQ(third.solver.first_slip, SolverSettings::FirstSlip::above);
}

TEST(ContactData, ViscoelasticPlasticAndThermal) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile v = read_contact_input(example(*shared, "visc_cylindr.inp"));
  ASSERT_EQ(v.cases.size(), 6u);
  EXPECT_DOUBLE_EQ(basic_case(v, 1).material.creep_ratio_2, 1.0);
  EXPECT_DOUBLE_EQ(basic_case(v, 1).material.relaxation_time_1, 0.009);
  EXPECT_DOUBLE_EQ(basic_case(v, 0).material.relaxation_time_1, 0.0);
  const CaseFile p = read_contact_input(example(*shared, "plastic_3bl.inp"));
  ASSERT_EQ(p.cases.size(), 57u);
  EXPECT_DOUBLE_EQ(basic_case(p, 0).material.layer_yield, 0.0);
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_DOUBLE_EQ(basic_case(p, i).material.layer_yield, 560e6);
    EXPECT_DOUBLE_EQ(basic_case(p, i).material.layer_flexibility, 0.02e-3 / 176.63e6);
  }
  EXPECT_EQ(basic_case(p, 2).history, HistoryUse::keep_going);
  const CaseFile t = read_contact_input(example(*shared, "ertz_temperature.inp"));
  ASSERT_EQ(t.cases.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(basic_case(t, i).thermal);
    EXPECT_DOUBLE_EQ(basic_case(t, i).thermal->body_2.bulk_temperature, i == 0 ? 0.0 : 150.0);
    EXPECT_DOUBLE_EQ(basic_case(t, i).thermal->body_1.conductivity, 50.0);
  }
}

TEST(ContactData, ConformalExtraSlipAndSubsurface) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(example(*shared, "conformal.inp"));
  ASSERT_EQ(f.cases.size(), 3u);
  const BasicCase& c = basic_case(f, 2);
  ASSERT_EQ(c.extra_slip_x.size(), 51u * 39u);
  EXPECT_DOUBLE_EQ(c.extra_slip_x.front(), -0.01880288);
  EXPECT_DOUBLE_EQ(c.extra_slip_y.at(1), 0.0203985);
  EXPECT_EQ(std::get<GapInput>(c.geometry).coefficients.size(), 51u * 39u);
  EXPECT_TRUE(basic_case(f, 1).extra_slip_x.empty());
  const CaseFile s = read_contact_input(example(*shared, "subsurf.inp"));
  ASSERT_EQ(s.cases.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(basic_case(s, i).subsurface.blocks.size(), 2u);
    EXPECT_EQ(basic_case(s, i).subsurface.blocks[1].x.size(), 21u);
    EXPECT_DOUBLE_EQ(basic_case(s, i).subsurface.blocks[1].z.back(), 5e-3);
    EXPECT_TRUE(basic_case(s, i).subsurface.full_tensor);
  }
}

TEST(ContactData, TestBankFilesThatAreSupported) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path bank = *shared / "data" / "contact_testbank";
  const CaseFile flat = read_contact_input(bank / "examples_oor" / "rounded_flat_d09.inp");
  ASSERT_EQ(flat.cases.size(), 15u);
  EXPECT_NEAR(rail_case(flat, 14).state.position.pitch, 7 * kDegree, 1e-12);
  EXPECT_FALSE(rail_case(flat, 0).track.gauge_based);
  EXPECT_EQ(std::get<GeometryFile>(rail_case(flat, 0).wheel.geometry).file, bank / "profiles" / "flat_d09.slcw");
  for (const auto* name : {"two_patches.inp", "cross_brute.inp", "wing_brute.inp"}) {
    const CaseFile f = read_contact_input(bank / "examples_s+c" / name);
    ASSERT_EQ(f.cases.size(), 1u) << name;
    EXPECT_EQ(rail_case(f, 0).discretisation.method, 5) << name;
    EXPECT_DOUBLE_EQ(rail_case(f, 0).track.rail_y0, 0.75) << name;
    EXPECT_TRUE(fs::exists(std::get<GeometryFile>(rail_case(f, 0).rail.geometry).file)) << name;
  }
  const CaseFile two = read_contact_input(bank / "examples_s+c" / "two_patches.inp");
  EXPECT_DOUBLE_EQ(rail_case(two, 0).state.position.x, 0.16);
  EXPECT_DOUBLE_EQ(std::get<GeometryFile>(rail_case(two, 0).rail.geometry).options.scale, 1000.0);
  const CaseFile cross = read_contact_input(bank / "examples_s+c" / "cross_brute.inp");
  EXPECT_FALSE(rail_case(cross, 0).vertical_force_prescribed);
  EXPECT_DOUBLE_EQ(rail_case(cross, 0).state.position.z, -2.1275e-3);
}

TEST(ContactData, SequencesOfAWheelOnARail) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path bank = *shared / "data" / "contact_testbank" / "examples_trans";
  const CaseFile shift = read_contact_input(bank / "m1_catt_shift.inp");
  EXPECT_EQ(rail_case(shift, 0).regime, Regime::shift);
  EXPECT_EQ(rail_case(shift, 0).history, HistoryUse::start);
  EXPECT_DOUBLE_EQ(rail_case(shift, 0).state.velocity.x, 4e-3);
  EXPECT_DOUBLE_EQ(rail_case(shift, 0).state.velocity.pitch, -0.03984);
  EXPECT_EQ(rail_case(shift, 1).history, HistoryUse::keep_going);
  EXPECT_DOUBLE_EQ(rail_case(shift, 1).state.position.x, 0.2e-3);
  EXPECT_DOUBLE_EQ(rail_case(shift, 1).state.wheel_velocity.roll, rail_case(shift, 0).state.wheel_velocity.roll);

  const CaseFile rolling = read_contact_input(bank / "m1_trans_roll.inp");
  ASSERT_GT(rolling.cases.size(), 10u);
  for (std::size_t i = 0; i < rolling.cases.size(); ++i) {
    EXPECT_EQ(rail_case(rolling, i).regime, Regime::transient) << i;
    EXPECT_EQ(rail_case(rolling, i).history, i == 0 ? HistoryUse::start : HistoryUse::keep_going) << i;
    EXPECT_EQ(rolling.cases[i].sequence, 0) << i;
  }
}

TEST(ContactData, ConformalContactOfAGroove) {
  TREADMARK_REQUIRE_SHARED();
  const CaseFile f = read_contact_input(*shared / "data" / "contact_testbank" / "examples_conformal" / "groove_li.inp");
  for (std::size_t i = 0; i < f.cases.size(); ++i) {
    EXPECT_EQ(rail_case(f, i).reference_surface, ReferenceSurface::curved) << i;
    EXPECT_EQ(rail_case(f, i).discretisation.method, 2) << i;
    EXPECT_EQ(rail_case(f, i).longitudinal_force, std::optional(0.0)) << i;
  }
  EXPECT_EQ(rail_case(f, 0).influence.kind, InfluenceInput::Kind::constant);
  EXPECT_EQ(rail_case(f, f.cases.size() - 1).influence.kind, InfluenceInput::Kind::angle_corrected);
  EXPECT_TRUE(rail_case(f, f.cases.size() - 1).influence.position.empty());
}

std::vector<fs::path> all_inputs(const fs::path& shared) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(shared / "data"))
    if (entry.path().extension() == ".inp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  EXPECT_GE(files.size(), 25u) << "there is less to read than there was";
  return files;
}

TEST(ContactData, EveryFileIsRead) {
  TREADMARK_REQUIRE_SHARED();
  for (const fs::path& file : all_inputs(*shared)) EXPECT_NO_THROW(read_contact_input(file)) << file;
}

/// The text with R = 1 replaced by R = 3 in the third control word of every case; count tells how many.
std::string with_skipped_cases(const std::string& text, int& count) {
  std::stringstream in(text);
  std::string out;
  count = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.find("G-I-A-O-W-R") != std::string::npos) {
      const std::size_t end = line.find_first_not_of("0123456789", line.find_first_of("0123456789"));
      if (line.at(end - 1) == '1') {
        line[end - 1] = '3';
        ++count;
      }
    }
    out += line + '\n';
  }
  return out;
}

/// With every case marked as skipped (R = 3) nothing is refused, so each file must be understood to its last line.
TEST(ContactData, GrammarOfEveryFileIsReadToTheEnd) {
  TREADMARK_REQUIRE_SHARED();
  for (const fs::path& file : all_inputs(*shared)) {
    int count = 0;
    const std::string text = with_skipped_cases(content_of(file), count);
    ASSERT_GT(count, 0) << file;
    CaseFile f;
    ASSERT_NO_THROW(f = parse_contact_input(text, file)) << file;
    EXPECT_EQ(f.cases.size(), 0u) << file;
  }
}

TEST(ContactData, OverridesReachCasesOfContactInput) {
  TREADMARK_REQUIRE_SHARED();
  const std::vector<std::string> overrides{"wheelset.y_mm=3", "wheel.backend=spline"};
  const CaseFile f = read_any_case(example(*shared, "wheelflat.inp"), overrides);
  ASSERT_EQ(f.cases.size(), 26u);
  for (std::size_t i = 0; i < 26; ++i) {
    EXPECT_DOUBLE_EQ(rail_case(f, i).state.position.y, 3e-3);
    EXPECT_EQ(rail_case(f, i).wheel.backend, "spline");
  }
}

}  // namespace
}  // namespace treadmark::io
