// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/tests/representation/example_cases.hpp"

// A wheel flat known by formula, at the element size of its example: what contact results lose in every representation.

namespace treadmark::app {
namespace {

/// Greatest errors that are promised, over all cases.
struct Promise {
  double pmax;               ///< relative
  double area = 0.03;        ///< relative: whole elements only, about 90 round the edge of 900
  double force = 2e-3;       ///< of the vector on the rail; its vertical part is prescribed
  double position = 0.4e-3;  ///< [m]
};

void expect_close(const std::vector<double>& pitch_deg, double resolution,
                  const std::map<std::string, Promise>& promises) {
  CompareSettings settings;
  for (const auto& [backend, promise] : promises) settings.backends.push_back(backend);
  settings.resolutions = {resolution};
  const io::Comparison c = compare_cases(testing::wheel_flat_example(pitch_deg), settings);
  ASSERT_EQ(c.truth, "analytic");
  ASSERT_EQ(c.candidates.size(), promises.size() + 1);
  const io::ComparisonCandidate& truth = c.candidates.front();
  for (std::size_t k = 1; k < c.candidates.size(); ++k) {
    const io::ComparisonCandidate& candidate = c.candidates[k];
    SCOPED_TRACE(candidate.name);
    const Promise& promise = promises.at(candidate.name);
    ASSERT_EQ(candidate.failure, "");
    EXPECT_EQ(candidate.wheel.backend, candidate.name);
    EXPECT_EQ(candidate.wheel.resolution, resolution);
    EXPECT_EQ(candidate.rail.resolution, 0.0) << "the plain rail stays a formula";
    EXPECT_GT(candidate.wheel.difference.points, 10000u);
    EXPECT_EQ(candidate.wheel.difference.missing, 0u);
    ASSERT_EQ(candidate.rows.size(), pitch_deg.size());
    double pmax = 0.0, area = 0.0, force = 0.0, position = 0.0;
    for (std::size_t i = 0; i < candidate.rows.size(); ++i) {
      const io::ComparisonRow& row = candidate.rows[i];
      SCOPED_TRACE(pitch_deg[i]);
      ASSERT_TRUE(row.comparable) << row.message;
      EXPECT_EQ(row.patches, truth.rows[i].patches);
      EXPECT_LE(std::fabs(row.pmax_error), promise.pmax);
      EXPECT_LE(std::fabs(row.area_error), promise.area);
      EXPECT_LE(row.force_error, promise.force);
      EXPECT_LE(row.position_error, promise.position);
      pmax = std::max(pmax, std::fabs(row.pmax_error));
      area = std::max(area, std::fabs(row.area_error));
      force = std::max(force, row.force_error);
      position = std::max(position, row.position_error);
    }
    ::testing::Test::RecordProperty(candidate.name, std::to_string(pmax) + " " + std::to_string(area) + " " +
                                                        std::to_string(force) + " " + std::to_string(1e3 * position) +
                                                        " mm, built in " +
                                                        std::to_string(candidate.wheel.build_seconds) + " s");
  }
}

// Wanted of 1 mm: spline and offset 1 %, mesh 2 %, its triangles 5 %; of 0.25 mm: everything 1 %. What is promised here
// is less, some times what is found, so that a loss of an order shows.
TEST(WheelFlat, SamplesOfOneMillimetre) {
  expect_close(
      {-4.0, 0.0, 10.0}, 1e-3,
      {{"spline", {1e-4}}, {"nurbs", {2e-4}}, {"offset", {2e-4}}, {"offset-quadratic", {2e-3}}, {"mesh", {5e-4}}});
}

TEST(WheelFlat, FlatTrianglesOfOneMillimetre) { expect_close({-4.0, 0.0, 10.0}, 1e-3, {{"mesh-flat", {0.05}}}); }

TEST(WheelFlat, SamplesOfAQuarterOfAMillimetre) {
  expect_close({-4.0, 10.0}, 0.25e-3, {{"spline", {3e-5}}, {"offset", {3e-5}}, {"offset-bilinear", {2e-4}}});
}

TEST(WheelFlat, TrianglesOfAQuarterOfAMillimetre) { expect_close({-4.0}, 0.25e-3, {{"mesh", {3e-5}}}); }

TEST(WheelFlat, FlatTrianglesOfAQuarterOfAMillimetre) { expect_close({-4.0}, 0.25e-3, {{"mesh-flat", {0.01}}}); }

}  // namespace
}  // namespace treadmark::app
