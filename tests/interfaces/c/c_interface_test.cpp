// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "treadmark.h"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/cases/validate_case.hpp"
#include "treadmark/tests/interfaces/c/owned.hpp"

namespace treadmark {
namespace {

using ::testing::HasSubstr;

using namespace treadmark::testing;

TEST(CInterface, APairGivesTheNumbersOfTheProgram) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  const io::RunResult run = app::run_cases(io::parse_case_text(kText, "text"));
  const io::CaseResult& expected = run.cases.front();
  ASSERT_EQ(tm_solution_patches(s.get()), expected.patches.size());
  const io::PatchResult& patch = expected.patches.front();
  EXPECT_EQ(number(s.get(), 0, "fn"), patch.fn);
  EXPECT_EQ(number(s.get(), 0, "fx"), patch.fx);
  EXPECT_EQ(number(s.get(), 0, "pmax"), patch.pmax);
  EXPECT_EQ(number(s.get(), 0, "approach"), patch.approach);
  EXPECT_EQ(number(s.get(), 0, "reference.y_tr"), patch.y_tr);
  EXPECT_EQ(field(s.get(), 0, "pressure"), patch.fields.pressure);
  EXPECT_EQ(field(s.get(), 0, "traction_x"), patch.fields.traction_x);
  EXPECT_TRUE(field(s.get(), 0, "temperature_1").empty());
  EXPECT_TRUE(std::isnan(number(s.get(), 0, "max_temperature_1")));
  // what smaller elements would change is estimated by runs alone
  const auto estimated = ranges::count(expected.remarks, RemarkKind::coarse_elements, &Remark::kind);
  EXPECT_EQ(tm_solution_remarks(s.get()) + static_cast<std::size_t>(estimated), expected.remarks.size());
  EXPECT_STREQ(tm_solution_message(s.get()), "");
}

TEST(CInterface, PosesAndStatesAreThoseOfTheProgram) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  const io::RunResult run = app::run_cases(io::parse_case_text(kText, "text"));
  const io::CaseResult& expected = run.cases.front();
  double origin[3], rotation[9];
  const auto is = [&](const Pose& pose) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(origin[i], pose.origin[i]);
      for (int k = 0; k < 3; ++k) EXPECT_EQ(rotation[3 * i + k], pose.rotation(i, k));
    }
  };
  ASSERT_EQ(tm_solution_pose(s.get(), TM_WHEEL, origin, rotation), TM_OK) << tm_message();
  is(expected.bodies->X_TA);
  ASSERT_EQ(tm_solution_pose(s.get(), TM_RAIL, origin, rotation), TM_OK);
  is(expected.bodies->X_TS);
  ASSERT_EQ(tm_patch_pose(s.get(), 0, origin, rotation), TM_OK);
  is(expected.patches.front().fields.X_TC);
  const std::uint8_t* states = nullptr;
  ASSERT_EQ(tm_patch_states(s.get(), 0, &states), TM_OK);
  const std::vector<std::uint8_t>& all = expected.patches.front().fields.state;
  EXPECT_EQ(std::vector<std::uint8_t>(states, states + all.size()), all);
}

TEST(CInterface, TheTextOfACaseReadsAsTheSameCase) {
  const CaseOf given = case_of(kText);
  ASSERT_EQ(tm_case_set(given.get(), "wheelset.yaw_deg=0.5"), TM_OK) << tm_message();
  ASSERT_EQ(tm_case_set_number(given.get(), "wheelset.y", 1.0 / 300.0), TM_OK);
  char* text = nullptr;
  ASSERT_EQ(tm_case_text(given.get(), &text), TM_OK) << tm_message();
  const CaseOf again = case_of(text);
  tm_text_free(text);
  const PairOf pair = pair_of(given.get()), other = pair_of(again.get());
  const SolutionOf one = solved(pair.get(), given.get()), same = solved(other.get(), again.get());
  EXPECT_EQ(field(one.get(), 0, "pressure"), field(same.get(), 0, "pressure"));
}

