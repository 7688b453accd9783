// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <nlohmann/json.hpp>

#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/tests/app/measured/told.hpp"
#include "treadmark/tests/support/shared_data.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

/// Profiles as they come from the field, with the right values beside them in ../shared/found/field/README.md.
namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double kPressure = 0.05;  // of the right value, where noise or rounding is in the points
constexpr double kSame = 0.005;     // the same shape in other points
constexpr double kPlace_mm = 0.5;
constexpr double kAngle_rad = 0.005;

#define FIELD(name)           \
  TREADMARK_REQUIRE_SHARED(); \
  const fs::path folder = *shared / "found/field", file = folder / (name)

Told wheel_run(const fs::path& folder, const fs::path& file) {
  return told_by_run(folder / "wheel_case.toml", {"wheel.shape.file=" + file.string()});
}

Told rail_run(const fs::path& folder, const fs::path& file) {
  return told_by_run(folder / "rail_case.toml", {"rail.shape.file=" + file.string()});
}

void expect_case(const Told& told, double pmax, double y_tr, double angle, double relative) {
  ASSERT_EQ(told.cases.size(), 1U) << told.err;
  EXPECT_EQ(told.cases[0].status, "ok");
  EXPECT_NEAR(told.cases[0].pmax_MPa, pmax, relative * pmax);
  EXPECT_NEAR(told.cases[0].y_tr_mm, y_tr, kPlace_mm);
  EXPECT_NEAR(told.cases[0].angle_rad, angle, kAngle_rad);
}

/// S1002 on 60E1.
void expect_new(const Told& told, double relative = kSame) { expect_case(told, 981.3, 750.53, -0.0346, relative); }

TEST(FieldProfiles, AHollowWheelStandsOnItsTread) {
  FIELD("hollow4.csv");
  const Told run = wheel_run(folder, file);
  EXPECT_EQ(run.status, 0) << run.err;
  expect_case(run, 2230.6, 729.82, -0.2236, kSame);
}

TEST(FieldProfiles, AHollowWheelIsMeasured) {
  FIELD("hollow4.csv");
  const Told measured = told_by({"measure", "wheel", file.string(), "--nominal", "S1002", "--json", "-"});
  ASSERT_EQ(measured.status, 0) << measured.err;
  const auto wheel = nlohmann::json::parse(measured.out)["wheel"];
  const double hollow_at_tape_line = 2.0 * (1.0 + std::cos(std::numbers::pi * 10.0 / 35.0));
  EXPECT_NEAR(wheel["flange_height_mm"], 28.0 + hollow_at_tape_line, 0.02);
  EXPECT_GT(wheel["hollow_mm"].get<double>(), 1.3);
  EXPECT_LT(wheel["hollow_mm"].get<double>(), 4.0);
}

TEST(FieldProfiles, AHollowWheelIsWrittenAsItIs) {
  FIELD("hollow4.csv");
  const TemporaryFolder out;
  for (const char* name : {"a.prw", "a.csv", "a.whl"}) {
    const fs::path written = out.path() / name;
    const Told told = told_by({"convert", file.string(), written.string(), "--body", "wheel"});
    ASSERT_EQ(told.status, 0) << told.err;
    const Profile p = io::read_profile(written, Body::wheel, {});
    const auto tip = std::max_element(p.z.begin(), p.z.end()) - p.z.begin();
    EXPECT_NEAR(p.z[static_cast<std::size_t>(tip)], 28e-3, 1e-5) << name;
    EXPECT_NEAR(p.y[static_cast<std::size_t>(tip)], -55e-3, 0.5e-3) << name;
  }
}

TEST(FieldProfiles, TheTopOfARailIsNotTurnedByItsNoise) {
  FIELD("rail_top_noise.txt");
  const Told check = told_by({"check", file.string(), "--body", "rail"});
  EXPECT_THAT(check.out, HasSubstr("z as in the file")) << check.err;
  const Profile p = io::read_profile(file, Body::rail, {});
  EXPECT_NEAR(p.z.front(), 1.08e-3, 0.1e-3);
  EXPECT_NEAR(p.z[p.z.size() / 2], 0.0, 0.1e-3);
}

TEST(FieldProfiles, AColumnOfRadiiIsTakenForRadii) {
  FIELD("radius.csv");
  const Told run = wheel_run(folder, file);
  if (!run.doubted("radi")) expect_new(run);
}

