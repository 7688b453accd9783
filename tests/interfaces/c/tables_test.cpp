// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Tables of forces by C.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "treadmark/tests/interfaces/c/owned.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using TableOf = std::unique_ptr<tm_contact_table, Freed<tm_contact_table, tm_table_free>>;

constexpr std::size_t kMotion = 11, kForces = 25;  // up to vertical_load; all
constexpr std::size_t kZ = 0, kNormalForce = 2, kRailFz = 8;

const std::vector<const char*> kSmall{"lateral_range_mm=2",      "step_mm=1",     "element_mm=1",
                                      "roll_intervals=0",        "yaw_mrad=10",   "yaw_intervals=1",
                                      "creep_forces=\"linear\"", "check_points=3"};

TableOf small_force_table() {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  tm_contact_table* out = nullptr;
  EXPECT_EQ(tm_table_create(pair.get(), given.get(), kSmall.data(), kSmall.size(), &out), TM_OK) << tm_message();
  return TableOf(out);
}

/// y, z, roll, yaw, vx, vy, vz, vroll, vyaw, vpitch, vertical_load.
std::array<double, kMotion> a_motion() { return {0.5e-3, 0, 0, 2e-3, 20.0, 0, 0, 0, 0, -43.5, 70e3}; }

TEST(CTables, ForcesAreWithinTheStatedErrorOfThePair) {
  TREADMARK_NEEDS("vehicle");
  const TableOf table = small_force_table();
  ASSERT_NE(table, nullptr);
  std::array<double, kForces> forces{};
  ASSERT_EQ(tm_table_evaluate(table.get(), a_motion().data(), kMotion, forces.data(), kForces), TM_OK)
      << tm_table_message(table.get());
  EXPECT_NEAR(forces[kRailFz], 70e3, 1e-3);

  const CaseOf given = case_of(kText);
  for (const auto& [name, value] :
       {std::pair("wheelset.y", 0.5e-3), std::pair("wheelset.yaw", 2e-3), std::pair("wheelset.vertical_force", 70e3)})
    ASSERT_EQ(tm_case_set_number(given.get(), name, value), TM_OK) << tm_message();
  const PairOf pair = pair_of(given.get());
  const SolutionOf solution = solved(pair.get(), given.get());
  double worst = 0.0, rms = 0.0;
  ASSERT_EQ(tm_table_error(table.get(), "z", &worst, &rms), TM_OK);
  EXPECT_GE(worst, rms);
  EXPECT_GT(rms, 0.0);
  constexpr double kFewPoints = 5.0;  // three of them
  EXPECT_NEAR(forces[kZ], number(solution.get(), "wheelset.z"), kFewPoints * worst + 5e-6);
}

TEST(CTables, NamesStandInTheOrderOfTheArrays) {
  TREADMARK_NEEDS("vehicle");
  const auto name_at = [](tm_table list, std::size_t i) {
    const char *name = nullptr, *unit = nullptr, *meaning = nullptr;
    return tm_list(list, i, &name, &unit, &meaning) == TM_OK ? std::string(name) : std::string();
  };
  EXPECT_EQ(name_at(TM_MOTION_NUMBERS, 0), "y");
  EXPECT_EQ(name_at(TM_MOTION_NUMBERS, 10), "vertical_load");
  EXPECT_EQ(name_at(TM_FORCE_NUMBERS, kZ), "z");
  EXPECT_EQ(name_at(TM_FORCE_NUMBERS, kNormalForce), "normal_force");
  EXPECT_EQ(name_at(TM_FORCE_NUMBERS, kRailFz), "rail_fz");
  EXPECT_EQ(name_at(TM_FORCE_NUMBERS, kForces - 1), "max_pressure");
  EXPECT_EQ(name_at(TM_FORCE_NUMBERS, kForces), "");
}

TEST(CTables, FilesAndCopiesGiveTheSameBits) {
  TREADMARK_NEEDS("vehicle");
  const TableOf table = small_force_table();
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "t.json").string();
  ASSERT_EQ(tm_table_write(table.get(), file.c_str()), TM_OK) << tm_message();
  tm_contact_table *read = nullptr, *copied = nullptr;
  ASSERT_EQ(tm_table_read(file.c_str(), &read), TM_OK) << tm_message();
  const TableOf again(read);
  ASSERT_EQ(tm_table_copy(table.get(), &copied), TM_OK);
  const TableOf copy(copied);
  std::array<double, kForces> a{}, b{}, c{};
  ASSERT_EQ(tm_table_evaluate(table.get(), a_motion().data(), kMotion, a.data(), kForces), TM_OK);
  ASSERT_EQ(tm_table_evaluate(again.get(), a_motion().data(), kMotion, b.data(), kForces), TM_OK);
  ASSERT_EQ(tm_table_evaluate(copy.get(), a_motion().data(), kMotion, c.data(), kForces), TM_OK);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a, c);
}

TEST(CTables, WhatIsNotCoveredHasAStatus) {
  TREADMARK_NEEDS("vehicle");
  const TableOf table = small_force_table();
  std::array<double, kForces> forces{};
  const auto asked = [&](auto change) {
    auto motion = a_motion();
    change(motion);
    return tm_table_evaluate(table.get(), motion.data(), kMotion, forces.data(), kForces);
  };
  EXPECT_EQ(asked([](auto& m) { m[0] = 5e-3; }), TM_FAILED);
  EXPECT_THAT(tm_table_message(table.get()), HasSubstr("aside"));
  for (const double force : forces) EXPECT_TRUE(std::isnan(force));
  EXPECT_EQ(asked([](auto& m) { m[3] = 11e-3; }), TM_FAILED);
  EXPECT_THAT(tm_table_message(table.get()), HasSubstr("yawed"));
  EXPECT_EQ(asked([](auto& m) { m[10] = 1e7; }), TM_FAILED);
  EXPECT_EQ(asked([](auto& m) { m[10] = 0.0, m[1] = -1e-3; }), TM_NO_CONTACT);
  EXPECT_EQ(forces[kNormalForce], 0.0);
  EXPECT_EQ(asked([](auto& m) { m[10] = -1.0; }), TM_BAD_REQUEST);
  EXPECT_EQ(asked([](auto& m) { m[0] = std::nan(""); }), TM_BAD_REQUEST);
  EXPECT_EQ(tm_table_evaluate(nullptr, a_motion().data(), kMotion, forces.data(), kForces), TM_BAD_ARGUMENT);
  EXPECT_EQ(tm_table_evaluate(table.get(), a_motion().data(), 99, forces.data(), kForces), TM_BAD_ARGUMENT);
  EXPECT_EQ(tm_table_error(table.get(), "nothing", nullptr, nullptr), TM_BAD_ARGUMENT);
  tm_contact_table* out = nullptr;
  EXPECT_EQ(tm_table_read("/nowhere/t.json", &out), TM_BAD_INPUT);
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  const char* const wrong[] = {"nonsense=1"};
  EXPECT_EQ(tm_table_create(pair.get(), given.get(), wrong, 1, &out), TM_BAD_REQUEST);
  EXPECT_EQ(out, nullptr);
}

}  // namespace
}  // namespace treadmark::testing