TEST(CInterface, NumbersOfCasesAreInSi) {
  const CaseOf a = case_of(kText), b = case_of(kText);
  ASSERT_EQ(tm_case_set(a.get(), "wheelset.yaw_deg=0.5"), TM_OK) << tm_message();
  ASSERT_EQ(tm_case_set_number(b.get(), "wheelset.yaw", 0.5 * std::acos(-1.0) / 180.0), TM_OK) << tm_message();
  double from_text = 0.0, from_number = 0.0;
  ASSERT_EQ(tm_case_get_number(a.get(), "wheelset.yaw", &from_text), TM_OK) << tm_message();
  ASSERT_EQ(tm_case_get_number(b.get(), "wheelset.yaw", &from_number), TM_OK);
  EXPECT_NEAR(from_text, from_number, 1e-18);
  const PairOf pair = pair_of(a.get());
  const SolutionOf one = solved(pair.get(), a.get()), other = solved(pair.get(), b.get());
  EXPECT_NEAR(number(one.get(), 0, "fx"), number(other.get(), 0, "fx"), 1e-9);
  // every number that has a value can be written back
  const char* name = nullptr;
  int written = 0;
  for (std::size_t i = 0; tm_list(TM_CASE_NUMBERS, i, &name, nullptr, nullptr) == TM_OK; ++i) {
    double value = 0.0;
    if (tm_case_get_number(a.get(), name, &value) != TM_OK || !std::isfinite(value)) continue;
    const CaseOf copy = case_of(kText);
    if (tm_case_set_number(copy.get(), name, value) != TM_OK) continue;  // a default that says "none"
    double back = 0.0;
    EXPECT_EQ(tm_case_get_number(copy.get(), name, &back), TM_OK) << name;
    EXPECT_NEAR(back, value, 1e-12 * std::abs(value)) << name;
    ++written;
  }
  EXPECT_GT(written, 40);
}

// Cases are not checked again where only motions changed: so no motion, however large, may be what a check would
// refuse.
TEST(CInterface, ACaseIsCheckedAgainWhereItMustBe) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  tm_solution* out = nullptr;
  ASSERT_EQ(tm_case_set_number(given.get(), "wheelset.y", 3e-3), TM_OK);
  EXPECT_NE(solved(pair.get(), given.get()), nullptr);
  ASSERT_EQ(tm_case_set_number(given.get(), "friction.half_velocity_1", 0.0), TM_OK) << tm_message();
  ASSERT_EQ(tm_case_set(given.get(), "friction.law=linear"), TM_OK) << tm_message();
  ASSERT_EQ(tm_case_set_number(given.get(), "friction.amplitude_1", 0.1), TM_OK) << tm_message();
  EXPECT_EQ(tm_pair_solve(pair.get(), given.get(), &out), TM_BAD_REQUEST);
  ASSERT_EQ(tm_case_set_number(given.get(), "wheelset.y", 1e-3), TM_OK);
  EXPECT_EQ(tm_pair_solve(pair.get(), given.get(), &out), TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("half_velocity_1"));
}

TEST(CInterface, NoMotionIsRefusedByTheCheckOfCases) {
  io::CaseFile file = io::parse_case_text(kText, "text");
  auto& c = std::get<io::WheelRailCase>(file.cases.front().content);
  for (const double x : {-1e6, 1e6, 0.0}) {
    c.state.position = {x, x, x, x, x, x};
    c.state.velocity = {c.state.velocity.x, x, x, x, x, x};
    c.state.wheel_offset = {x, x, x, x, x, x};
    c.track.dy = c.track.dz = c.track.roll = c.track.vy = c.track.vz = c.track.vroll = x;
    EXPECT_NO_THROW(io::validate_case(file.cases.front())) << x;
  }
}

TEST(CInterface, AChangeOfACaseDoesNotReachItsSolutions) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get());
  ASSERT_EQ(tm_case_set_number(given.get(), "wheelset.y", 5e-3), TM_OK);
  EXPECT_EQ(number(s.get(), "wheelset.y"), 2e-3);
}

TEST(CInterface, NoContactIsAnEndOfAComputation) {
  const CaseOf given = case_of(kText);
  ASSERT_EQ(tm_case_set(given.get(), "wheelset.z_mm=-20"), TM_OK) << tm_message();
  const PairOf pair = pair_of(given.get());
  const SolutionOf s = solved(pair.get(), given.get(), TM_NO_CONTACT);
  ASSERT_NE(s, nullptr);
  EXPECT_EQ(tm_solution_status(s.get()), TM_NO_CONTACT);
  EXPECT_EQ(tm_solution_patches(s.get()), 0u);
}

