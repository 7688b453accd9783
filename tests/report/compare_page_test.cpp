// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/compare/pages/compare_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/pictures/comparison_pictures.hpp"
#include "treadmark/report/write_page.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/report/page_reader.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using namespace treadmark::testing;
using Json = nlohmann::json;

io::ComparisonRow made_up_row(int number, double error) {
  io::ComparisonRow row;
  row.case_number = number;
  row.patches = 1;
  row.pmax = 1e9 * (1.0 + error);
  row.fn = 80e3;
  row.search_s = 2e-3;
  row.distance_s = 1e-3;
  row.comparable = true;
  row.pmax_error = error;
  row.position_error = 1e-4;
  return row;
}

io::ComparisonCandidate made_up(const std::string& name, double resolution, double error) {
  io::ComparisonCandidate c;
  c.name = name;
  c.resolution = resolution;
  c.wheel = {name, resolution, 0.5, 1000000, {}, ""};
  c.rail = {"analytic", 0.0, 0.25, 500000, {}, ""};
  c.wheel.difference.points = 100;
  c.wheel.difference.height_max = 3e-6;
  c.rows = {made_up_row(1, error), made_up_row(2, 0.5 * error)};
  return c;
}

/// A truth and two candidates with two cases each.
io::Comparison made_up_comparison() {
  io::Comparison out;
  out.version = "1.2.3";
  out.git = "abc";
  out.threads = 2;
  out.seconds = 12.0;
  out.input_file = "some/where/flat.toml";
  out.input_sha256 = std::string(64, 'a');
  out.truth = "analytic";
  out.candidates = {made_up("analytic", 0.0, 0.0), made_up("mesh", 1e-3, -0.08), made_up("mesh", 0.5e-3, 0.02)};
  return out;
}

class ComparePage : public ::testing::Test {
 protected:
  Page page_of(const io::Comparison& comparison) {
    io::write_json(folder_.path() / "compare.json", comparison);
    return compare_page(folder_.path());
  }
  Json json() const {
    std::ifstream file(folder_.path() / "compare.json");
    return Json::parse(file);
  }
  TemporaryFolder folder_;
};

TEST_F(ComparePage, ShowsWhatTheFilesOfAComparisonHold) {
  const auto input = folder_.write("in/flat.toml", treadmark::testing::flat_wheel_case());
  CompareSettings settings;
  settings.backends = {"spline", "mesh-flat"};
  settings.resolutions = {2e-3};
  const io::Comparison comparison = compare_cases(io::read_any_case(input.string(), {}), settings);
  write_file(folder_.path() / "pressures.svg", pictures::pressures_svg(comparison));
  io::write_comparison_fields(folder_.path() / "fields.h5", comparison);
  const Page page = page_of(comparison);
  EXPECT_EQ(page.kind, "compare");
  EXPECT_EQ(page.title, "flat");
  EXPECT_EQ(banners_of(page), "");
  EXPECT_EQ(fact_of(page, "Reference"), "analytic");
  EXPECT_EQ(fact_of(page, "Version"), comparison.version + " (" + comparison.git + ")");

  const Json document = json();
  const Table& rows = table_of(page, "rows");
  ASSERT_EQ(rows.rows.size(), document["rows"].size());
  std::size_t line = 0;
  for (const int number : {1, 2})
    for (const Json& row : document["rows"]) {
      if (row["case"] != number) continue;
      SCOPED_TRACE(row.dump());
      EXPECT_EQ(rows.rows[line].step, number - 1);
      EXPECT_EQ(numbers_in(rows, "p_max")[line], row["pmax_MPa"].get<double>());
      EXPECT_NEAR(1e6 * numbers_in(rows, "memory")[line], row["memory_bytes"].get<double>(), 1e-3);
      EXPECT_NEAR(1e3 * numbers_in(rows, "F_n")[line], row["fn_N"].get<double>(), 1e-6);
      EXPECT_NEAR(1e-3 * numbers_in(rows, "search")[line], row["search_s"].get<double>(), 1e-9);
      EXPECT_EQ(texts_in(rows, "status")[line], row["status"].get<std::string>());
      if (row.contains("force_error_percent")) {
        EXPECT_EQ(numbers_in(rows, "error of force")[line], row["force_error_percent"].get<double>());
      }
      ++line;
    }
  const Table& candidates = table_of(page, "candidates");
  ASSERT_EQ(candidates.rows.size(), 3u);
  EXPECT_EQ(numbers_in(candidates, "largest deviation")[2],
            document["candidates"][2]["wheel"]["height_max_um"].get<double>());

  ASSERT_TRUE(page.timeline.has_value());
  EXPECT_EQ(page.timeline->count(), 2u);
  EXPECT_EQ(page.timeline->axes.front().unit, "°");
  EXPECT_THAT(page.timeline->frames, ElementsAre(0, 1));
  ASSERT_EQ(page.sets.size(), 3u);
  EXPECT_EQ(page.sets[0].name, "analytic (reference)");
  EXPECT_EQ(page.sets[2].name, "mesh-flat 2 mm");
  EXPECT_EQ(page.sets[2].frames[1].result->patches.front().pmax,
            comparison.candidates[2].results[1].patches.front().pmax);
  EXPECT_THAT(std::get<ContactView>(figure_of(page, "contact-view").view).sets, ElementsAre(0, 1, 2));
  EXPECT_FALSE(has_figure(page, "pressures"));

  const std::string html = to_html(page, {.live = false});
  const Page at_once = compare_page(std::make_shared<io::Comparison>(comparison), io::to_json(comparison));
  EXPECT_EQ(to_html(at_once, {.live = false}), html);
  EXPECT_EQ(page_data(at_once, 1 << 20), page_data(page, 1 << 20));
  EXPECT_THAT(html, HasSubstr("id=\"table-rows\""));
  EXPECT_THAT(html, HasSubstr("mesh-flat 2 mm"));
}

