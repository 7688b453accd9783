// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/pages/import_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/report/page_data.hpp"
#include "treadmark/report/pictures/imports/import_pictures.hpp"
#include "treadmark/report/write_page.hpp"
#include "treadmark/tests/io/imports/sample_report.hpp"
#include "treadmark/tests/report/page_reader.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using namespace treadmark::testing;
using Json = nlohmann::json;

class ImportPage : public ::testing::Test {
 protected:
  Page page_of(const io::ImportReport& report) {
    pictures::write_import_report(folder_.path().string(), report);
    return import_page(folder_.path());
  }
  Json json() const {
    std::ifstream file(folder_.path() / "report.json");
    return Json::parse(file);
  }
  TemporaryFolder folder_;
};

TEST_F(ImportPage, HasTheNumbersOfTheFile) {
  const Page page = page_of(sample_report());
  const Json document = json();
  EXPECT_EQ(page.kind, "import");
  EXPECT_THAT(section_ids(page), ElementsAre("overview", "truth", "surface", "deviation", "points", "placement", "fit",
                                             "outputs", "steps", "settings", "summary"));
  const auto same = [&](const char* table, const char* column, const Json& list, const char* key) {
    const std::vector<double> shown = numbers_in(table_of(page, table), column);
    ASSERT_EQ(shown.size(), list.size()) << table;
    for (std::size_t i = 0; i < shown.size(); ++i)
      EXPECT_EQ(shown[i], list[i][key].get<double>()) << table << ' ' << column;
  };
  same("damage", "depth", document["damage"], "depth_mm");
  same("damage", "angle", document["damage"], "u_deg");
  same("damage", "missing volume", document["damage"], "volume_mm3");
  same("holes", "diameter", document["coverage"]["holes"], "diameter_mm");
  same("outputs", "size", document["outputs"], "bytes");
  same("outputs", "largest distance", document["outputs"], "height_max_um");
  same("levels", "used", document["fit"]["levels"], "used");
  same("passes", "points", document["frame"]["passes"], "points");
  same("inputs", "points", document["inputs"], "points");
  const Table& removed = table_of(page, "removed");
  const std::vector<std::string> reasons = texts_in(removed, "reason");
  ASSERT_EQ(reasons.size(), document["removed"].size());
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    EXPECT_EQ(numbers_in(removed, "points")[i], document["removed"][reasons[i]].get<double>());
    EXPECT_EQ(texts_in(removed, "rule")[i], document["removed_why"][reasons[i]].get<std::string>());
  }
  EXPECT_EQ(reasons.front(), "not finite");
  EXPECT_THAT(numbers_in(table_of(page, "steps"), "time"), ElementsAre(1.5, 2.25, 0.25));
  EXPECT_EQ(card_of(page, "Points used"), "1571000 | of 1600000");
  EXPECT_EQ(card_of(page, "Residual"), "36 µm | rms; largest 190 µm");
  EXPECT_EQ(card_of(page, "Removed"), "1.81 % | 29000 points");
  EXPECT_EQ(fact_of(page, "Nominal radius"), "460 mm");
}

TEST_F(ImportPage, OfAReportEqualsThatOfItsFiles) {
  for (const io::ImportReport& report : {sample_report(), sample_map_report()}) {
    const Page later = page_of(report), at_once = import_page(report, io::import_json(report, false), folder_.path());
    EXPECT_EQ(to_html(at_once, {.live = false}), to_html(later, {.live = false}));
    EXPECT_EQ(page_data(at_once, 1 << 20), page_data(later, 1 << 20));
  }
}

