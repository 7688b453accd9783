// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/app/cases/pages/run_overlay_page.hpp"
#include "treadmark/app/pages/overlay_parts.hpp"
#include "treadmark/app/simulation/pages/simulation_overlay_page.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/write_page.hpp"
#include "treadmark/tests/report/page_reader.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::Pointwise;
using namespace treadmark::testing;

/// A square patch of so many elements in contact; its pressure is even.
io::PatchResult even_patch(int n, double pressure, double element = 5e-4) {
  io::PatchResult patch;
  patch.has_reference = true;
  patch.fields.grid = Grid2{-1e-3, -1e-3, element, element, n, n};
  const std::size_t size = patch.fields.grid.size();
  patch.fields.pressure.assign(size, pressure);
  patch.fields.state.assign(size, 1);
  patch.fields.friction.assign(size, 0.3);
  patch.ncon = n * n;
  patch.fn = pressure * static_cast<double>(size) * element * element;
  patch.pmax = pressure;
  return patch;
}

/// Cases 1 to n; pressures grow by 10 MPa a case.
io::RunResult run_of(int n, double pressure = 1e9) {
  io::RunResult run;
  run.version = "0.1.0";
  run.input_file = "folder/flat.toml";
  run.cases_total = n;
  for (int i = 0; i < n; ++i) {
    io::CaseResult one;
    one.number = i + 1;
    one.has_wheelset = true;
    one.pitch = 0.01 * i;
    one.patches.push_back(even_patch(4, pressure + 1e7 * i));
    one.force_tr = {1e3, -2e3, 1e5};
    run.cases.push_back(std::move(one));
  }
  return run;
}

Page page_of(io::RunResult a, io::RunResult b) {
  return run_overlay_page({{"before", std::move(a)}, {"after", std::move(b)}});
}

std::string texts_of_row(const Table& table, const std::string& first) {
  for (const Table::Row& row : table.rows)
    if (std::get<std::string>(row.cells[0]) == first) {
      std::string out;
      for (std::size_t k = 1; k < row.cells.size(); ++k)
        out += (k == 1 ? "" : " | ") + std::get<std::string>(row.cells[k]);
      return out;
    }
  return "no row " + first;
}

TEST(Change, IsOfTheFirstAndRoundingIsNone) {
  EXPECT_DOUBLE_EQ(change(80.0, 60.0, 80.0).difference, -20.0);
  EXPECT_DOUBLE_EQ(change(80.0, 60.0, 80.0).percent, -25.0);
  EXPECT_DOUBLE_EQ(change(-80.0, 40.0, 80.0).percent, 150.0);
  EXPECT_EQ(change(80.0, 80.0 * (1.0 + 1e-10), 80.0).difference, 0.0);
  EXPECT_GT(change(80.0, 80.0 * (1.0 + 1e-8), 80.0).difference, 0.0);
  EXPECT_TRUE(std::isnan(change(0.01, 3.0, 80.0).percent));
  EXPECT_TRUE(std::isnan(change(NAN, 3.0, 80.0).difference));
  EXPECT_TRUE(std::isnan(change(0.0, 0.0, 0.0).percent));
}

TEST(Stretches, AreSaidByTheirEnds) {
  EXPECT_EQ(stretches(std::vector<int>{1, 2, 3, 7, 9, 10}), "1 to 3, 7, 9, 10");
  EXPECT_EQ(stretches(std::vector<int>{5}), "5");
}

