// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Rows of points over an arc by kernels against one point at a time.
#include "treadmark/backends/analytic/arc_row.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "treadmark/backends/analytic/arc_graph.hpp"
#include "treadmark/tests/support/kernels.hpp"

namespace treadmark::analytic {
namespace {

TEST(ArcRow, AgreesWithSinglePoints) {
  // Of metres and slopes up to a few: some roundings.
  constexpr double kRoom = 1e-15, kSlopeRoom = 1e-12;
  const double angle = 0.4;
  const std::vector<ArcGraph> arcs{{-0.02, 0.02, 1e-3, 2e-3, std::sin(angle), std::cos(angle), 0.0},
                                   {-0.02, 0.02, 1e-3, 2e-3, std::sin(angle), std::cos(angle), 12.5},
                                   {-0.02, 0.02, 1e-3, 2e-3, std::sin(angle), std::cos(angle), -20.0},
                                   {-0.02, 0.02, 1e-3, 2e-3, std::sin(angle), -std::cos(angle), 3.3}};
  constexpr int kCount = 23, kFirst = 2, kLast = 21;
  for (const ArcRowKernel* kernel : all_kernels<ArcRowKernel>())
    for (const ArcGraph& arc : arcs) {
      const ArcRow row{arc.x0, arc.h0, arc.s0, arc.c0, arc.k, -0.003, 0.7, 0.004, -0.2, 1.1, -0.015, 1.3e-3};
      std::vector<double> z(kCount, -1.0), slope(kCount, -1.0), alone(kCount, -1.0);
      kernel->heights(row, kFirst, kLast, z.data(), slope.data());
      kernel->heights(row, kFirst, kLast, alone.data(), nullptr);
      EXPECT_EQ(z, alone);
      for (int i = 0; i < kCount; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (i < kFirst || i >= kLast) {
          EXPECT_EQ(z[k], -1.0) << i;
          EXPECT_EQ(slope[k], -1.0) << i;
          continue;
        }
        const double x = row.x_first + i * row.dx;
        double expected_slope = 0.0;
        const double h = arc.height_and_slope(row.w_row + row.w_x * x, expected_slope);
        EXPECT_NEAR(z[k], (h - (row.a_row + row.a_x * x)) * row.per_m, kRoom) << i;
        EXPECT_NEAR(slope[k], expected_slope, kSlopeRoom) << i;
      }
    }
}

}  // namespace
}  // namespace treadmark::analytic
