// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/pages/simulation_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/app/simulation/pages/history_panels.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/tests/report/page_reader.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::HasSubstr;
using namespace treadmark::testing;

/// A force that swings, with one peak of a single instant.
std::shared_ptr<io::SimulationResult> sample(std::size_t rows, std::size_t peak) {
  auto result = std::make_shared<io::SimulationResult>();
  result->title = "A flat at 40 m/s";
  result->columns = {{"t_s", "s", "time"},
                     {"x_m", "m", "distance"},
                     {"Q_N", "N", "vertical force on the rail (ws1_right)"},
                     {"Ty_N", "N", "lateral creep force on the rail (ws1_right)"},
                     {"ws1_left.Q_N", "N", "vertical force on the rail"}};
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = 1e-4 * static_cast<double>(k);
    for (const double value : {t, 40.0 * t, k == peak ? 3e5 : 5e4 + 1e3 * std::sin(90.0 * t), -200.0, 5.1e4})
      result->values.push_back(value);
  }
  result->summary = {{"q_max_N", 3e5, "N", "largest vertical force"}, {"q_max_x_m", 0.4, "m", "where"}};
  result->statics = {{"ws1_right.Q_N", 5e4, "N", "vertical force"}};
  return result;
}

TEST(SimulationPage, HistoriesAndTablesHoldTheNumbers) {
  const Page page = simulation_page(sample(300, 77), "");
  EXPECT_EQ(page.title, "A flat at 40 m/s");
  ASSERT_TRUE(page.timeline);
  EXPECT_EQ(page.timeline->count(), 300u);
  const auto& forces = std::get<ChartView>(figure_of(page, "forces").view);
  EXPECT_TRUE(forces.linked);
  EXPECT_NEAR(forces.panels[0].series[0].y[77], 300.0, 1e-9);  // kN
  EXPECT_NEAR(forces.panels[0].levels[0].value, 50.0, 1e-9);
  const auto& wheels = std::get<ChartView>(figure_of(page, "wheels").view);
  EXPECT_EQ(wheels.panels[0].series[0].name, "ws1_right");
  EXPECT_EQ(wheels.panels[0].series[1].name, "ws1_left");
  // In the units of the cards above it.
  const Table& summary = table_of(page, "summary");
  EXPECT_THAT(numbers_in(summary, "value"),
              ::testing::Pointwise(::testing::DoubleNear(1e-9), std::vector<double>{300.0, 0.4}));
  EXPECT_EQ(std::get<std::string>(summary.rows[0].cells[0]), "q_max");
  EXPECT_EQ(std::get<std::string>(summary.rows[0].cells[3]), "kN");
  EXPECT_EQ(std::get<std::string>(summary.rows[1].cells[3]), "m");
  EXPECT_THAT(card_of(page, "Largest vertical force"), HasSubstr("300 kN"));
  EXPECT_TRUE(banners_of(page).empty());
}

TEST(SimulationPage, UnfinishedAndFailedOnesSaySo) {
  auto interrupted = sample(30, 7);
  interrupted->status = "interrupted";
  interrupted->message = "stopped at t = 0.003 s";
  EXPECT_THAT(banners_of(simulation_page(interrupted, "")),
              ::testing::StartsWith("failed: Interrupted. stopped at t = 0.003 s"));
  auto failed = sample(0, 0);
  failed->status = "failed";
  failed->message = "no <balance>";
  const Page page = simulation_page(failed, "");
  EXPECT_THAT(banners_of(page), HasSubstr("failed: Failed. no <balance>"));
  EXPECT_FALSE(page.timeline);
}

TEST(SimulationPage, StepsShowTheLastSnapshot) {
  auto result = sample(100, 7);
  for (int k = 0; k < 2; ++k) {
    io::CaseResult snapshot;
    snapshot.number = k + 1;
    snapshot.has_wheelset = true;
    io::PatchResult patch;
    patch.fields.grid = Grid2{0.0, 0.0, 1e-3, 1e-3, 2, 2};
    patch.fields.pressure.assign(4, 1e8);
    patch.fields.state.assign(4, 1);
    snapshot.patches.push_back(patch);
    result->snapshots.cases.push_back(snapshot);
  }
  result->snapshot_times = {0.002, 0.005};
  result->snapshot_scenes.resize(2);
  result->snapshot_scenes[0].nominal = true;
  const Page page = simulation_page(result, "");
  const std::vector<int>& frames = page.timeline->frames;
  EXPECT_EQ(frames[19], -1);
  EXPECT_EQ(frames[20], 0);
  EXPECT_EQ(frames[49], 0);
  EXPECT_EQ(frames[50], 1);
  EXPECT_EQ(frames[99], 1);
  EXPECT_EQ(page.sets[0].nominal, 0);
  EXPECT_TRUE(has_figure(page, "patches-view"));
}

TEST(HistoryPanels, ThinningKeepsPeaks) {
  const auto result = sample(50'000, 31'234);
  const auto rows = thinned_rows(*result, {"Q_N", "Ty_N"}, 400);
  EXPECT_LE(rows.size(), 400u);
  EXPECT_GT(rows.size(), 100u);
  EXPECT_TRUE(ranges::is_sorted(rows));
  EXPECT_EQ(rows.front(), 0u);
  EXPECT_EQ(rows.back(), 49'999u);
  EXPECT_TRUE(ranges::binary_search(rows, std::size_t{31'234}));
  EXPECT_EQ(thinned_rows(*result, {"Q_N"}, 60'000).size(), 50'000u);
  EXPECT_EQ(thinned_rows(*result, {"nothing"}, 100).size(), 100u);
}

TEST(HistoryPanels, UnitsFollowNames) {
  EXPECT_EQ(shown_unit("x_m").name, "m");
  EXPECT_EQ(shown_unit("wheelset_vroll_rad_s").name, "rad/s");
  EXPECT_EQ(shown_name("wheelset_vroll_rad_s"), "wheelset_vroll");
  EXPECT_EQ(shown_unit("q_max_x_m").name, "m");
  EXPECT_EQ(shown_unit("approach_max_m").name, "mm");
  EXPECT_EQ(shown_unit("gap_m").factor, 1e3);
  EXPECT_EQ(shown_unit("Q_N").name, "kN");
  EXPECT_EQ(shown_unit("ws1_right.Tgamma_N").name, "N");
  EXPECT_EQ(shown_unit("patches").name, "");
}

}  // namespace
}  // namespace treadmark::app::pages