TEST(CInterface, ASavedStateGoesOnToTheSameBits) {
  const CaseOf given = case_of(kText);
  ASSERT_EQ(tm_case_set(given.get(), "case.regime=transient"), TM_OK) << tm_message();
  ASSERT_EQ(tm_case_set(given.get(), "case.history=continue"), TM_OK) << tm_message();
  const PairOf pair = pair_of(given.get());
  const auto step = [&](tm_pair* p, int i) {
    EXPECT_EQ(tm_case_set_number(given.get(), "wheelset.s", 1e-3 * i), TM_OK) << tm_message();
    const SolutionOf s = solved(p, given.get());
    return field(s.get(), 0, "traction_x");
  };
  for (int i = 0; i < 3; ++i) step(pair.get(), i);
  tm_state* saved = nullptr;
  ASSERT_EQ(tm_pair_save(pair.get(), &saved), TM_OK);
  const StateOf state(saved);
  std::size_t size = 0;
  ASSERT_EQ(tm_state_to_bytes(state.get(), nullptr, &size), TM_OK);
  std::vector<std::byte> bytes(size);
  std::size_t room = size - 1;
  EXPECT_EQ(tm_state_to_bytes(state.get(), bytes.data(), &room), TM_BAD_ARGUMENT);
  ASSERT_EQ(tm_state_to_bytes(state.get(), bytes.data(), &size), TM_OK);
  const std::vector<double> once = step(pair.get(), 3);
  tm_state* read = nullptr;
  ASSERT_EQ(tm_state_from_bytes(bytes.data(), size, &read), TM_OK) << tm_message();
  const StateOf again(read);
  const PairOf other = pair_of(given.get());
  ASSERT_EQ(tm_pair_restore(other.get(), again.get()), TM_OK);
  EXPECT_EQ(step(other.get(), 3), once);
  EXPECT_EQ(tm_state_from_bytes(bytes.data(), size / 2, &read), TM_BAD_INPUT);
  EXPECT_EQ(read, nullptr);
}

TEST(CInterface, AStateOfOtherSurfacesIsRefused) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  const std::vector<double> once = field(solved(pair.get(), given.get()).get(), 0, "pressure");
  for (const char* other : {"wheel.shape.standard=EPS", "rail.shape.standard=54E1"}) {
    const CaseOf changed = case_of(kText);
    ASSERT_EQ(tm_case_set(changed.get(), other), TM_OK) << tm_message();
    const PairOf foreign = pair_of(changed.get());
    tm_state* saved = nullptr;
    ASSERT_EQ(tm_pair_save(foreign.get(), &saved), TM_OK);
    const StateOf state(saved);
    EXPECT_EQ(tm_pair_restore(pair.get(), state.get()), TM_BAD_REQUEST) << other;
    EXPECT_NE(std::string(tm_message()).find("other surfaces"), std::string::npos);
  }
  EXPECT_EQ(field(solved(pair.get(), given.get()).get(), 0, "pressure"), once) << "it is as it was";
}

int parabola(void* user, double u, const double* y, std::size_t n, double* z) {
  ++*static_cast<int*>(user);
  for (std::size_t k = 0; k < n; ++k) z[k] = 2.0 * y[k] * y[k] + 0.1 * u * u;
  return 0;
}

TEST(CInterface, FunctionsOfTheCallerBecomeSurfaces) {
  int calls = 0;
  tm_surface* made = nullptr;
  ASSERT_EQ(tm_surface_from_function(TM_RAIL, parabola, &calls, -0.1, 0.1, 41, -0.03, 0.03, 61, 0.0, &made), TM_OK)
      << tm_message();
  const SurfaceOf surface(made);
  EXPECT_EQ(calls, 41);
  EXPECT_STREQ(tm_surface_backend(surface.get()), "spline");
  const std::vector<double> x{0.0, 0.033, -0.05, 0.0}, y{0.0, 0.0123, -0.02, 0.5};
  std::vector<double> z(4), dzdx(4), dzdy(4);
  ASSERT_EQ(
      tm_surface_heights(surface.get(), nullptr, nullptr, x.data(), y.data(), 4, z.data(), dzdx.data(), dzdy.data()),
      TM_OK);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(z[i], 2.0 * y[i] * y[i] + 0.1 * x[i] * x[i], 1e-8);
    EXPECT_NEAR(dzdx[i], 0.2 * x[i], 1e-5);
    EXPECT_NEAR(dzdy[i], 4.0 * y[i], 1e-5);
  }
  EXPECT_TRUE(std::isnan(z[3]));
  const auto give_up = [](void*, double, const double*, std::size_t, double*) { return 1; };
  EXPECT_EQ(tm_surface_from_function(TM_RAIL, give_up, nullptr, -0.1, 0.1, 41, -0.03, 0.03, 61, 0.0, &made),
            TM_CANCELLED);
  EXPECT_EQ(made, nullptr);
}

