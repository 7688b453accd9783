// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

TEST(ShapeCurve, AParabolaIsExact) {
  const ShapeCurve curve({-1.0, 0.5, 1.0}, {1.0, 0.25, 1.0}, {-2.0, 1.0, 2.0});
  for (double x = -1.0; x <= 1.0; x += 0.01) {
    EXPECT_NEAR(curve.at(x).value, x * x, 1e-14);
    EXPECT_NEAR(curve.at(x).slope, 2.0 * x, 1e-13);
  }
}

TEST(ShapeCurve, SlopeIsTheDerivativeAndKeepsBetweenItsEnds) {
  const ShapeCurve curve({0.0, 1.0, 2.0}, {0.0, 0.4, 2.9}, {0.1, 2.5, 2.5});
  const double h = 1e-7;
  for (double x = 0.0137; x < 2.0; x += 0.05) {
    const ShapeCurve::Point p = curve.at(x);
    EXPECT_NEAR(p.slope, (curve.at(x + h).value - curve.at(x - h).value) / (2.0 * h), 1e-6);
    EXPECT_GE(p.slope, 0.1 - 1e-12);
    EXPECT_LE(p.slope, 2.5 + 1e-12);
  }
}

TEST(ShapeCurve, MonotoneDataGiveAMonotoneCurve) {
  const ShapeCurve curve = ShapeCurve::monotone({0.0, 1.0, 1.5, 4.0, 5.0, 6.0}, {0.0, 0.01, 3.0, 3.0, 3.1, 9.0});
  double last = 0.0;
  for (double x = 0.0; x <= 6.0; x += 0.003) {
    const double value = curve.at(x).value;
    EXPECT_GE(value, last - 1e-14);
    last = std::max(last, value);
  }
  EXPECT_NEAR(curve.at(1.5).value, 3.0, 1e-14);
}

TEST(ShapeCurve, DisorderIsRefused) {
  EXPECT_THROW(ShapeCurve::monotone({0.0, 0.0}, {1.0, 2.0}), Error);
  EXPECT_THROW(ShapeCurve::monotone({0.0, 1.0}, {1.0}), Error);
  EXPECT_THROW(ShapeCurve({0.0, 1.0}, {1.0, 2.0}, {1.0}), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
