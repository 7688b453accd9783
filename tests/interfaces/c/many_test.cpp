// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Arrays of instants: the bits of tm_pair_solve, row by row.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "treadmark/tests/interfaces/c/owned.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

/// Rows of a list, and what came out of them.
struct Rows {
  explicit Rows(std::size_t n) : y(n), force(n), height(n), pressure(n), second(n), status(n, TM_INTERNAL) {
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = -4e-3 + 0.4e-3 * static_cast<double>(i % 25);
      force[i] = 60e3 + 1e3 * static_cast<double>(i % 11);
    }
  }

  tm_status solve(const tm_pair* pair, const tm_case* c) {
    const char* in_names[] = {"wheelset.y", "wheelset.vertical_force"};
    const char* out_names[] = {"wheelset.z", "pmax", "patch_2.fn"};
    const double* in[] = {y.data(), force.data()};
    double* out[] = {height.data(), pressure.data(), second.data()};
    return tm_pair_solve_many(
        pair, c, y.size(), in_names, in, 2, out_names, out, 3, status.data(),
        [](void* user, size_t row, tm_status end, const char* message) {
          Rows& rows = *static_cast<Rows*>(user);
          rows.said[row] = std::string(tm_status_name(end)) + ": " + message;
        },
        this);
  }

  std::vector<double> y, force, height, pressure, second;
  std::vector<tm_status> status;
  std::map<std::size_t, std::string> said;
};

TEST(CManyInstants, HaveTheBitsOfSingleOnes) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  Rows rows(40);
  rows.y[7] = NAN;
  rows.force[9] = -1.0;
  ASSERT_EQ(rows.solve(pair.get(), given.get()), TM_OK) << tm_message();
  for (std::size_t i = 0; i < rows.y.size(); ++i) {
    if (i == 7 || i == 9) {
      EXPECT_EQ(rows.status[i], TM_FAILED) << i;
      EXPECT_TRUE(std::isnan(rows.pressure[i])) << i;
      EXPECT_THAT(rows.said[i], HasSubstr("failed: ")) << i;
      continue;
    }
    const CaseOf one = case_of(kText);
    ASSERT_EQ(tm_case_set_number(one.get(), "wheelset.y", rows.y[i]), TM_OK);
    ASSERT_EQ(tm_case_set_number(one.get(), "wheelset.vertical_force", rows.force[i]), TM_OK);
    const PairOf fresh = pair_of(one.get());
    const SolutionOf s = solved(fresh.get(), one.get());
    EXPECT_EQ(rows.status[i], TM_OK);
    EXPECT_EQ(rows.height[i], number(s.get(), "wheelset.z"));
    double most = 0.0, pressure = NAN, second = NAN;
    for (std::size_t k = 0; k < tm_solution_patches(s.get()); ++k) {
      const double force = number(s.get(), k, "fn");
      if (force > most) most = force, pressure = number(s.get(), k, "pmax");
      if (k == 1) second = force;
    }
    EXPECT_EQ(rows.pressure[i], pressure) << i;
    EXPECT_TRUE(rows.second[i] == second || (std::isnan(second) && std::isnan(rows.second[i]))) << i;
  }
}

TEST(CManyInstants, RefuseARowWithoutNumbers) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  // the second: a value by itself, but not the radius of the wheel's surface
  const std::vector<double> radius = {0.46, 0.5};
  const double* in[] = {radius.data()};
  const char* in_names[] = {"wheelset.nominal_radius"};
  const char* out_names[] = {"wheelset.y", "wheelset.z", "force_on_rail.fz_tr", "npatch", "pmax", "timing.total"};
  std::vector<std::vector<double>> found(std::size(out_names), std::vector<double>(2, 7.0));
  std::vector<double*> out;
  for (auto& column : found) out.push_back(column.data());
  std::vector<tm_status> status(2, TM_INTERNAL);
  ASSERT_EQ(tm_pair_solve_many(pair.get(), given.get(), 2, in_names, in, 1, out_names, out.data(), out.size(),
                               status.data(), nullptr, nullptr),
            TM_OK)
      << tm_message();
  EXPECT_EQ(status, (std::vector{TM_OK, TM_FAILED}));
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_FALSE(std::isnan(found[k][0])) << out_names[k];
    EXPECT_TRUE(std::isnan(found[k][1])) << out_names[k] << ": " << found[k][1];
  }
}