TEST_F(ImportPage, WarningsComeFirstAndMarkupArrivesAsText) {
  const Page page = page_of(sample_report());
  EXPECT_THAT(banners_of(page), StartsWith("warning: Warning. 2.1 % of the band has no points"));
  EXPECT_THAT(banners_of(page),
              HasSubstr("warning: 1 hole stays open. There is no surface there; the widest is 18 mm across.\n"));
  EXPECT_THAT(texts_in(table_of(page, "inputs"), "file"), Contains("wheel <b>& \"second\".xyz"));
  const std::string html = to_html(page, {.live = false});
  EXPECT_THAT(html, AllOf(HasSubstr("wheel &lt;b&gt;&amp; &quot;second&quot;.xyz"), HasSubstr("S1002 &lt;t32.5&gt;")));
  EXPECT_THAT(html, AllOf(Not(HasSubstr("<b>&")), Not(HasSubstr("<t32.5>"))));
}

TEST_F(ImportPage, MapsAreThoseOfTheImport) {
  const io::ImportReport report = sample_report();
  const Page page = page_of(report);
  const auto& fitted = std::get<MapView>(figure_of(page, "fitted-map").view);
  EXPECT_TRUE(fitted.diverging);
  EXPECT_EQ(fitted.unit, "mm");
  ASSERT_EQ(fitted.values.size(), static_cast<std::size_t>(fitted.nx) * static_cast<std::size_t>(fitted.ny));
  EXPECT_NEAR(fitted.nx * fitted.dx, 1e3 * report.fitted.a_max, 1e-6);
  EXPECT_NEAR(fitted.x0, 0.5 * fitted.dx, 1e-9);
  const auto at = [&](double a, double s) {
    const int ix = static_cast<int>((a - fitted.x0) / fitted.dx + 0.5),
              iy = static_cast<int>((s - fitted.y0) / fitted.dy + 0.5);
    return fitted.values[static_cast<std::size_t>(iy * fitted.nx + ix)];
  };
  EXPECT_NEAR(at(1200.0, 60.0), -0.85, 0.03);  // the deepest place of the flat
  EXPECT_NEAR(at(2300.0, 75.0), -0.4, 0.05);   // the pit, 12 mm wide, averaged over some mm
  EXPECT_NEAR(at(700.0, 20.0), 0.025 * std::sin(3.0 * 0.7 / 0.46), 0.002);
  EXPECT_TRUE(std::isnan(at(1900.0, 50.0)));  // the hole
  for (const char* id : {"density-map", "removed-map", "residual-map", "noise-map"})
    EXPECT_TRUE(has_figure(page, id)) << id;
  const auto& noise = std::get<MapView>(figure_of(page, "noise-map").view);
  EXPECT_EQ(noise.nx, 290);  // as fine as it was
  EXPECT_NEAR(noise.values[3], 1e6 * static_cast<double>(report.noise_map.value[3 * 28]), 1e-6);
}

TEST_F(ImportPage, PointsInSpaceAreThoseOfTheSample) {
  const io::ImportReport report = sample_report();
  const Page page = page_of(report);
  const Figure& figure = figure_of(page, "cloud-view");
  const auto& cloud = std::get<CloudView>(figure.view);
  EXPECT_TRUE(cloud.wheel);
  ASSERT_EQ(cloud.x.size(), report.cloud.x.size());
  ASSERT_EQ(cloud.quantities.size(), 2u);
  EXPECT_NEAR(cloud.z[5], 1e3 * static_cast<double>(report.cloud.z[5]), 1e-9);
  const CloudView::Quantity& residual = cloud.quantities.front();
  std::size_t beyond = 0, removed = 0;
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    const double value = residual.values[i];
    if (std::isnan(value))
      ++removed;
    else if (std::fabs(value) > residual.span * (1.0 + 1e-6))
      ++beyond;
  }
  EXPECT_EQ(removed, 100u);
  EXPECT_THAT(figure.note, AllOf(HasSubstr("800 of the 1571000 points used and 100 of the 29000 removed ones"),
                                 HasSubstr("17 removed points lie more than 100 mm from all others")));
  if (beyond > 0) {
    EXPECT_THAT(figure.note, HasSubstr(std::to_string(beyond) + " points of more than"));
  }
}

