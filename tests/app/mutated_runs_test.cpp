// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Damaged cases and profiles, solved to the end: an Error, a status, or a number that can be true.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <random>
#include <string>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/mutation.hpp"

namespace treadmark::app {
namespace {

constexpr int kUsual = 150;
constexpr double kLongest = 10.0;  // [s]
// Stated with the remark beyond_half_space: 0.05 E' of steel.
constexpr double kPressureLimit = 0.05 * 82e9 / (1.0 - 0.28);

bool finite(const io::PatchResult& p) {
  for (const double v : {p.fn, p.fx, p.fs, p.mn, p.approach, p.pmax, p.elastic_energy, p.frictional_power, p.xi, p.eta,
                         p.phi, p.x_tr, p.y_tr, p.z_tr, p.angle})
    if (!std::isfinite(v)) return false;
  for (const auto* field : {&p.fields.pressure, &p.fields.traction_x, &p.fields.traction_s})
    for (const double v : *field)
      if (!std::isfinite(v)) return false;
  return true;
}

void expect_sound(const io::RunResult& run, bool steel) {
  for (const io::CaseResult& c : run.cases) {
    if (c.status != Status::ok) {
      EXPECT_FALSE(c.message.empty());
      continue;
    }
    EXPECT_TRUE(std::isfinite(c.z));
    for (const io::PatchResult& p : c.patches) {
      EXPECT_TRUE(finite(p));
      EXPECT_TRUE(!steel || p.pmax <= kPressureLimit || any_grave(c.remarks)) << p.pmax;
    }
  }
}

/// changed: file of the sample that is mutated.
void survive(const std::string& changed, bool steel) {
  const treadmark::testing::SampleInput input;
  const std::string valid = input.read(changed);
  std::mt19937 random(20261122);
  int solved = 0, refused = 0;
  for (int trial = 0; trial < treadmark::testing::mutants(kUsual); ++trial) {
    const std::string text = trial % 2 == 0 ? treadmark::testing::with_other_numbers(valid, random)
                                            : treadmark::testing::with_other_lines(valid, random);
    input.write(changed, text);
    const auto start = std::chrono::steady_clock::now();
    try {
      const io::CaseFile file = io::read_any_case(input.inp(), {});
      expect_sound(run_cases(file), steel);
      ++solved;
    } catch (const Error& error) {
      EXPECT_FALSE(error.message().empty());
      ++refused;
    }
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    EXPECT_LT(took, kLongest);
    if (::testing::Test::HasFailure()) {
      FAIL() << "trial " << trial << ", " << changed << ":\n" << text;
    }
  }
  EXPECT_GT(solved, 0);
  EXPECT_GT(refused, 0);
}

TEST(MutatedRuns, WheelProfile) { survive("wheel.txt", true); }
TEST(MutatedRuns, RailProfile) { survive("rail.prr", true); }
TEST(MutatedRuns, ContactInput) { survive("case.inp", false); }

}  // namespace
}  // namespace treadmark::app
