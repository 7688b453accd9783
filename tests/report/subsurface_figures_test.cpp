// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/subsurface_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::ElementsAre;

/// A block whose von Mises stress is 100 MPa + 1 MPa/mm x - 10 MPa/mm |n|, and more in the row of s = 1 mm.
io::SubsurfaceBlock block(const std::vector<double>& x_mm, const std::vector<double>& s_mm,
                          const std::vector<double>& n_mm) {
  io::SubsurfaceBlock out{
      static_cast<int>(x_mm.size()), static_cast<int>(s_mm.size()), static_cast<int>(n_mm.size()), {}};
  for (const double n : n_mm)
    for (const double s : s_mm)
      for (const double x : x_mm) {
        io::SubsurfaceValue v;
        v.point = 1e-3 * Vec3(x, s, n);
        v.von_mises = 1e6 * (100.0 + x - 10.0 * std::fabs(n) + (s == 1.0 ? 5.0 : 0.0));
        v.principal = {2.0 * v.von_mises, 0.0, -3.0 * v.von_mises};
        out.values.push_back(v);
      }
  return out;
}

io::RunResult run_with(std::vector<io::SubsurfaceBlock> blocks) {
  io::RunResult run;
  for (int i = 0; i < 2; ++i) {
    io::CaseResult& result = run.cases.emplace_back();
    result.number = i + 1;
    result.patches.emplace_back();
    if (i == 1) result.patches.front().subsurface = blocks;
  }
  return run;
}

std::vector<std::string> ids(const Section& section) {
  std::vector<std::string> out;
  for (const Block& b : section.blocks) out.push_back(std::get<Figure>(b).id);
  return out;
}

TEST(SubsurfaceFigures, AreThereWherePointsSpanAPlane) {
  EXPECT_FALSE(subsurface_section(run_with({})));
  EXPECT_FALSE(subsurface_section(run_with({block({0, 1, 2}, {0, 1}, {1.0})}))) << "one depth";
  const auto along = subsurface_section(run_with({block({0, 1, 2}, {0}, {1.0, 2.0})}));
  ASSERT_TRUE(along);
  EXPECT_THAT(ids(*along), ElementsAre("von-mises-along-rail", "greatest-principal-along-rail",
                                       "least-principal-along-rail", "stress-by-depth"));
  const auto wheel = subsurface_section(run_with({block({0}, {0, 1}, {-1.0, -2.0})}));
  ASSERT_TRUE(wheel);
  EXPECT_EQ(ids(*wheel).front(), "von-mises-across-wheel");
}

TEST(SubsurfaceFigures, MapsAreLinearBetweenThePointsOfTheWorstPlane) {
  // Lines in no order, uneven, of both bodies in one block.
  const auto section = subsurface_section(run_with({block({4, -2, 1}, {0, 1, 2}, {3.0, 0.5, 1.0, -1.0, -4.0})}));
  ASSERT_TRUE(section);
  ASSERT_EQ(section->blocks.size(), 13U);
  for (const auto& [figure, low, high] : {std::tuple{0U, -3.0, -0.5}, std::tuple{6U, 1.0, 4.0}}) {
    const Figure& shown = std::get<Figure>(section->blocks[figure]);
    const auto& map = std::get<MapView>(shown.view);
    ASSERT_EQ(map.by_step.size(), 2U);
    EXPECT_TRUE(ranges::all_of(map.by_step[0], [](double v) { return std::isnan(v); })) << "no points in this case";
    EXPECT_NEAR(map.x0, -2.0, 1e-12);
    EXPECT_NEAR(map.x0 + map.dx * (map.nx - 1), 4.0, 1e-12);
    EXPECT_NEAR(map.y0, low, 1e-12);
    EXPECT_NEAR(map.y0 + map.dy * (map.ny - 1), high, 1e-12);
    for (int j = 1; j + 1 < map.ny; ++j)
      for (int i = 1; i + 1 < map.nx; ++i) {
        const double x = map.x0 + i * map.dx, height = map.y0 + j * map.dy;
        EXPECT_NEAR(map.by_step[1][static_cast<std::size_t>(j * map.nx + i)], 105.0 + x - 10.0 * std::fabs(height),
                    1e-9)
            << shown.id << ' ' << x << ' ' << height;
      }
  }
  const auto& least = std::get<MapView>(std::get<Figure>(section->blocks[2]).view);
  EXPECT_LT(least.by_step[1][static_cast<std::size_t>(least.nx + 1)], 0.0);
}

TEST(SubsurfaceFigures, TheLargestStressOfEveryDepth) {
  const auto section = subsurface_section(run_with({block({0, 3}, {0, 1}, {2.0, 0.5, -2.0, -1.0})}));
  ASSERT_TRUE(section);
  const auto& chart = std::get<ChartView>(std::get<Figure>(section->blocks.back()).view);
  EXPECT_TRUE(chart.by_step[0].x.empty());
  EXPECT_THAT(chart.by_step[1].x, ElementsAre(0.5, 1.0, 2.0));
  const auto& lines = chart.by_step[1].y.front();
  EXPECT_NEAR(lines[0][0], 103.0, 1e-9);  // rail
  EXPECT_TRUE(std::isnan(lines[0][1]));
  EXPECT_NEAR(lines[0][2], 88.0, 1e-9);
  EXPECT_NEAR(lines[1][1], 98.0, 1e-9);  // wheel
}

}  // namespace
}  // namespace treadmark::app::pages