TEST_F(ComparePage, ErrorsOfRepresentationsAreThoseOfTheRows) {
  const Page page = page_of(made_up_comparison());
  const Table& candidates = table_of(page, "candidates");
  EXPECT_THAT(texts_in(candidates, "representation"), ElementsAre("analytic (reference)", "mesh", "mesh"));
  EXPECT_NEAR(numbers_in(candidates, "error of p_max")[1], 8.0, 1e-9);  // the larger of 8 and 4 %, in size
  EXPECT_NEAR(numbers_in(candidates, "error of position")[2], 0.1, 1e-9);
  EXPECT_NEAR(numbers_in(candidates, "search")[1], 2.0, 1e-9);
  EXPECT_NEAR(numbers_in(candidates, "build")[1], 0.75, 1e-9);
  EXPECT_NEAR(numbers_in(candidates, "memory")[1], 1.5, 1e-9);
  EXPECT_EQ(card_of(page, "Least error of pressure"), "2 % | mesh 0.5 mm");
  EXPECT_EQ(card_of(page, "Greatest error of pressure"), "8 % | mesh 1 mm");
  EXPECT_EQ(card_of(page, "Cases"), "2 | ");

  const auto& chart = std::get<ChartView>(figure_of(page, "accuracy-chart").view);
  ASSERT_EQ(chart.panels.front().series.size(), 1u);
  const Series& mesh = chart.panels.front().series.front();
  EXPECT_EQ(mesh.name, "mesh");
  EXPECT_THAT(mesh.x, ElementsAre(1.0, 0.5));
  EXPECT_NEAR(mesh.y[0], 8.0, 1e-9);
  EXPECT_THAT(mesh.texts[1], AllOf(StartsWith("mesh 0.5 mm:"), HasSubstr("1.50 MB")));
  const auto& cases = std::get<ChartView>(figure_of(page, "cases-chart").view);
  EXPECT_TRUE(cases.linked);
  EXPECT_NEAR(cases.panels[0].series[1].y[0], 920.0, 1e-9);
  EXPECT_NEAR(cases.panels[1].series[0].y[1], -4.0, 1e-9);
}

TEST_F(ComparePage, AnErrorOfZeroIsShownAtTheLeast) {
  io::Comparison comparison = made_up_comparison();
  for (io::ComparisonRow& row : comparison.candidates[2].rows) row.pmax_error = 0.0;
  const Page page = page_of(comparison);
  const auto& chart = std::get<ChartView>(figure_of(page, "accuracy-chart").view);
  EXPECT_EQ(chart.panels.front().series.front().y[1], 1e-3);
  EXPECT_THAT(chart.panels.front().series.front().texts[1], HasSubstr("error of the largest pressure 0 %"));
  EXPECT_EQ(numbers_in(table_of(page, "candidates"), "error of p_max")[2], 0.0);
}