TEST_F(ImportPage, TheDistributionHasTheCountsAndNumbersOfTheReport) {
  const io::ImportReport report = sample_report();
  const Page page = page_of(report);
  const Figure& figure = figure_of(page, "residuals");
  const auto& panel = std::get<ChartView>(figure.view).panels.front();
  ASSERT_EQ(panel.series.size(), 2u);
  const Series &bars = panel.series[0], &bell = panel.series[1];
  double drawn = 0.0, all = 0.0;  // steps of equal height over each bin
  for (std::size_t i = 1; i + 1 < bars.y.size(); i += 2) drawn += bars.y[i];
  for (const std::size_t count : report.residual_histogram) all += static_cast<double>(count);
  EXPECT_EQ(drawn, all);
  const double bin = bars.x[2] - bars.x[1];
  double area = 0.0;
  for (std::size_t i = 1; i < bell.x.size(); ++i)
    area += 0.5 * (bell.y[i] + bell.y[i - 1]) * (bell.x[i] - bell.x[i - 1]);
  EXPECT_NEAR(area / bin, all + 73.0, 1e-3 * all);  // as many points
  EXPECT_THAT(figure.note, AllOf(HasSubstr("mean 0.100 µm, rms 36 µm"), HasSubstr("95 % of them lie within 71 µm"),
                                 HasSubstr("99 % within 105 µm"), HasSubstr("31 lie below and 42 above")));
  EXPECT_FALSE(has_figure(page, "residual"));  // the picture of the same
}

TEST_F(ImportPage, TheErrorAgainstTheTruthIsThatOfTheFile) {
  const Page page = page_of(sample_report());
  const Json truth = json()["truth"];
  const Table& table = table_of(page, "truth");
  EXPECT_THAT(numbers_in(table, "rms"), ElementsAre(truth["placed"]["rms_um"], truth["shape"]["rms_um"]));
  EXPECT_THAT(numbers_in(table, "99 % within"),
              ElementsAre(truth["placed"]["within_99_um"], truth["shape"]["within_99_um"]));
  EXPECT_EQ(fact_of(page, "Shift that lays it on best"), "(1, -2, 3) µm");
  EXPECT_TRUE(has_figure(page, "truth-map"));
}

TEST_F(ImportPage, HolesAndDamageAreOutlinedAlsoAcrossTheSeam) {
  const Page page = page_of(sample_report());
  const auto& marks = std::get<MapView>(figure_of(page, "fitted-map").view).marks;
  std::vector<std::string> labels;
  for (const auto& mark : marks) labels.push_back(mark.label);
  EXPECT_THAT(labels, ElementsAre("open, 18 mm", "1: 0.850 mm deep", "2: 0.400 mm deep", "3: 0.300 mm high",
                                  "3: 0.300 mm high"));
  const auto range = [](const MapView::Mark& mark, std::size_t axis) {
    double low = mark.points.front()[axis], high = low;
    for (const auto& point : mark.points) low = std::min(low, point[axis]), high = std::max(high, point[axis]);
    return std::pair(low, high);
  };
  const double round = 2e3 * std::numbers::pi * 0.46;
  EXPECT_NEAR(range(marks[0], 0).first, 1900.0 - 9.0, 1e-6);
  EXPECT_NEAR(range(marks[0], 1).second, 50.0 + 9.0, 1e-6);
  EXPECT_NEAR(range(marks[1], 0).second, 1200.0 + 40.0, 1e-6);
  EXPECT_NEAR(range(marks[3], 0).first, round - 14.0, 1e-6);
  EXPECT_NEAR(range(marks[3], 0).second, round, 1e-6);
  EXPECT_NEAR(range(marks[4], 0).first, 0.0, 1e-6);
  EXPECT_NEAR(range(marks[4], 0).second, 6.0, 1e-6);
}

