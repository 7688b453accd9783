// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/pages/bench_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_surfaces.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/static_figure.hpp"
#include "treadmark/report/write_page.hpp"
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

class BenchPage : public ::testing::Test {
 protected:
  Page page_of(const BenchReport& report) {
    write_bench_folder(folder_.path(), report);
    return bench_page(folder_.path());
  }
  Json json() const {
    std::ifstream file(folder_.path() / "bench.json");
    return Json::parse(file);
  }
  TemporaryFolder folder_;
};

BenchRow made_up_row(const std::string& backend, Body body, double factor) {
  BenchRow row;
  row.backend = backend;
  row.resolution = backend == "analytic" ? 0.0 : 1e-3;
  row.body = body;
  row.agrees = true;
  row.difference = 1e-6;
  row.memory_bytes = 2000000;
  row.points = 3000;
  row.build = 0.02;
  row.height = 50e-9 * factor;
  row.height_tilted = 60e-9 * factor;
  row.normal = 70e-9 * factor;
  row.search_cold = 4e-3 * factor;
  row.search_warm = 4e-4 * factor;
  row.distance = 2e-4 * factor;
  row.patches = 1;
  return row;
}

BenchReport made_up_report() {
  BenchReport report;
  report.version = "1.2.3";
  report.git = "abc";
  report.date = "2026-01-02T03:04:05Z";
  report.machine = "a <fast> processor";
  report.compiler = "GNU 12";
  report.libraries = {{"Embree", "4.1"}, {"Eigen", "3.4"}};
  report.truth = "analytic";
  report.seconds = 65.0;
  report.seconds_per_measure = 0.2;
  for (const Body body : {Body::rail, Body::wheel}) report.rows.push_back(made_up_row("analytic", body, 2.0));
  for (const Body body : {Body::rail, Body::wheel}) report.rows.push_back(made_up_row("mesh", body, 1.0));
  return report;
}

TEST_F(BenchPage, HasTheNumbersOfTheFile) {
  BenchSettings settings;
  settings.backends = {"analytic", "offset"};
  settings.resolutions = {2e-3};
  settings.seconds_per_measure = 1e-3;
  settings.grid = {0.5e-3, 3000};
  const Page page = page_of(bench_surfaces(bench_case(), settings));
  EXPECT_EQ(page.kind, "bench");
  EXPECT_EQ(banners_of(page), "");
  const Json document = json();
  const Table& table = table_of(page, "rows");
  ASSERT_EQ(table.rows.size(), document["rows"].size());
  ASSERT_EQ(table.rows.size(), 4u);
  for (const auto& [column, key] : {std::pair{"differs", "difference_um"},
                                    {"build", "build_s"},
                                    {"points", "points"},
                                    {"height, level", "ns_per_height"},
                                    {"height, tilted", "ns_per_height_tilted"},
                                    {"with slopes", "ns_per_normal"},
                                    {"base of offsets", "base_ns_per_height"},
                                    {"first search", "search_cold_s"},
                                    {"after a small move", "search_warm_s"},
                                    {"distance", "distance_s"},
                                    {"patches", "patches"}}) {
    const std::vector<double> shown = numbers_in(table, column);
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const Json& value = document["rows"][i][key];
      EXPECT_EQ(std::isnan(shown[i]), value.is_null()) << column;
      if (value.is_number()) {
        EXPECT_EQ(shown[i], value.get<double>()) << column;
      }
    }
  }
  EXPECT_NEAR(1e6 * numbers_in(table, "memory")[3], document["rows"][3]["memory_bytes"].get<double>(), 1e-3);
  EXPECT_EQ(fact_of(page, "Machine"), document["machine"].get<std::string>());
  EXPECT_EQ(fact_of(page, "OpenVDB"), document["libraries"]["OpenVDB"].get<std::string>());
  EXPECT_EQ(fact_of(page, "Input"), "the built-in case");
}