TEST(RunOverlayPage, TablesAndCurvesHoldBothAndTheirDifferences) {
  io::RunResult b = run_of(3, 1.2e9);
  b.cases[2].patches[0].pmax = 5e8;  // the largest difference: 1020 to 500 MPa
  const Page page = page_of(run_of(3), std::move(b));
  const Table& cases = table_of(page, "cases");
  EXPECT_THAT(numbers_in(cases, "largest pressure, before"), Pointwise(DoubleNear(1e-9), {1000.0, 1010.0, 1020.0}));
  EXPECT_THAT(numbers_in(cases, "largest pressure, after"), Pointwise(DoubleNear(1e-9), {1200.0, 1210.0, 500.0}));
  EXPECT_THAT(numbers_in(cases, "largest pressure, difference"), Pointwise(DoubleNear(1e-9), {200.0, 200.0, -520.0}));
  EXPECT_THAT(numbers_in(cases, "largest pressure, change"),
              Pointwise(DoubleNear(1e-9), {20.0, 100.0 * 200.0 / 1010.0, -100.0 * 520.0 / 1020.0}));
  EXPECT_EQ(page.timeline->start, 2u);
  EXPECT_EQ(card_of(page, "largest pressure"), "−520 MPa | −51.0 %, case 3");
  const auto& chart = std::get<ChartView>(figure_of(page, "forces").view);
  EXPECT_TRUE(chart.linked);
  ASSERT_EQ(chart.panels[0].series.size(), 2u);
  EXPECT_EQ(chart.panels[0].series[1].name, "after");
  EXPECT_FALSE(chart.panels[0].series[0].dashed);
  EXPECT_TRUE(chart.panels[0].series[1].dashed);
  EXPECT_DOUBLE_EQ(chart.panels[0].series[1].y[2], 500.0);
  EXPECT_EQ(page.timeline->axes.front().label, "pitch angle");
  EXPECT_EQ(std::get<ContactView>(figure_of(page, "patches-view").view).sets, (std::vector<int>{0, 1}));
  EXPECT_EQ(page.sets[1].name, "after");
  // All quantities, each where it differs most, in the units of pages.
  const Table& all = table_of(page, "quantities");
  bool found = false;
  for (const Table::Row& row : all.rows)
    if (std::get<std::string>(row.cells[0]) == "pmax_MPa") {
      found = true;
      EXPECT_EQ(std::get<Number>(row.cells[2]).value, 3.0);
      EXPECT_EQ(std::get<std::string>(row.cells[4]), "MPa");
      EXPECT_NEAR(std::get<Number>(row.cells[7]).value, -520.0, 1e-9);
    }
  EXPECT_TRUE(found);
}

TEST(RunOverlayPage, WhatOnlyOneHasIsNamedAndShown) {
  io::RunResult b = run_of(400);
  b.cases[6].number = 700;
  const Page page = page_of(run_of(1), std::move(b));
  EXPECT_THAT(banners_of(page),
              HasSubstr("warning: before has not got 399 cases: 2 to 6, 8 to 400, 700. There is nothing"));
  EXPECT_EQ(card_of(page, "Cases in all"), "1 of 400 | ");
  EXPECT_EQ(page.timeline->count(), 400u);
  EXPECT_EQ(page.sets[0].frames[5].result->message, "There is none of that number in this result.");
  EXPECT_EQ(page.sets[1].frames[399].result->number, 700);
  const Table& cases = table_of(page, "cases");
  ASSERT_EQ(cases.rows.size(), 400u);
  EXPECT_EQ(std::get<std::string>(cases.rows[5].cells[1]), "none / ok");
  EXPECT_TRUE(std::isnan(numbers_in(cases, "largest pressure, difference")[5]));
  EXPECT_LT(to_html(page).size(), 8'000'000u);
}

TEST(RunOverlayPage, WhatIsNotOkHeadsThePage) {
  io::RunResult a = run_of(3), b = run_of(3);
  a.doubts = {"wheel profile w.csv: flange_side: on the wrong side"};
  b.complete = false;
  b.cases_total = 5;
  b.cases[1].status = Status::not_converged;
  b.cases[2].patches.push_back(even_patch(2, 1e8));
  const std::string banners = banners_of(page_of(std::move(a), std::move(b)));
  EXPECT_THAT(banners, HasSubstr("warning: before: Warning about a profile: wheel profile w.csv"));
  EXPECT_THAT(banners, HasSubstr("failed: after: Interrupted. 3 of 5 cases were finished"));
  EXPECT_THAT(banners, HasSubstr("warning: after: 1 case did not converge."));
  EXPECT_THAT(banners, HasSubstr("ended differently in before and after: case 2: ok and not_converged."));
  EXPECT_THAT(banners, HasSubstr("Numbers of patches that differ in before and after: case 3: 1 and 2."));
}

TEST(RunOverlayPage, EqualOnesSaySo) {
  const Page page = page_of(run_of(2), run_of(2));
  EXPECT_THAT(banners_of(page), HasSubstr("note: No difference: all numbers of cases and patches are the same."));
  EXPECT_EQ(card_of(page, "largest pressure"), "no card largest pressure");
  EXPECT_THAT(figure_of(page, "patches-view").note, HasSubstr("Grids lie on each other: differences"));
}

