// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/app/simulation/pages/sweep_page.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/tests/report/page_reader.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::HasSubstr;
using namespace treadmark::testing;

/// A folder as a study leaves it that was stopped: runs 1 to 4 of 6, one of them failed.
class StoppedStudy : public ::testing::Test {
 protected:
  StoppedStudy() {
    std::string identity = "treadmark 0.1.0 abc\nbase 123\n";
    for (int run = 1; run <= 6; ++run)
      identity += fmt::format("run {}\n  swept speed_m_s: {}\n", run, 10 * ((run + 1) / 2));
    write_file(folder_.path() / "study.id", identity);
    for (int run = 1; run <= 4; ++run) write_run(run);
    write_file(folder_.path() / "force.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"></svg>");
  }

  void write_run(int run) {
    io::SimulationResult result;
    result.version = "0.1.0";
    result.title = "base";
    result.swept = {{"speed_m_s", std::to_string(10 * ((run + 1) / 2))}, {"cant", run % 2 == 0 ? "1:40" : "none"}};
    result.columns = {{"t_s", "s", "time"}, {"x_m", "m", "distance"}, {"Q_N", "N", "force"}};
    for (int k = 0; k < 5; ++k)
      for (const double value : {0.1 * k, 1.0 * k, 1e4 * run + k}) result.values.push_back(value);
    result.summary = {{"q_max_N", 1e4 * run, "N", "largest vertical force"}};
    if (run == 3) {
      result.status = "failed";
      result.message = "<b>no balance</b>";
    }
    io::write_simulation(folder_.path() / "runs" / fmt::format("run_{:04}", run) / "simulation.h5", result);
  }

  TemporaryFolder folder_;
};

TEST_F(StoppedStudy, SaysWhatIsMissingAndShowsTheRest) {
  const Page page = read_report(folder_.path());
  const std::string banners = banners_of(page);
  EXPECT_THAT(banners, ::testing::StartsWith("failed: Not finished. 2 runs missing: run 5, 6"));
  EXPECT_THAT(banners, HasSubstr("failed: 1 run did not complete."));
  EXPECT_THAT(banners, HasSubstr("<b>no balance</b>"));
  EXPECT_EQ(table_of(page, "runs").rows.size(), 4u);
  EXPECT_THAT(numbers_in(table_of(page, "runs"), "q_max"), ::testing::ElementsAre(10.0, 20.0, 30.0, 40.0));
  EXPECT_THAT(texts_in(table_of(page, "runs"), "cant"), ::testing::ElementsAre("none", "1:40", "none", "1:40"));
  EXPECT_THAT(card_of(page, "Runs"), HasSubstr("4 of 6"));
}

TEST_F(StoppedStudy, ChartsHaveALineForEachChoiceOfTheOtherKeys) {
  const Page page = read_report(folder_.path());
  const auto& chart = std::get<ChartView>(figure_of(page, "summary-1").view);
  ASSERT_EQ(chart.panels[0].series.size(), 2u);
  EXPECT_EQ(chart.panels[0].series[1].name, "cant 1:40");
  EXPECT_THAT(chart.panels[0].series[1].x, ::testing::ElementsAre(10.0, 20.0));
  EXPECT_THAT(chart.panels[0].series[1].y, ::testing::ElementsAre(20.0, 40.0));
  EXPECT_THAT(chart.panels[0].series[1].steps, ::testing::ElementsAre(1.0, 3.0));
  const auto& history = std::get<ChartView>(figure_of(page, "history-of-run").view);
  ASSERT_EQ(history.by_step.size(), 4u);
  EXPECT_THAT(history.by_step[1].x, ::testing::ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0));
  EXPECT_NEAR(history.by_step[1].y[0][0][4], 20.004, 1e-12);
  EXPECT_TRUE(has_figure(page, "picture-force.svg"));
}

TEST(SweepPage, CallsKeysAsTheStudyDoes) {
  StudyOnDisk disk;
  disk.study.labels = {{"wheelset.y_mm", "lateral shift [mm]"}};
  for (int run = 1; run <= 3; ++run)
    disk.study.runs.push_back({run,
                               {{"wheelset.y_mm", std::to_string(run)}},
                               "",
                               "complete",
                               "",
                               {{"q_max_N", 1e4 * run, "N", "force"}},
                               {}});
  const Page page = sweep_page(disk);
  EXPECT_EQ(page.lead, "Study of 3 runs over lateral shift");
  const Figure& figure = figure_of(page, "summary-1");
  EXPECT_EQ(figure.title, "Over lateral shift");
  EXPECT_EQ(std::get<ChartView>(figure.view).x->label, "lateral shift");
  EXPECT_EQ(std::get<ChartView>(figure.view).x->unit, "mm");
}

TEST_F(StoppedStudy, BrokenStoresAreNamed) {
  write_file(folder_.path() / "runs" / "run_0002" / "simulation.h5", "broken");
  EXPECT_THAT(error_of([&] { read_report(folder_.path()); }), HasSubstr("run_0002"));
  write_file(folder_.path() / "study.id", "run x\n");
  EXPECT_THAT(error_of([&] { read_report(folder_.path()); }), HasSubstr("run x"));
}

}  // namespace
}  // namespace treadmark::app::pages