TEST(CInterface, ASurfaceCanBeRepresentedInAnotherWay) {
  const CaseOf given = case_of(kText);
  tm_surface *rail = nullptr, *wheel = nullptr, *spline = nullptr;
  ASSERT_EQ(tm_surface_of_case(given.get(), TM_RAIL, &rail), TM_OK) << tm_message();
  ASSERT_EQ(tm_surface_of_case(given.get(), TM_WHEEL, &wheel), TM_OK) << tm_message();
  const SurfaceOf rail_kept(rail), wheel_kept(wheel);
  ASSERT_EQ(tm_surface_represent(rail, "spline", 1e-3, &spline), TM_OK) << tm_message();
  const SurfaceOf spline_kept(spline);
  tm_pair *one = nullptr, *other = nullptr;
  ASSERT_EQ(tm_pair_create(rail, wheel, &one), TM_OK) << tm_message();
  const PairOf one_kept(one);
  ASSERT_EQ(tm_pair_create(spline, wheel, &other), TM_OK) << tm_message();
  const PairOf other_kept(other);
  const double a = number(solved(one, given.get()).get(), 0, "pmax"),
               b = number(solved(other, given.get()).get(), 0, "pmax");
  EXPECT_NEAR(b, a, 0.05 * a);
  EXPECT_NE(b, a);
  EXPECT_EQ(tm_pair_create(wheel, rail, &one), TM_BAD_ARGUMENT);
  EXPECT_EQ(tm_surface_represent(rail, "marble", 1e-3, &spline), TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("marble"));
}

TEST(CInterface, OnePatchIsHertz) {
  const std::string text =
      "[patch]\nnormal_force_N = 1000.0\nmx = 40\nmy = 40\nx0_mm = -1.95\ny0_mm = -1.95\ndx_mm = 0.1\ndy_mm = 0.1\n"
      "[patch.gap]\nkind = \"quadratic\"\ncoefficients_si = [10.0, 0.0, 10.0, 0.0, 0.0, 0.0]\n";
  const CaseOf given = case_of(text);
  tm_patch* made = nullptr;
  ASSERT_EQ(tm_patch_create(&made), TM_OK);
  const PatchOf patch(made);
  tm_solution* out = nullptr;
  ASSERT_EQ(tm_patch_solve(patch.get(), given.get(), &out), TM_OK) << tm_message();
  const SolutionOf s(out);
  // Hertz: a^3 = 3 F R (1 - nu^2) / (2 E) of two equal bodies, gap r^2 / (2 R); E = 2 G (1 + nu)
  const double e = 2.0 * 82e9 * 1.28, radius = 0.05, force = 1000.0;
  const double a = std::cbrt(1.5 * force * radius * (1.0 - 0.28 * 0.28) / e);
  EXPECT_NEAR(number(s.get(), 0, "pmax"), 1.5 * force / (std::acos(-1.0) * a * a), 0.02 * 1.5 * force / (3.14 * a * a));
  EXPECT_EQ(tm_patch_solve(patch.get(), case_of(kText).get(), &out), TM_BAD_ARGUMENT);
  const PairOf pair = pair_of(case_of(kText).get());
  EXPECT_EQ(tm_pair_solve(pair.get(), given.get(), &out), TM_BAD_ARGUMENT);
}

TEST(CInterface, AFlagCancels) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  const volatile int flag = 1;
  tm_set_cancel_flag(&flag);
  tm_solution* out = nullptr;
  EXPECT_EQ(tm_pair_solve(pair.get(), given.get(), &out), TM_CANCELLED);
  EXPECT_EQ(out, nullptr);
  tm_set_cancel_flag(nullptr);
  EXPECT_NE(solved(pair.get(), given.get()), nullptr);
}

TEST(CInterface, ThreadsHaveTheirOwnMessagesAndPairs) {
  const CaseOf given = case_of(kText);
  const SolutionOf alone = solved(pair_of(given.get()).get(), given.get());
  const std::vector<double> expected = field(alone.get(), 0, "pressure");
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&] {
      const CaseOf own = case_of(kText);
      const PairOf pair = pair_of(own.get());
      for (int i = 0; i < 3; ++i) {
        const SolutionOf s = solved(pair.get(), own.get());
        EXPECT_EQ(field(s.get(), 0, "pressure"), expected);
        double value = 0.0;
        EXPECT_EQ(tm_patch_number(s.get(), 0, ("name" + std::to_string(t)).c_str(), &value), TM_BAD_ARGUMENT);
        EXPECT_STRNE(tm_message(), "");
      }
    });
  for (std::thread& t : threads) t.join();
}

TEST(CInterface, AWholeFileGivesItsResultAsJson) {
  char* json = nullptr;
  const std::string file = std::string(TREADMARK_SOURCE_DIR) + "/examples/wheel-flat.toml";
  const char* coarse[] = {"discretisation.dx_mm=2", "discretisation.ds_mm=2"};
  ASSERT_EQ(tm_run(file.c_str(), coarse, 2, &json), TM_OK) << tm_message();
  EXPECT_THAT(json, HasSubstr("\"cases\""));
  tm_text_free(json);
}

}  // namespace
}  // namespace treadmark