TEST(RunOverlayPage, ChartsAreDrawnOverWhatIsCommonOnly) {
  io::RunResult b = run_of(3);
  b.cases[1].pitch = 0.5;
  const Page page = page_of(run_of(3), std::move(b));
  ASSERT_EQ(page.timeline->axes.size(), 1u);
  EXPECT_EQ(page.timeline->axes[0].label, "case");
  EXPECT_THAT(banners_of(page), HasSubstr("warning: Cases of the same number with another pitch angle: 2."));
  EXPECT_THAT(texts_of_row(table_of(page, "differs"), "pitch angle of cases of the same number"),
              HasSubstr("0 to 1.14592 ° | 0 to 28.6479 °"));
}

TEST(RunOverlayPage, SettingsThatDifferAreListedAndVersionsNoted) {
  io::RunResult a = run_of(1), b = run_of(1);
  a.settings = {"wheelset.y_mm=3", "case.side=left"};
  b.settings = {"wheelset.y_mm=4", "backend=mesh", "case.side=left"};
  b.version = "0.2.0";
  b.input_sha256 = std::string(64, 'b');
  a.input_sha256 = std::string(64, 'a');
  a.geometry_sha256 = {{"w.prr", std::string(64, 'c')}};
  io::SurfaceUse use;
  use.body = "wheel";
  use.backend = "mesh";
  b.surfaces = {use};
  b.cases[0].patches[0] = even_patch(8, 1e9, 2.5e-4);
  const Page page = page_of(std::move(a), std::move(b));
  const Table& table = table_of(page, "differs");
  EXPECT_EQ(texts_of_row(table, "set: wheelset.y_mm"), "3 | 4");
  EXPECT_EQ(texts_of_row(table, "set: backend"), "as in the input | mesh");
  EXPECT_EQ(texts_of_row(table, "set: case.side"), "no row set: case.side");
  EXPECT_EQ(texts_of_row(table, "input"), "no row input");
  EXPECT_EQ(texts_of_row(table, "version"), "0.1.0 | 0.2.0");
  EXPECT_EQ(texts_of_row(table, "SHA-256 of the input"), "aaaaaaaaaaaa… | bbbbbbbbbbbb…");
  EXPECT_EQ(texts_of_row(table, "SHA-256 of w.prr"), "cccccccccccc… | –");
  EXPECT_EQ(texts_of_row(table, "surface of the wheel"), "– | mesh");
  EXPECT_THAT(banners_of(page), HasSubstr("note: Versions differ: 0.1.0 and 0.2.0."));
  EXPECT_THAT(figure_of(page, "patches-view").note, HasSubstr("in 0 of 1 comparisons"));
  EXPECT_THAT(fact_of(page, "SHA-256 of the input"), std::string(64, 'b'));
}

TEST(RunOverlayPage, InputsAreCompared) {
  io::RunResult a = run_of(1), b = run_of(1);
  a.inputs = {{"friction: coefficient", "0.3"}, {"wheel flats 0: depth", "1 mm"}, {"track: gauge", "1435 mm"}};
  b.inputs = {{"friction: coefficient", "0.4"}, {"track: gauge", "1435 mm"}};
  const Page page = page_of(std::move(a), std::move(b));
  const Table& table = table_of(page, "differs");
  EXPECT_EQ(texts_of_row(table, "friction: coefficient"), "0.3 | 0.4");
  EXPECT_EQ(texts_of_row(table, "wheel flats 0: depth"), "1 mm | not given");
  EXPECT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(fact_of(page, "track: gauge"), "1435 mm");
}

TEST(RunOverlayPage, ShapesAreKeptApart) {
  const auto with_rail = [](double height) {
    io::RunResult run = run_of(1);
    io::SampledSurface rail;
    rail.body = "rail";
    rail.name = "rail_1";
    rail.nu = rail.nv = 2;
    rail.u = {0.0, 1.0};
    rail.x = {0, 0, 1, 1}, rail.y = {0, 1, 0, 1}, rail.z.assign(4, height);
    run.sampled = {rail};
    run.cases[0].rail_surface = "rail_1";
    run.cases[0].bodies.emplace();
    return run;
  };
  const Page page = page_of(with_rail(0.1), with_rail(0.2));
  ASSERT_EQ(page.surfaces.size(), 2u);
  EXPECT_NO_THROW(io::check_surfaces(page.surfaces));
  for (std::size_t k = 0; k < 2; ++k) {
    const int at = io::surface_index(page.surfaces, page.sets[k].frames[0].result->rail_surface);
    ASSERT_GE(at, 0);
    EXPECT_DOUBLE_EQ(page.surfaces[static_cast<std::size_t>(at)].z[0], k == 0 ? 0.1 : 0.2);
  }
  EXPECT_EQ(std::get<SectionView>(figure_of(page, "section").view).over, std::vector<int>{1});
  EXPECT_THAT(page_data(page, 1'000'000), HasSubstr("\"over\":[1]"));
}