TEST_F(ImportPage, WorksWithTheReportAlone) {
  page_of(sample_report());
  for (const char* file : {"maps.h5", "times.json", "summary.txt", "settings.toml", "before.svg", "removed.svg",
                           "fitted.svg", "residual.svg"})
    std::filesystem::remove(folder_.path() / file);
  const Page page = import_page(folder_.path());
  EXPECT_THAT(
      banners_of(page),
      HasSubstr("note: Files that are not in the folder: maps.h5 (maps over the band), fitted.svg (a picture)"));
  EXPECT_THAT(banners_of(page), AllOf(HasSubstr("times.json"), HasSubstr("summary.txt")));
  EXPECT_THAT(section_ids(page), ElementsAre("overview", "truth", "surface", "deviation", "points", "placement", "fit",
                                             "outputs", "settings"));
  EXPECT_FALSE(has_figure(page, "fitted-map"));
  EXPECT_THAT(to_html(page, {.live = false}), HasSubstr("</html>"));
}

TEST_F(ImportPage, OfARealImportOfAMap) {
  std::ostringstream map;
  map << 'x';
  for (int y = -20; y <= 20; ++y) map << ',' << y;
  for (int x = 0; x <= 80; ++x) {
    map << '\n' << x;
    for (int y = -20; y <= 20; ++y) map << ',' << 0.3 * std::exp(-((x - 40.0) * (x - 40.0) + y * y) / 200.0);
  }
  map << '\n';
  ImportRequest request;
  request.scans = {folder_.write("in/map.csv", map.str())};
  request.outputs = {folder_.path() / "found.slcs"};
  request.settings.scan.body = "rail";
  request.settings.scan.unit = "mm";
  const Page page = page_of(import_scan(request));
  EXPECT_THAT(banners_of(page), HasSubstr("From a map of deviations."));
  EXPECT_THAT(section_ids(page), Not(Contains("placement")));
  EXPECT_EQ(page.title, "Import of map.csv");
  ASSERT_GE(table_of(page, "damage").rows.size(), 1u);
  const double depth = numbers_in(table_of(page, "damage"), "depth").front();
  EXPECT_NEAR(depth, 0.27, 0.04);  // 0.3 mm from the nominal profile; the section of so short a rail takes some of it
  const auto& fitted = std::get<MapView>(figure_of(page, "fitted-map").view);
  EXPECT_EQ(fitted.x.label, "along the track");
  double least = 0.0;
  for (const double value : fitted.values)
    if (std::isfinite(value)) least = std::min(least, value);
  EXPECT_EQ(fitted.unit, "mm");
  EXPECT_NEAR(least, -depth, 0.005);
}

TEST_F(ImportPage, RefusesBrokenFiles) {
  EXPECT_THAT(error_of([&] { import_page(folder_.path()); }),
              AllOf(StartsWith("input data: "), HasSubstr("report.json' does not exist")));
  page_of(sample_report());
  const Json document = json();
  Json broken = document;
  broken["damage"][1].erase("depth_mm");
  folder_.write("report.json", broken.dump());
  EXPECT_THAT(error_of([&] { import_page(folder_.path()); }), HasSubstr("report.json: damage[1].depth_mm is missing"));
  broken = document;
  broken["coverage"]["holes"] = 3;
  folder_.write("report.json", broken.dump());
  EXPECT_THAT(error_of([&] { import_page(folder_.path()); }),
              HasSubstr("coverage.holes is a number where a list is expected"));
  folder_.write("report.json", document.dump());
  folder_.write("maps.h5", "no maps");
  EXPECT_THAT(error_of([&] { import_page(folder_.path()); }), HasSubstr("maps.h5"));
  std::filesystem::remove(folder_.path() / "maps.h5");
  folder_.write("times.json", "{\"steps\": [{\"step\": 1}]}");
  EXPECT_THAT(error_of([&] { import_page(folder_.path()); }),
              HasSubstr("times.json: steps[0].step is a number where a text is expected"));
}

}  // namespace
}  // namespace treadmark::app::pages
