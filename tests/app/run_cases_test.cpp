// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/run_cases.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/counting_token.hpp"

namespace treadmark::app {
namespace {

TEST(RunCases, StopKeepsFinishedCases) {
  const treadmark::testing::SampleInput input;
  io::CaseFile file = io::read_any_case(input.inp(), {});
  while (file.cases.size() < 6) file.cases.push_back(file.cases[0]);
  const ThreadLimit one_thread(1);
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t total, const std::string&) {
    EXPECT_EQ(total, 6u);
    if (finished == 2) stop = true;
  };
  const io::RunResult result = run_cases(file, progress);
  EXPECT_FALSE(result.complete);
  EXPECT_EQ(result.cases_total, 6);
  ASSERT_EQ(result.cases.size(), 2u);
  EXPECT_EQ(result.cases[0].number, 1);
  EXPECT_EQ(result.cases[1].number, 2);
}

TEST(RunCases, IsCancelledWithinACase) {
  const treadmark::testing::SampleInput input;
  io::CaseFile file = io::read_any_case(input.inp(), {});
  while (file.cases.size() < 4) file.cases.push_back(file.cases[0]);
  const ThreadLimit one_thread(1);
  const treadmark::testing::CountingToken never;
  {
    const CancellationScope scope(&never);
    EXPECT_TRUE(run_cases(file).complete);
  }
  for (const long last : {1L, never.passed() / 2, never.passed() - 200}) {
    const treadmark::testing::CountingToken token(last);
    const CancellationScope scope(&token);
    std::size_t told = 0;
    Progress progress;
    progress.report = [&](std::size_t finished, std::size_t, const std::string&) { told = finished; };
    SurfaceStore store;
    io::RunResult result;
    try {
      result = run_cases(file, store, progress);
    } catch (const Cancelled&) {  // behind the cases, where their surfaces are described
      continue;
    }
    EXPECT_FALSE(result.complete) << last;
    EXPECT_LT(result.cases.size(), 4u);
    EXPECT_EQ(result.cases.size(), told) << "what is finished is kept";
    EXPECT_EQ(result.cases_total, 4);
  }
}

TEST(RunCases, ThreadsDoNotChangeABit) {
  const treadmark::testing::SampleInput input;
  io::CaseFile file = io::read_any_case(input.inp(), {});
  while (file.cases.size() < 8) {
    file.cases.push_back(file.cases.back());
    std::get<io::WheelRailCase>(file.cases.back().content).state.position.y += 5e-4;
  }
  const auto run_with = [&](int threads) {
    const ThreadLimit limit(threads);
    return run_cases(file);
  };
  const io::RunResult one = run_with(1), many = run_with(4);
  ASSERT_EQ(one.cases.size(), many.cases.size());
  for (std::size_t i = 0; i < one.cases.size(); ++i) {
    EXPECT_EQ(one.cases[i].z, many.cases[i].z);
    ASSERT_EQ(one.cases[i].patches.size(), many.cases[i].patches.size());
    for (std::size_t k = 0; k < one.cases[i].patches.size(); ++k) {
      EXPECT_EQ(one.cases[i].patches[k].fields.pressure, many.cases[i].patches[k].fields.pressure);
      EXPECT_EQ(one.cases[i].patches[k].fields.traction_s, many.cases[i].patches[k].fields.traction_s);
    }
  }
}

TEST(RunCases, CarriesInputHashes) {
  const treadmark::testing::SampleInput input;
  const io::RunResult result = run_cases(io::read_any_case(input.inp(), {}));
  EXPECT_EQ(result.input_sha256.size(), 64u);
  EXPECT_EQ(result.geometry_sha256.size(), 2u);
  EXPECT_TRUE(result.complete);
}

}  // namespace
}  // namespace treadmark::app
