// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"

namespace treadmark::app {
namespace {

constexpr double kLoad = 80e3;       // of the example [N]
constexpr double kBetween = 765e-3;  // y between the patches on nose and wing [m]

/// The example's wheel at other positions along the track.
io::CaseFile passage(double from, double to, double step) {
  io::CaseFile file = io::read_any_case(std::string(TREADMARK_SOURCE_DIR) + "/examples/crossing-passage.toml", {});
  const io::Case first = file.cases.front();
  file.cases.clear();
  const int steps = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= steps; ++i) {
    file.cases.push_back(first);
    file.cases.back().number = i + 1;
    std::get<io::WheelRailCase>(file.cases.back().content).state.position.x = from + i * step;
  }
  return file;
}

double share_of_nose(const io::CaseResult& result) {
  double nose = 0.0, all = 0.0;
  for (const io::PatchResult& p : result.patches) {
    all += p.fn;
    if (p.y_tr < kBetween) nose += p.fn;
  }
  return nose / all;
}

std::vector<io::PatchResult> from_left(const io::CaseResult& result) {
  std::vector<io::PatchResult> patches = result.patches;
  ranges::sort(patches, {}, &io::PatchResult::y_tr);
  return patches;
}

TEST(CrossingPassage, BackendsAgreeWhileTheLoadMovesToTheNose) {
  CompareSettings settings;
  settings.rail_backends = {"mesh", "offset"};
  settings.resolutions = {1e-3};
  const io::Comparison compared = compare_cases(passage(-32e-3, -27e-3, 0.5e-3), settings);
  ASSERT_EQ(compared.candidates.size(), 3u);
  const std::vector<io::CaseResult>& truth = compared.candidates[0].results;
  int with_both = 0;
  for (const io::ComparisonCandidate& other : compared.candidates) {
    SCOPED_TRACE(other.name);
    ASSERT_EQ(other.failure, "");
    ASSERT_EQ(other.results.size(), 11u);
    for (std::size_t i = 0; i < other.results.size(); ++i) {
      const io::CaseResult &a = truth[i], &b = other.results[i];
      SCOPED_TRACE(a.s);
      ASSERT_EQ(b.status, Status::ok) << b.message;
      EXPECT_NEAR(b.force_tr.z(), kLoad, 1e-4 * kLoad);
      EXPECT_LE((a.force_tr - b.force_tr).cwiseAbs().maxCoeff(), 0.01 * kLoad);
      EXPECT_NEAR(a.z, b.z, 1e-6);
      ASSERT_EQ(a.patches.size(), b.patches.size());
      const std::vector<io::PatchResult> of_a = from_left(a), of_b = from_left(b);
      double pmax = 0.0;
      for (const io::PatchResult& p : of_a) pmax = std::max(pmax, p.pmax);
      for (std::size_t k = 0; k < of_a.size(); ++k) {
        EXPECT_NEAR(of_a[k].fn, of_b[k].fn, 0.01 * kLoad);
        EXPECT_NEAR(of_a[k].pmax, of_b[k].pmax, 0.03 * pmax);
        EXPECT_NEAR(of_a[k].x_tr, of_b[k].x_tr, 0.05e-3);
        EXPECT_NEAR(of_a[k].y_tr, of_b[k].y_tr, 0.05e-3);
      }
      with_both += a.patches.size() == 2 ? 1 : 0;
    }
  }
  EXPECT_GE(with_both, 3 * 5) << "nose and wing carry together";
}

TEST(CrossingPassage, TheLoadMovesToTheNoseSmoothly) {
  const auto changes = [](double step) {
    const io::RunResult run = run_cases(passage(-32e-3, -27e-3, step));
    EXPECT_EQ(share_of_nose(run.cases.front()), 0.0);
    EXPECT_EQ(share_of_nose(run.cases.back()), 1.0);
    std::vector<double> all;
    for (std::size_t i = 1; i < run.cases.size(); ++i) {
      EXPECT_EQ(run.cases[i].status, Status::ok);
      all.push_back(share_of_nose(run.cases[i]) - share_of_nose(run.cases[i - 1]));
      EXPECT_GE(all.back(), 0.0) << run.cases[i].s;
    }
    return *ranges::max_element(all);
  };
  const double coarse = changes(0.5e-3), middle = changes(0.25e-3), fine = changes(0.125e-3);
  EXPECT_LE(coarse, 0.18);
  EXPECT_NEAR(middle / coarse, 0.5, 0.03);
  EXPECT_NEAR(fine / middle, 0.5, 0.03);
}

}  // namespace
}  // namespace treadmark::app
