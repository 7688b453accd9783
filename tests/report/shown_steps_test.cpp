// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/shown_steps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/write_page.hpp"
#include "treadmark/tests/report/page_reader.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::table_of;

TEST(SpreadRows, KeepsEndsExtremesAndWantedRowsAndNoMoreThanAllowed) {
  const auto wave = [](std::size_t row) {
    return row == 7777 ? 50.0 : row == 20 ? kNaN : std::sin(0.01 * static_cast<double>(row));
  };
  const auto slope = [](std::size_t row) { return row == 31 ? -1e6 : static_cast<double>(row); };
  const std::vector<std::size_t> rows = spread_rows(10'000, 300, {wave, slope}, {5, 4567});
  EXPECT_EQ(rows.size(), 300u);
  EXPECT_TRUE(ranges::is_sorted(rows, std::less_equal<>()));
  for (const std::size_t row : {0u, 5u, 31u, 4567u, 7777u, 9999u}) EXPECT_THAT(rows, Contains(row));
  // No gap is wide.
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_LT(rows[i] - rows[i - 1], 150u);
}

TEST(SpreadRows, AllOfFewAndHalfOfTheRoomForManyWantedOnes) {
  EXPECT_EQ(spread_rows(3, 5, {}), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(spread_rows(0, 5, {}).empty());
  std::vector<std::size_t> wanted;
  for (std::size_t row = 0; row < 5000; ++row) wanted.push_back(row);
  const std::vector<std::size_t> rows = spread_rows(10'000, 100, {}, wanted);
  EXPECT_EQ(rows.size(), 100u);
  EXPECT_GE(ranges::count_if(rows, [](std::size_t row) { return row >= 5000; }), 20);
  const auto nothing = [](std::size_t) { return kNaN; };
  EXPECT_EQ(spread_rows(1000, 40, {nothing, nothing}).size(), 40u);
}

/// Cases with one patch of 2 by 1 elements each.
std::shared_ptr<io::RunResult> many_cases(int cases) {
  auto run = std::make_shared<io::RunResult>();
  run->input_file = "many.toml";
  run->cases_total = cases;
  for (int i = 0; i < cases; ++i) {
    io::CaseResult result;
    result.number = i + 1;
    result.has_wheelset = true;
    result.pitch = 1e-4 * i;
    result.force_tr = {0.0, 0.0, 1e5 + (i == 1234 ? 9e4 : 0.0)};
    io::PatchResult patch;
    patch.fields.grid = Grid2{0.0, 0.0, 1e-3, 1e-3, 2, 1};
    patch.fields.pressure = {1e9 + 1e3 * i, 1e8};
    patch.fields.state = {1, 1};
    patch.ncon = 2;
    patch.pmax = i == 4321 ? 3e9 : 1e9 + 1e3 * i;
    patch.fn = 1e5;
    result.patches.push_back(std::move(patch));
    run->cases.push_back(std::move(result));
  }
  run->cases[77].status = Status::not_converged;
  return run;
}

TEST(ShownSteps, OfManyCasesThePageKeepsWhatIsNotableWithItsOwnNumbers) {
  const auto run = many_cases(6000);
  const Page whole = run_page(run, ""), page = with_shown_steps(whole);
  const Table& cases = table_of(page, "cases");
  EXPECT_EQ(cases.rows.size(), 1000u);
  EXPECT_EQ(table_of(whole, "cases").rows.size(), 6000u);
  ASSERT_TRUE(page.timeline);
  EXPECT_EQ(page.timeline->count(), 1000u);
  // The worst case is shown first; every step has the row, the frame and the axis value of one case.
  std::vector<int> numbers;
  for (std::size_t k = 0; k < 1000; ++k) {
    const int number = static_cast<int>(std::get<Number>(cases.rows[k].cells[0]).value);
    numbers.push_back(number);
    EXPECT_EQ(cases.rows[k].step, static_cast<int>(k));
    EXPECT_EQ(page.timeline->axes.back().values[k], number);
    EXPECT_THAT(page.timeline->names[k], HasSubstr("case " + std::to_string(number) + ","));
    const int frame = page.timeline->frames[k];
    ASSERT_EQ(page.sets.front().frames[static_cast<std::size_t>(frame)].result->number, number);
  }
  EXPECT_EQ(numbers[page.timeline->start], 4322);
  for (const int number : {1, 78, 1235, 4322, 6000}) EXPECT_THAT(numbers, Contains(number));
  const Table& patches = table_of(page, "patches");
  ASSERT_EQ(patches.rows.size(), 1000u);
  EXPECT_EQ(std::get<Number>(patches.rows[500].cells[0]).value, numbers[500]);

  const std::string text = to_html(whole);
  EXPECT_LT(text.size(), 8'000'000u);
  EXPECT_THAT(text, HasSubstr("1000 of 6000 cases are on this page:"));
  EXPECT_THAT(text, HasSubstr("All are in fields.h5."));
  EXPECT_THAT(to_html(run_page(many_cases(500), "")), Not(HasSubstr("are on this page")));
}

TEST(ShownSteps, TablesWithoutStepsKeepSomeRows) {
  Page page{"bench", "many", ""};
  Table table{"all", "Everything.", {{"n"}}};
  for (int i = 0; i < 9000; ++i) table.rows.push_back({{Number{static_cast<double>(i)}}});
  page.sections.push_back({"one", "One", {table}});
  const Page few = with_shown_steps(page);
  EXPECT_EQ(table_of(few, "all").rows.size(), 2000u);
  EXPECT_EQ(std::get<Number>(table_of(few, "all").rows.back().cells[0]).value, 8999.0);
  EXPECT_THAT(table_of(few, "all").caption, HasSubstr("2000 of 9000 rows"));
}

TEST(ShownSteps, PointsOfChosenStepsFollowThem) {
  Page page{"sweep", "many", ""};
  Timeline timeline{"run"};
  Axis runs{"run", ""};
  Series series{"all", {}};
  Series other{"without steps", {1.0, 2.0}};
  for (int i = 0; i < 3000; ++i) {
    runs.values.push_back(i + 1);
    // Points of a line stand in another order than the runs.
    series.steps.push_back(2999 - i);
    series.x.push_back(10.0 * (2999 - i));
    series.y.push_back(i == 2000 ? -7.0 : i);
    series.texts.push_back("run " + std::to_string(3000 - i));
  }
  timeline.axes.push_back(runs);
  page.timeline = timeline;
  ChartView view;
  view.x = Axis{"x", ""};
  view.panels.push_back({"p", "", false, {series, other}});
  page.sections.push_back({"one", "One", {Figure{"f", "f", view}}});
  const Page few = with_shown_steps(page);
  const auto& chart = std::get<ChartView>(std::get<Figure>(few.sections.front().blocks.back()).view);
  const Series& shown = chart.panels.front().series.front();
  ASSERT_EQ(shown.y.size(), 1000u);
  EXPECT_THAT(shown.y, Contains(-7.0));
  for (std::size_t i = 0; i < shown.y.size(); ++i) {
    const double run = few.timeline->axes.front().values[static_cast<std::size_t>(shown.steps[i])];
    EXPECT_EQ(shown.x[i], 10.0 * (run - 1.0));
    EXPECT_EQ(shown.texts[i], "run " + std::to_string(static_cast<int>(run)));
  }
  EXPECT_EQ(chart.panels.front().series.back().y.size(), 2u);
}

}  // namespace
}  // namespace treadmark::app::pages