TEST(CManyInstants, DoNotDependOnThreads) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  Rows one(60), many(60);
  ASSERT_EQ(tm_set_threads(1), TM_OK);
  EXPECT_EQ(one.solve(pair.get(), given.get()), TM_OK);
  ASSERT_EQ(tm_set_threads(4), TM_OK);
  EXPECT_EQ(many.solve(pair.get(), given.get()), TM_OK);
  ASSERT_EQ(tm_set_threads(0), TM_OK);
  EXPECT_EQ(one.height, many.height);
  EXPECT_EQ(one.pressure, many.pressure);
  EXPECT_EQ(one.status, many.status);
}

TEST(CManyInstants, EndAtTheFlagAndByProgress) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  Rows rows(20000);
  int flag = 1;
  tm_set_cancel_flag(&flag);
  EXPECT_EQ(rows.solve(pair.get(), given.get()), TM_CANCELLED);
  tm_set_cancel_flag(nullptr);
  EXPECT_EQ(rows.status.front(), TM_CANCELLED);
  tm_set_progress([](void*, size_t, size_t total, const char*) { return total == 20000 ? 1 : 0; }, nullptr);
  EXPECT_EQ(rows.solve(pair.get(), given.get()), TM_CANCELLED);
  tm_set_progress(nullptr, nullptr);
  std::size_t done = 0;
  for (std::size_t i = 0; i < rows.y.size(); ++i) {
    if (rows.status[i] == TM_OK) ++done;
    EXPECT_EQ(std::isnan(rows.pressure[i]), rows.status[i] != TM_OK) << i;
  }
  EXPECT_GT(done, 0u);
  EXPECT_LT(done, rows.y.size());
}

TEST(CManyInstants, RefuseWhatMakesNoSense) {
  const CaseOf given = case_of(kText);
  const PairOf pair = pair_of(given.get());
  double y = 0.0, z = 5.0;
  const double* in[] = {&y};
  double* out[] = {&z};
  const auto solve = [&](const tm_case* c, const char* in_name, const char* out_name) {
    return tm_pair_solve_many(pair.get(), c, 1, &in_name, in, 1, &out_name, out, 1, nullptr, nullptr, nullptr);
  };
  EXPECT_EQ(solve(given.get(), "wheelset.y", "wheelset.z"), TM_OK) << tm_message();
  EXPECT_EQ(solve(given.get(), "wheelset.why", "wheelset.z"), TM_BAD_ARGUMENT);
  EXPECT_EQ(solve(given.get(), "wheelset.y", "wheelset.zz"), TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("wheelset.z"));
  EXPECT_EQ(solve(nullptr, "wheelset.y", "wheelset.z"), TM_BAD_ARGUMENT);
  EXPECT_EQ(solve(given.get(), nullptr, "wheelset.z"), TM_BAD_ARGUMENT);
  // the same number or the same array twice
  const char* twice[] = {"wheelset.y", "wheelset.y"};
  const double* both[] = {&y, &y};
  double* over[] = {&y};
  const char* out_name = "wheelset.z";
  EXPECT_EQ(
      tm_pair_solve_many(pair.get(), given.get(), 1, twice, both, 2, &out_name, out, 1, nullptr, nullptr, nullptr),
      TM_BAD_REQUEST);
  EXPECT_THAT(tm_message(), HasSubstr("two arrays give wheelset.y"));
  EXPECT_EQ(tm_pair_solve_many(pair.get(), given.get(), 1, twice, in, 1, &out_name, over, 1, nullptr, nullptr, nullptr),
            TM_BAD_ARGUMENT);
  EXPECT_EQ(y, 0.0);
  const CaseOf patch = [] {
    tm_case* made = nullptr;
    EXPECT_EQ(tm_case_create(1, &made), TM_OK);
    return CaseOf(made);
  }();
  EXPECT_EQ(solve(patch.get(), "wheelset.y", "wheelset.z"), TM_BAD_ARGUMENT);
  const CaseOf in_time = case_of(kText);
  ASSERT_EQ(tm_case_set(in_time.get(), "case.history=continue"), TM_OK);
  EXPECT_EQ(solve(in_time.get(), "wheelset.y", "wheelset.z"), TM_BAD_REQUEST);
  EXPECT_EQ(tm_pair_solve_many(pair.get(), given.get(), 0, nullptr, nullptr, 0, nullptr, nullptr, 0, nullptr, nullptr,
                               nullptr),
            TM_OK);
}

}  // namespace
}  // namespace treadmark::testing