TEST(RunOverlayPage, OthersAreComparedWithTheFirst) {
  const Page page = run_overlay_page({{"a", run_of(2)}, {"b", run_of(2, 1.1e9)}, {"c", run_of(2, 0.9e9)}});
  const Table& cases = table_of(page, "cases");
  EXPECT_THAT(numbers_in(cases, "largest pressure, difference of b"), Pointwise(DoubleNear(1e-9), {100.0, 100.0}));
  EXPECT_THAT(numbers_in(cases, "largest pressure, difference of c"), Pointwise(DoubleNear(1e-9), {-100.0, -100.0}));
  EXPECT_NO_THROW(table_of(page, "quantities"));
  EXPECT_NO_THROW(table_of(page, "quantities-2"));
  EXPECT_EQ(page.title, "a, b and c");
  EXPECT_THROW(run_overlay_page({}), Error);
}

TEST(RunOverlayPage, SmallForcesInNewtonAndLargeOnesInKilonewtonMeet) {
  io::RunResult a = run_of(1), b = run_of(1);
  a.cases[0].force_tr = {100.0, 0.0, 500.0};
  b.cases[0].force_tr = {100.0, 0.0, 5000.0};
  const auto force = [](const Page& page) {
    return numbers_in(table_of(page, "cases"), "vertical F_z, difference")[0];
  };
  EXPECT_NEAR(force(page_of(a, b)), 4.5, 1e-12);
  EXPECT_NEAR(force(page_of(b, a)), -4.5, 1e-12);
}

// ------------------------------------------------------------------------------------------------------- simulations

/// A force that swings about 50 kN with this amplitude, over a whole number of periods.
io::SimulationResult swinging(double amplitude, std::size_t rows, double speed) {
  io::SimulationResult result;
  result.title = "swinging";
  result.columns = {{"t_s", "s", "time"}, {"x_m", "m", "distance"}, {"Q_N", "N", "vertical force on the rail"}};
  for (std::size_t k = 0; k < rows; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(rows - 1);
    for (const double value : {t, speed * t, 5e4 + amplitude * std::sin(4.0 * std::numbers::pi * t)})
      result.values.push_back(value);
  }
  result.summary = {{"q_max_N", 5e4 + amplitude, "N", "largest vertical force"}};
  return result;
}

TEST(SimulationOverlayPage, HistoriesAndMeasuresOfBoth) {
  io::SimulationResult b = swinging(2e4, 3001, 45.0);
  b.columns.push_back({"gap_m", "m", "gap"});
  b.columns.push_back({"spin_rad_s", "rad/s", "a speed"});
  std::vector<double> wider;
  for (std::size_t row = 0; row < 3001; ++row) {
    wider.insert(wider.end(), b.values.begin() + static_cast<std::ptrdiff_t>(3 * row),
                 b.values.begin() + static_cast<std::ptrdiff_t>(3 * row + 3));
    wider.insert(wider.end(), {1e-3, 2.0});
  }
  b.values = std::move(wider);
  const Page page = simulation_overlay_page({{"before", swinging(1e4, 2001, 40.0)}, {"after", std::move(b)}});
  const auto& chart = std::get<ChartView>(figure_of(page, "over-distance").view);
  ASSERT_EQ(chart.panels[0].series.size(), 2u);
  EXPECT_DOUBLE_EQ(chart.panels[0].series[0].x.back(), 40.0);
  EXPECT_DOUBLE_EQ(chart.panels[0].series[1].x.back(), 45.0);
  EXPECT_EQ(chart.panels[0].unit, "kN");
  EXPECT_EQ(chart.x->unit, "m");
  EXPECT_DOUBLE_EQ(std::get<ChartView>(figure_of(page, "over-time").view).panels[0].series[1].x.back(), 1.0);
  const Table& columns = table_of(page, "columns");
  EXPECT_THAT(texts_in(columns, "quantity"),
              ElementsAre("Q, largest", "Q, least", "Q, mean", "Q, rms", "gap, largest", "gap, least", "gap, mean",
                          "gap, rms", "spin, largest", "spin, rms"));
  // Of a sine about a mean m: rms² = m² + a²/2.
  const auto rms = [](double a) { return std::sqrt(2500.0 + a * a / 2.0); };
  const std::vector<double> before = numbers_in(columns, "before"), difference = numbers_in(columns, "difference");
  EXPECT_NEAR(before[0], 60.0, 1e-4);
  EXPECT_NEAR(before[2], 50.0, 1e-9);
  EXPECT_NEAR(before[3], rms(10.0), 1e-4);
  EXPECT_NEAR(difference[0], 10.0, 1e-4);
  EXPECT_NEAR(difference[1], -10.0, 1e-4);
  EXPECT_NEAR(difference[3], rms(20.0) - rms(10.0), 1e-4);
  EXPECT_NEAR(numbers_in(columns, "change")[0], 100.0 / 6.0, 1e-3);
  EXPECT_TRUE(std::isnan(before[4]));
  EXPECT_NEAR(numbers_in(columns, "after")[4], 1.0, 1e-12);
  EXPECT_NEAR(numbers_in(columns, "after")[9], 2.0, 1e-12);
  EXPECT_EQ(texts_in(columns, "unit")[9], "rad/s");
  EXPECT_THAT(banners_of(page), HasSubstr("warning: before has not got 2 columns: gap_m, spin_rad_s."));
  EXPECT_EQ(card_of(page, "Largest vertical force"), "+10 kN | +16.7 %, 60 to 70");
  EXPECT_THAT(numbers_in(table_of(page, "summary"), "difference"), ElementsAre(DoubleNear(10.0, 1e-9)));
  EXPECT_EQ(texts_of_row(table_of(page, "differs"), "distance"), "40 m | 45 m");
}

