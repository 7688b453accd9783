// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/registry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <random>
#include <thread>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/consumer/project/chebyshev_series.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

const SurfaceSpec kRail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};

/// A row that hands the surface back as it is.
Backend same_surface(std::string name) {
  return {std::move(name), "the surface itself", 2.0, false, [](Resampling& r) { return r.natural().surface; }};
}

void expect_refused_row(Backend row, const char* words) {
  try {
    register_backend(std::move(row));
    ADD_FAILURE() << "accepted, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST(Registry, RefusesRowsThatCannotBeUsed) {
  const std::size_t before = backends().size();
  for (const char* name : {"", "Mesh", "my mesh", "1st", "-mesh", "maillage\xc3\xa9"})
    expect_refused_row(same_surface(name), "no case file could hold");
  expect_refused_row(same_surface("mesh"), "exists already");
  Backend row = same_surface("half-a-row");
  row.summary.clear();
  expect_refused_row(row, "no summary");
  row = same_surface("half-a-row");
  row.natural_for = [](const SurfaceSpec&) { return true; };
  expect_refused_row(row, "only one of");
  row = same_surface("half-a-row");
  row.resample = nullptr;
  expect_refused_row(row, "makes nothing");
  EXPECT_EQ(backends().size(), before);
}

TEST(Registry, NewRowsAreUsedAndListedLast) {
  register_backend(same_surface("same"));
  EXPECT_EQ(backend_names().front(), "analytic");
  EXPECT_EQ(backend_names().back(), "same");
  const NaturalSurface rail = create_natural(kRail);
  const RepresentedSurface r = represent(rail, {"same", 2e-3, {}});
  EXPECT_TRUE(r.resampled);
  EXPECT_EQ(r.surface, rail.surface);
  EXPECT_EQ(r.resolution, 2e-3);
  Backend none = same_surface("none");
  none.resample = [](Resampling&) { return nullptr; };
  register_backend(none);
  EXPECT_THROW(create_surface(kRail, "none"), Error);
}

TEST(Registry, ChoicesAreAsGivenFirstThenAtEveryResolution) {
  const NaturalSurface rail = create_natural(kRail);
  const NaturalSurface spline{rail.spec, create_surface(kRail, "spline"), ""};
  const auto text = [](const std::vector<BackendChoice>& choices) {
    std::string out;
    for (const auto& c : choices) out += c.backend + (c.resolution > 0.0 ? "@ " : " ");
    return out;
  };
  EXPECT_EQ(text(backend_choices({"spline", "analytic"}, {1e-3, 2e-3}, {&rail})), "spline@ spline@ analytic ");
  EXPECT_EQ(text(backend_choices({"spline", "analytic"}, {1e-3}, {&spline})), "spline spline@ analytic ");
  EXPECT_EQ(text(backend_choices({"spline"}, {1e-3}, {&spline, &rail})), "spline@ ");
  EXPECT_THAT(text(backend_choices({}, {1e-3}, {&rail})),
              HasSubstr("analytic spline@ nurbs@ thb@ thb-quadratic@ mesh@ "));
  EXPECT_THAT(text(backend_choices({}, {1e-3}, {&spline})), ::testing::StartsWith("spline spline@ nurbs@ "));
  EXPECT_THROW(backend_choices({"splines"}, {1e-3}, {&rail}), Error);
}

/// A row of the part that this build leaves out is known by name, and no more.
TEST(Registry, WhatIsLeftOutSaysHowItIsPutIn) {
  std::string left_out;
  for (const Backend* row : left_out_backends()) left_out += row->name + ' ';
  EXPECT_EQ(left_out, has_part("openvdb") ? "" : "level-set ");
  if (has_part("openvdb")) {
    EXPECT_EQ(backend_of("level-set").part, "openvdb");
    return;
  }
  EXPECT_THAT(backend_names(), ::testing::Not(::testing::Contains("level-set")));
  try {
    create_surface(kRail, "level-set");
    ADD_FAILURE() << "level-set is not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_EQ(error.message(), left_out_message("openvdb", "the backend 'level-set'"));
    EXPECT_EQ(error.advice(), left_out_advice("openvdb"));
  }
}

TEST(Registry, ManyThreadsMayRegisterAndRead) {
  constexpr int kThreads = 8, kRows = 20;
  std::atomic<int> own{0}, shared{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < kRows; ++i) {
        register_backend(same_surface("thread-" + std::to_string(t) + "-" + std::to_string(i)));
        try {
          register_backend(same_surface("shared-" + std::to_string(i)));
          ++shared;
        } catch (const Error&) {
        }
        for (const Backend* row : backends()) own += row->name.starts_with("thread-" + std::to_string(t) + "-");
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(shared, kRows);
  EXPECT_EQ(own, kThreads * kRows * (kRows + 1) / 2);
}

/// A smooth function and one with a kink, against the formulas and dense samples.
TEST(ChebyshevSeries, FollowsFunctionsAndBoundsThem) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto smooth = [](double x) { return std::cos(3.0 * x) * std::exp(x); };
  const auto kinked = [](double x) { return std::fabs(x - 0.3); };
  for (const std::function<double(double)>& f : {std::function<double(double)>(smooth), {kinked}})
    for (const double period : {0.0, 6.0}) {
      const double begin = -0.7, end = 1.1;
      std::vector<double> values;
      for (const double x : ChebyshevSeries::nodes(begin, end, 80)) values.push_back(f(x));
      const ChebyshevSeries series(begin, end, values, period);
      const double tolerance = f(0.31) == kinked(0.31) ? 0.02 : 1e-12;
      for (double x = begin; x <= end; x += 0.01) {
        EXPECT_NEAR(series.jet(x).value, f(x), tolerance);
        EXPECT_NEAR(series.jet(x + period).value, series.jet(x).value, 1e-10);
        if (x < begin + 0.01 || x > end - 0.02) continue;
        constexpr double kStep = 1e-5;
        const auto below = series.jet(x - kStep), at = series.jet(x), above = series.jet(x + kStep);
        EXPECT_NEAR(at.slope, (above.value - below.value) / (2.0 * kStep), 1e-4);
        EXPECT_NEAR(at.bend, (above.slope - below.slope) / (2.0 * kStep), 1e-2 + 1e-3 * std::fabs(at.bend));
      }
      for (int trial = 0; trial < 200; ++trial) {
        const double from = -4.0 + 8.0 * unit(random), width = std::pow(10.0, -4.0 + 5.0 * unit(random));
        const ChebyshevSeries::Range range = series.range(from, from + width);
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i <= 200; ++i) {
          const auto jet = series.jet(from + width * i / 200.0);
          ASSERT_GE(jet.value, range.low);
          ASSERT_LE(jet.value, range.high);
          ASSERT_LE(std::fabs(jet.slope), range.steepest);
          low = std::min(low, jet.value);
          high = std::max(high, jet.value);
        }
        if (width < 1e-2) {
          EXPECT_LT(range.high - range.low, high - low + 0.1);
        }
      }
    }
}

}  // namespace
}  // namespace treadmark::testing