TEST_F(BenchPage, ChartsHaveAPlaceForEveryRepresentation) {
  const Page page = page_of(made_up_report());
  const auto& heights = std::get<ChartView>(figure_of(page, "heights").view);
  ASSERT_TRUE(heights.x.has_value());
  EXPECT_THAT(heights.x->labels, ElementsAre("analytic", "mesh 1 mm"));
  EXPECT_THAT(heights.x->values, ElementsAre(0.0, 1.0));
  ASSERT_EQ(heights.panels.size(), 2u);
  ASSERT_EQ(heights.panels[0].series.size(), 3u);  // nothing lies below offsets here
  EXPECT_NEAR(heights.panels[0].series[0].y[0], 100.0, 1e-9);
  EXPECT_NEAR(heights.panels[0].series[0].y[1], 50.0, 1e-9);
  const auto& detection = std::get<ChartView>(figure_of(page, "detection").view);
  EXPECT_NEAR(detection.panels[0].series[0].y[1], 4.0, 1e-9);
  EXPECT_EQ(detection.panels[0].series[0].texts[1], "mesh 1 mm, first search: 4 ms");
  EXPECT_EQ(card_of(page, "Fastest first search"), "4 ms | mesh 1 mm");
  EXPECT_EQ(card_of(page, "Rows that agree"), "4 of 4 | with the surfaces as given and with single heights");
  const std::string html = to_html(page, {.live = false});
  EXPECT_THAT(chart_svg(heights, page, "heights"), AllOf(HasSubstr(">mesh 1 mm</text>"), HasSubstr("rotate(-35")));
  EXPECT_THAT(html, HasSubstr("a &lt;fast&gt; processor"));
  EXPECT_THAT(html, Not(HasSubstr("<fast>")));
}

TEST_F(BenchPage, OfAReportEqualsThatOfItsFile) {
  BenchReport report = made_up_report();
  report.seconds = 65.123456789;
  report.rows[1].search_cold = 1.0 / 3.0;
  report.rows[2].agrees = false;
  report.rows[3].patches = -1;
  const Page at_once = bench_page(report, bench_json(report)), later = page_of(report);
  EXPECT_EQ(to_html(at_once, {.live = false}), to_html(later, {.live = false}));
  EXPECT_EQ(page_data(at_once, 0), page_data(later, 0));
}

TEST_F(BenchPage, SaysWhatDoesNotAgreeAndWhatWasInterrupted) {
  BenchReport report = made_up_report();
  report.complete = false;
  BenchRow& row = report.rows.back();
  row = BenchRow{};
  row.backend = "mesh";
  row.resolution = 1e-3;
  row.body = Body::wheel;
  row.reason = "slopes differ by <1>";
  const Page page = page_of(report);
  EXPECT_THAT(banners_of(page), StartsWith("failed: Interrupted."));
  EXPECT_THAT(banners_of(page), HasSubstr("failed: 1 of 4 rows without figures:"));
  EXPECT_THAT(banners_of(page), HasSubstr("mesh 1 mm, wheel: slopes differ by <1>"));
  EXPECT_THAT(texts_in(table_of(page, "rows"), "agrees"), ElementsAre("yes", "yes", "yes", "no"));
  EXPECT_TRUE(std::isnan(numbers_in(table_of(page, "rows"), "build").back()));
  EXPECT_THAT(to_html(page, {.live = false}), HasSubstr("slopes differ by &lt;1&gt;"));
  report.rows.clear();
  EXPECT_THAT(banners_of(page_of(report)), HasSubstr("No rows."));
}

TEST_F(BenchPage, RefusesBrokenFiles) {
  EXPECT_THAT(error_of([&] { bench_page(folder_.path()); }), HasSubstr("bench.json' does not exist"));
  page_of(made_up_report());
  Json document = json();
  document["rows"][1]["body"] = "axle";
  folder_.write("bench.json", document.dump());
  EXPECT_THAT(error_of([&] { bench_page(folder_.path()); }), HasSubstr("bench.json: rows[1].body is \"axle\""));
  document["rows"][1]["body"] = "rail";
  document["rows"][1].erase("patches");
  folder_.write("bench.json", document.dump());
  EXPECT_THAT(error_of([&] { bench_page(folder_.path()); }), HasSubstr("rows[1].patches is missing"));
  folder_.write("bench.json", document.dump(1).substr(0, 300));
  EXPECT_THAT(error_of([&] { bench_page(folder_.path()); }), HasSubstr("is no JSON, or was cut off"));
}

}  // namespace
}  // namespace treadmark::app::pages