TEST_F(ComparePage, JudgesByTheMeanWhereTheLargestPressureHasNoLimit) {
  io::Comparison comparison = made_up_comparison();
  double mean = 0.04;
  for (std::size_t i = 1; i < 3; ++i, mean *= 0.5)
    for (io::ComparisonRow& row : comparison.candidates[i].rows)
      row.pmax_error = std::nan(""), row.mean_pressure_error = mean;
  const Page page = page_of(comparison);
  EXPECT_THAT(banners_of(page), HasSubstr("note: The largest pressure has no limit (edge_pressure): case 1, 2."));
  EXPECT_EQ(card_of(page, "Least error of mean pressure"), "2 % | mesh 0.5 mm");
  const auto& chart = std::get<ChartView>(figure_of(page, "accuracy-chart").view);
  EXPECT_EQ(chart.panels.front().label, "error of the mean pressure");
  EXPECT_NEAR(chart.panels.front().series.front().y[0], 4.0, 1e-9);
  EXPECT_THAT(texts_in(table_of(page, "candidates"), "notes"), ElementsAre("", "", ""));
}

TEST_F(ComparePage, SaysWhatFailedAndWhatIsMissing) {
  io::Comparison comparison = made_up_comparison();
  comparison.complete = false;
  comparison.candidates[1].failure = "this mesh <b>cannot</b> be built";
  comparison.candidates[1].rows.clear();
  comparison.candidates[2].rows[0].status = Status::not_converged;
  comparison.candidates[2].rows.pop_back();
  const Page page = page_of(comparison);
  const std::string banners = banners_of(page);
  EXPECT_THAT(banners, StartsWith("failed: Interrupted. 3 representations were finished"));
  EXPECT_THAT(banners, HasSubstr("failed: mesh 1 mm failed. this mesh <b>cannot</b> be built\n"));
  EXPECT_THAT(banners, HasSubstr("failed: Cases that are missing: mesh 0.5 mm: case 2.\n"));
  EXPECT_THAT(banners, HasSubstr("warning: Cases that did not converge; judge them with care: mesh 0.5 mm: case 1.\n"));
  EXPECT_THAT(banners, HasSubstr("fields.h5"));
  EXPECT_EQ(card_of(page, "Representations"), "3 | 1 failed");
  EXPECT_THAT(texts_in(table_of(page, "candidates"), "notes")[1], HasSubstr("failed: this mesh"));
  const std::string html = to_html(page, {.live = false});
  EXPECT_THAT(html, HasSubstr("this mesh &lt;b&gt;cannot&lt;/b&gt; be built"));
  EXPECT_THAT(html, Not(HasSubstr("<b>cannot")));
}

TEST_F(ComparePage, WithoutAnythingItStillSaysSo) {
  io::Comparison comparison = made_up_comparison();
  comparison.complete = false;
  comparison.candidates.clear();
  const Page page = page_of(comparison);
  EXPECT_THAT(banners_of(page), HasSubstr("Interrupted."));
  EXPECT_FALSE(page.timeline.has_value());
  EXPECT_THAT(to_html(page, {.live = false}), HasSubstr("</html>"));
}

TEST_F(ComparePage, HasThePictureWhereFieldsAreMissing) {
  folder_.write("pressures.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
  const Page page = page_of(made_up_comparison());
  EXPECT_TRUE(has_figure(page, "pressures"));
  EXPECT_FALSE(has_figure(page, "contact-view"));
  EXPECT_THAT(banners_of(page), AllOf(HasSubstr("fields.h5 (contact fields)"), Not(HasSubstr("pressures.svg"))));
  EXPECT_THAT(section_ids(page), ElementsAre("overview", "accuracy", "contact", "tables", "origin"));
}

TEST_F(ComparePage, RefusesFilesThatDoNotFit) {
  EXPECT_THAT(error_of([&] { compare_page(folder_.path()); }),
              AllOf(StartsWith("input data: "), HasSubstr("compare.json' does not exist")));
  io::Comparison other = made_up_comparison();
  other.candidates.pop_back();
  io::write_comparison_fields(folder_.path() / "fields.h5", other);
  EXPECT_THAT(error_of([&] { page_of(made_up_comparison()); }),
              HasSubstr("fields.h5: the fields do not belong to the comparison"));
  std::filesystem::remove(folder_.path() / "fields.h5");
  page_of(made_up_comparison());
  const Json whole = json();
  Json document = whole;
  document["rows"][2].erase("status");
  folder_.write("compare.json", document.dump());
  EXPECT_THAT(error_of([&] { compare_page(folder_.path()); }), HasSubstr("compare.json: rows[2].status is missing"));
  document = whole;
  document["rows"][2]["backend"] = "clay";
  folder_.write("compare.json", document.dump());
  EXPECT_THAT(error_of([&] { compare_page(folder_.path()); }), HasSubstr("rows[2] belongs to none of the candidates"));
}

}  // namespace
}  // namespace treadmark::app::pages
