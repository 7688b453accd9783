// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/backends/spline/make.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/tests/solvers/wheelrail/patch_on_reference.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::wheelrail {
namespace {

using testing::PatchOnReference;
using testing::solve_patch;

/// The reference interpolates the wheel linearly between points 0.25 mm apart; a position is printed to four digits.
constexpr double kClose = 1.5e-3;
/// Power follows the square of the contact's width, which that interpolation makes narrower.
constexpr double kPower = 1e-2;
/// The fit over the interpenetration of a groove depends on which elements at its steep edges belong to it; total slip
/// does not.
constexpr double kFit = 1.5e-2;

nlohmann::json case_of(const std::filesystem::path& shared, const std::string& name, int number) {
  for (const auto& entry : nlohmann::json::parse(std::ifstream(shared / "reference" / (name + ".json"))))
    if (entry.at("case") == number) return entry;
  throw std::runtime_error("no such case");
}

std::shared_ptr<const Surface> read(const std::filesystem::path& file, Body body, double radius) {
  return spline::make_profile_surface(io::read_profile(file, body, {}), radius);
}

void expect_close(double ours, double printed, double tolerance, const char* what) {
  EXPECT_NEAR(ours, printed, tolerance * std::abs(printed)) << what;
}

/// Deep-groove rolling after Li (2002) at the position and the pitch rate that were found for 10 kN and no longitudinal
/// force.
PatchOnReference expect_groove(const std::filesystem::path& shared, int number,
                               const kalker::InfluenceSettings& influence) {
  const char* grooves[] = {"groove_r1025.prr", "groove_r1010.prr", "groove_r1005.prr", "groove_r1002.prr"};
  const auto profiles = shared / "data" / "contact_testbank" / "profiles";
  const double radius = 0.42;
  const Geometry geometry{read(profiles / grooves[(number - 1) % 4], Body::rail, 0.0),
                          read(profiles / "circ_r10.prw", Body::wheel, radius), true, true};
  const auto expected = case_of(shared, "tb_groove_li", number);
  const auto& patch = expected.at("patches").at(0);

  Problem p;
  p.track.gauge_based = false;
  p.wheelset = {0.0, 0.0, radius, std::nullopt};
  p.state.position.z = 1e-3 * patch.at("approach_mm").get<double>();  // the contact angle is zero
  p.state.velocity.x = 0.42;
  p.state.velocity.pitch = expected.at("wheelset_velocity").at("vpitch_rad_s");
  p.discretisation.dx = 0.095833e-3;
  p.discretisation.ds = 0.25e-3;
  p.material.shear_modulus_1 = p.material.shear_modulus_2 = 80e9;
  p.solver.eps = 1e-7;
  p.influence = influence;
  p.reference_surface = ReferenceSurface::curved;
  const PatchOnReference ours = solve_patch(geometry, p);
  EXPECT_NEAR(ours.undeformed.approach, p.state.position.z, 1e-8);
  expect_close(ours.force_T.z(), expected.at("force_on_rail").at("fz_tr_N"), kClose, "vertical force");
  expect_close(ours.contact.force_n, patch.at("fn_tilde_N"), kClose, "sum of local normal forces");
  expect_close(1e-6 * ours.contact.max_pressure, patch.at("pmax_MPa"), kClose, "greatest pressure");
  expect_close(ours.contact.elastic_energy, patch.at("elastic_energy_J"), 2.0 * kClose, "energy");
  EXPECT_NEAR(ours.force_T.x(), 0.0, 2.0 * kClose * 0.3 * ours.contact.force_n) << "longitudinal force";
  expect_close(ours.contact.frictional_power, patch.at("frictional_power_W"), kPower, "power");
  expect_close(ours.slip.kinematics.xi, patch.at("kinematics").at("xi"), kFit, "creepage");
  const auto& elements = patch.at("elements");
  EXPECT_EQ(static_cast<int>(ours.grid.size()), elements.at("npot").get<int>());
  expect_close(ours.contact.elements_contact, elements.at("ncon"), 5e-3, "elements in contact");
  expect_close(ours.contact.elements_slip, elements.at("nslip"), 2e-2, "elements in slip");
  return ours;
}

TEST(ConformalReference, GrooveWithHalfSpaceCoefficients) {
  TREADMARK_REQUIRE_SHARED();
  for (int number = 1; number <= 4; ++number) {
    SCOPED_TRACE(number);
    expect_groove(*shared, number, {});
  }
}

TEST(ConformalReference, GrooveWithAngleCorrectedCoefficients) {
  TREADMARK_REQUIRE_SHARED();
  kalker::InfluenceSettings influence;
  influence.kind = kalker::InfluenceSettings::Kind::angle_corrected;
  influence.variant = 3;
  influence.linear = false;
  for (int number = 5; number <= 8; ++number) {
    SCOPED_TRACE(number);
    expect_groove(*shared, number, influence);
  }
}

/// Manchester benchmark with friction by inclination (case 5) or along the track (case 7).
void expect_flange_root(const std::filesystem::path& shared, int number, const Problem& friction) {
  const auto data = shared / "data" / "contact_examples";
  const Geometry geometry{read(data / "MBench_UIC60_v3.prr", Body::rail, 0.0),
                          read(data / "MBench_S1002_v3.prw", Body::wheel, 0.46), true, true};
  const auto expected = case_of(shared, "mbench_a22_varfric", number);
  Problem p = friction;
  p.wheelset = {1.360, -0.070, 0.46, std::nullopt};
  p.state.position = {0.0, 5.5e-3, 0.0, -0.00047770, 0.0132, 0.0};
  p.state.velocity = {2.0, 0.0, 0.0, 0.0, 0.0, -4.33188640};
  p.discretisation.dx = p.discretisation.ds = 0.2e-3;
  p.discretisation.separation = 9e-3;
  p.discretisation.combination = 5e-3;
  p.reference_surface = ReferenceSurface::curved;
  // The position is printed to 0.1 um, the approach to be is 30 um: the force decides between the printed digits.
  p.state.position.z = 1e-3 * (expected.at("wheelset").at("z_mm").get<double>() + 0.00008);
  const PatchOnReference ours = solve_patch(geometry, p);
  const auto& force = expected.at("force_on_rail");
  const double scale = force.at("fz_tr_N").get<double>() / ours.force_T.z();
  EXPECT_NEAR(scale, 1.0, 1e-3);
  expect_close(scale * ours.force_T.x(), force.at("fx_tr_N"), kClose, "longitudinal force");
  expect_close(scale * ours.force_T.y(), force.at("fy_tr_N"), kClose, "lateral force");
  const auto& k = expected.at("patches").at(0).at("kinematics");
  EXPECT_NEAR(ours.slip.kinematics.velocity, 1e-3 * k.at("velocity_mm_s").get<double>(), 1e-9);
  expect_close(ours.slip.kinematics.xi, k.at("xi"), kClose, "xi");
  expect_close(ours.slip.kinematics.eta, k.at("eta"), kClose, "eta");
  expect_close(ours.slip.kinematics.phi, 1e3 * k.at("phi").get<double>(), kClose, "phi");
  EXPECT_NEAR(ours.contact.elements_contact, expected.at("patches").at(0).at("elements").at("ncon").get<int>(), 2);
}

TEST(ConformalReference, FlangeRootWithFrictionByInclination) {
  TREADMARK_REQUIRE_SHARED();
  Problem p;
  FrictionLaw low, high;
  low.kinetic = 0.2;
  high.kinetic = 0.3;
  constexpr double kDegree = M_PI / 180.0;
  p.friction_inclination = {-20.0 * kDegree, -10.0 * kDegree};
  p.friction_laws = {low, high};
  expect_flange_root(*shared, 5, p);
}

TEST(ConformalReference, FlangeRootWithFrictionAlongTheTrack) {
  TREADMARK_REQUIRE_SHARED();
  Problem p;
  p.friction.kinetic = 0.27;  // between 0.2 and 0.3 at 70 of 100 m
  expect_flange_root(*shared, 7, p);
}

/// A worn wheel in the gauge corner of a worn rail: three parts, 60 mm apart along the rail's section, on one curve
/// whose plane leans by 66 degrees. The reference gives 1820 MPa and 1600 elements.
struct WornPair {
  Geometry geometry;
  Problem problem;