TEST(FieldProfiles, RoundedPointsAreSmoothedOrDoubted) {
  FIELD("quantum_10um.csv");
  const Told run = wheel_run(folder, file);
  if (!run.doubted("smooth")) expect_new(run, kPressure);
}

TEST(FieldProfiles, ARailCutAboveItsGaugePointIsNoPlace) {
  FIELD("head_8mm.txt");
  const Told run = rail_run(folder, file);
  EXPECT_TRUE(run.refused() || run.doubted("gauge")) << run.err;
  EXPECT_THAT(run.err + run.out, HasSubstr("gauge"));
}

TEST(FieldProfiles, TwoFlangesPointDown) {
  FIELD("double_flange.csv");
  const Told check = told_by({"check", file.string(), "--body", "wheel"});
  EXPECT_THAT(check.out, HasSubstr("z as in the file")) << check.err;
  EXPECT_THAT(check.out, ::testing::Not(HasSubstr("flange_side")));
  EXPECT_THAT(check.out, ::testing::Not(HasSubstr("upside_down")));
  const Profile p = io::read_profile(file, Body::wheel, {});
  EXPECT_NEAR(*std::max_element(p.z.begin(), p.z.end()) - *std::min_element(p.z.begin(), p.z.end()), 20e-3, 1e-6);
  EXPECT_NEAR(p.z[p.z.size() / 2], *std::min_element(p.z.begin(), p.z.end()), 1e-6);
}

TEST(FieldProfiles, OfAWholeOutlineTheHeadCounts) {
  FIELD("whole_outline.txt");
  const Told check = told_by({"check", file.string(), "--body", "rail"});
  ASSERT_LE(check.status, 1) << check.err;
  EXPECT_THAT(check.out, HasSubstr("note"));
  expect_new(rail_run(folder, file));
}

TEST(FieldProfiles, ACountBeforeThePointsIsNoPoint) {
  FIELD("count_columns_first.txt");
  const Told check = told_by({"check", file.string(), "--body", "wheel"});
  EXPECT_THAT(check.out, HasSubstr("note")) << check.err;
  EXPECT_EQ(io::read_profile(file, Body::wheel, {}).y.size(), 154U);
  expect_new(wheel_run(folder, file), kPressure);  // points 1 mm apart
}

TEST(FieldProfiles, ForeignMinusSignsAreReadOrRefused) {
  FIELD("rail_minus_u2212.csv");
  const Told check = told_by({"check", file.string(), "--body", "rail"});
  if (check.refused()) {
    EXPECT_THAT(check.err, HasSubstr("rail_minus_u2212.csv:2"));
    return;
  }
  EXPECT_EQ(io::read_profile(file, Body::rail, {}).y.size(), 263U);
  expect_new(rail_run(folder, file));
}

TEST(FieldProfiles, AMarkOfNothingIsNoPoint) {
  FIELD("void_-99.999.csv");
  const Told check = told_by({"check", file.string(), "--body", "wheel"});
  if (check.refused()) {
    EXPECT_THAT(check.err, HasSubstr("-99.999"));
    return;
  }
  EXPECT_THAT(check.out, HasSubstr("note"));
  expect_new(wheel_run(folder, file), kPressure);
}

TEST(FieldProfiles, ATiltedRailIsDoubted) {
  FIELD("tilted_rail_10deg.txt");
  const Told run = rail_run(folder, file);
  EXPECT_TRUE(run.refused() || run.doubted("roll") || run.doubted("tilt") || run.doubted("turned")) << run.err;
  const Told check = told_by({"check", file.string(), "--body", "rail"});
  EXPECT_THAT(check.out, HasSubstr("warning")) << check.err;
}

TEST(FieldProfiles, CheckAndRunDoubtTogether) {
  TREADMARK_REQUIRE_SHARED();
  const fs::path folder = *shared / "found/field";
  for (const char* name : {"hollow4.csv", "count_columns_first.txt", "tilted_rail_10deg.txt", "head_8mm.txt"}) {
    const bool rail =
        std::string(name).find("wheel") == std::string::npos && name[0] != 'c' && std::string(name) != "hollow4.csv";
    const Told check = told_by({"check", (folder / name).string(), "--body", rail ? "rail" : "wheel"});
    const Told run = rail ? rail_run(folder, folder / name) : wheel_run(folder, folder / name);
    EXPECT_EQ(check.out.find("  warning") != std::string::npos || check.refused(), run.status != 0)
        << name << check.out << run.err;
  }
}

}  // namespace
}  // namespace treadmark::testing