TEST(SimulationOverlayPage, SnapshotsLieBesideEachOther) {
  const auto with_snapshots = [](int count, double delay) {
    io::SimulationResult result = swinging(1e4, 50, 40.0);
    result.snapshots = run_of(count);
    for (int k = 0; k < count; ++k) result.snapshot_times.push_back(0.25 * k + delay);
    result.snapshot_scenes.resize(static_cast<std::size_t>(count));
    return result;
  };
  const Page page = simulation_overlay_page({{"before", with_snapshots(3, 0.125)}, {"after", with_snapshots(2, 0.0)}});
  ASSERT_TRUE(page.timeline);
  EXPECT_THAT(page.timeline->names, ElementsAre("snapshot 1", "snapshot 2", "snapshot 3"));
  const Table& table = table_of(page, "snapshots");
  EXPECT_THAT(numbers_in(table, "t, before"), ElementsAre(0.125, 0.375, 0.625));
  EXPECT_DOUBLE_EQ(numbers_in(table, "t, difference")[1], -0.125);
  EXPECT_TRUE(std::isnan(numbers_in(table, "t, after")[2]));
  EXPECT_NEAR(numbers_in(table, "pitch angle, after")[1], 0.01 * 180.0 / std::numbers::pi, 1e-12);
  EXPECT_EQ(std::get<ContactView>(figure_of(page, "patches-view").view).sets, (std::vector<int>{0, 1}));
  EXPECT_EQ(page.sets[1].frames[2].result->message, "There is none of that number in this result.");
  EXPECT_DOUBLE_EQ(page.sets[1].frames[1].result->patches[0].pmax, 1.01e9);
  EXPECT_FALSE(
      has_figure(simulation_overlay_page({{"a", swinging(1, 9, 1)}, {"b", swinging(1, 9, 1)}}), "patches-view"));
}

TEST(SimulationOverlayPage, FailedAndEqualOnesSaySo) {
  io::SimulationResult failed = swinging(1e4, 20, 40.0);
  failed.status = "failed";
  failed.message = "no balance";
  const std::string banners =
      banners_of(simulation_overlay_page({{"before", swinging(1e4, 20, 40.0)}, {"after", failed}}));
  EXPECT_THAT(banners, HasSubstr("failed: after: Failed. no balance"));
  EXPECT_THAT(banners, HasSubstr("note: No difference:"));
  const Page long_one = simulation_overlay_page(
      {{"a", swinging(1e4, 200'000, 40.0)}, {"b", swinging(2e4, 200'000, 40.0)}, {"c", swinging(0.0, 10, 1.0)}});
  EXPECT_LT(to_html(long_one).size(), 8'000'000u);
  io::SimulationResult empty;
  empty.status = "failed";
  EXPECT_NO_THROW(simulation_overlay_page({{"a", empty}, {"b", swinging(1e4, 20, 40.0)}}));
}

}  // namespace
}  // namespace treadmark::app::pages