  explicit WornPair(const std::filesystem::path& shared) {
    const auto profiles = shared / "data" / "contact_testbank" / "profiles";
    constexpr double kRadius = 0.444, kDegree = M_PI / 180.0;
    geometry = {read(profiles / "site_b_hr.prr", Body::rail, 0.0),
                read(profiles / "worn_high_mileage.prw", Body::wheel, kRadius), true, true};
    Problem& p = problem;
    p.track.gauge_height = 15.875e-3;
    p.track.gauge_width = 1.4351;
    p.wheelset = {1.3474, 0.0, kRadius, std::nullopt};
    p.state.position = {0.0, 14.85e-3, 1.17e-3, -0.0013, 0.005, 0.0};
    p.state.velocity.x = 15.0;
    p.state.velocity.pitch = -32.1;
    p.discretisation.dx = p.discretisation.ds = 0.4e-3;
    p.discretisation.angle_separation = 0.5 * M_PI;
    p.discretisation.separation = 30e-3;
    p.discretisation.combination = 20e-3;
    p.discretisation.turning = 40e-3;
    p.discretisation.search = Discretisation::SearchGrid::reference_locus;
    p.solver.eps = 1e-6;
    p.solver.conventions = Conventions::contact;
    FrictionLaw low, high;
    low.kinetic = 0.2;
    high.kinetic = 0.35;
    p.friction_inclination = {-30.0 * kDegree, -20.0 * kDegree};
    p.friction_laws = {low, high};
    p.reference_surface = ReferenceSurface::curved;
  }
};

TEST(ConformalReference, WornPairWithThreePartsOnASteepPlane) {
  TREADMARK_REQUIRE_SHARED();
  const WornPair pair(*shared);
  const PairSolution solution = Pair(pair.geometry).solve(pair.problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_EQ(solution.message, "");
  ASSERT_EQ(solution.patches.size(), 1u);
  const PatchSolution& patch = solution.patches[0];
  EXPECT_NEAR(1e-6 * patch.contact.max_pressure, 1820.0, 0.01 * 1820.0);
  EXPECT_NEAR(patch.contact.elements_contact, 1600, 0.02 * 1600);
}

TEST(ConformalReference, WornPairFindsItsHeightThoughTractionsTurnTheForce) {
  // The flange carries most: every change of the tractions moves the wheel, round by round.
  TREADMARK_REQUIRE_SHARED();
  WornPair pair(*shared);
  pair.problem.vertical_force = 94e3;
  // Every round has iterations of its own: together there may be more than of one.
  pair.problem.max_force_iterations = 12;
  const PairSolution solution = Pair(pair.geometry).solve(pair.problem);
  ASSERT_EQ(solution.status, Status::ok) << solution.message;
  EXPECT_NEAR(solution.load.track.force.z(), 94e3, 1e-5 * 94e3);
  EXPECT_GT(solution.force_iterations.size(), 12u);
}

}  // namespace
}  // namespace treadmark::wheelrail
