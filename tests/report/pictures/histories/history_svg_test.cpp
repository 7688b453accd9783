// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/histories/history_svg.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/tests/io/histories/sample_history.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

std::vector<pictures::Pixel> path_points(const std::string& path) {
  std::vector<pictures::Pixel> out;
  const std::regex corner("[ML](-?[0-9.]+) (-?[0-9.]+)");
  for (std::sregex_iterator it(path.begin(), path.end(), corner), end; it != end; ++it)
    out.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
  return out;
}

TEST(ThinCurve, EveryColumnKeepsFirstLowestHighestAndLast) {
  std::vector<pictures::Pixel> line;
  for (int i = 0; i < 20000; ++i) {
    const double t = i / 20000.0;
    line.push_back({40.0 * t, 100.0 + 50.0 * std::sin(900.0 * t) * std::cos(31.0 * t) + (i == 7777 ? 300.0 : 0.0)});
  }
  const auto thin = pictures::thin_curve(line);
  EXPECT_LE(thin.size(), 4u * 40u);
  EXPECT_TRUE(std::is_sorted(thin.begin(), thin.end(), [](const auto& a, const auto& b) { return a[0] < b[0]; }));
  for (int column = 0; column < 40; ++column) {
    const auto of_column = [&](const std::vector<pictures::Pixel>& from) {
      std::vector<pictures::Pixel> out;
      for (const pictures::Pixel& one : from)
        if (std::floor(one[0]) == column) out.push_back(one);
      return out;
    };
    const auto all = of_column(line), kept = of_column(thin);
    ASSERT_FALSE(kept.empty());
    EXPECT_EQ(kept.front(), all.front());
    EXPECT_EQ(kept.back(), all.back());
    const auto by_y = [](const auto& a, const auto& b) { return a[1] < b[1]; };
    EXPECT_EQ((*std::max_element(kept.begin(), kept.end(), by_y))[1],
              (*std::max_element(all.begin(), all.end(), by_y))[1]);
    EXPECT_EQ((*std::min_element(kept.begin(), kept.end(), by_y))[1],
              (*std::min_element(all.begin(), all.end(), by_y))[1]);
  }
}

TEST(ThinCurve, LeavesFewPointsAsTheyAre) {
  const std::vector<pictures::Pixel> line{{0.5, 1.0}, {3.5, 2.0}, {3.6, 2.0}, {9.0, -0.001}};
  EXPECT_EQ(pictures::thin_curve(line), line);
  EXPECT_EQ(pictures::curve_path(line), "M0.5 1L3.5 2L3.6 2L9 0");
  EXPECT_TRUE(pictures::thin_curve({}).empty());
}

TEST(CutCurve, EndsLieOnTheStraightLines) {
  const pictures::Curve line{{0, 0}, {1, 10}, {2, 30}, {3, 0}};
  EXPECT_EQ(pictures::cut_curve(line, {0.5, 2.5}), (pictures::Curve{{0.5, 5}, {1, 10}, {2, 30}, {2.5, 15}}));
  EXPECT_EQ(pictures::cut_curve(line, {1.25, 1.75}), (pictures::Curve{{1.25, 15}, {1.75, 25}}));  // within one step
  EXPECT_EQ(pictures::cut_curve(line, {1.0, 2.0}), (pictures::Curve{{1, 10}, {2, 30}}));
  EXPECT_EQ(pictures::cut_curve(line, {}), line);
  EXPECT_TRUE(pictures::cut_curve(line, {5.0, 6.0}).empty());
}

TEST(CutCurve, PartsStayApart) {
  const pictures::Curve back{{0, 0}, {2, 2}, {0, 4}};  // out of the range and in again
  const pictures::Curve cut = pictures::cut_curve(back, {{}, 1.0});
  ASSERT_EQ(cut.size(), 5u);
  EXPECT_EQ(cut[1], (std::array<double, 2>{1, 1}));
  EXPECT_TRUE(std::isnan(cut[2][1]));
  EXPECT_EQ(cut[3], (std::array<double, 2>{1, 3}));
  const pictures::Curve holes = pictures::cut_curve({{0, 0}, {1, kNaN}, {2, kNaN}, {3, 1}, {4, 2}}, {});
  ASSERT_EQ(holes.size(), 4u);
  EXPECT_TRUE(std::isnan(holes[1][1]));
}

class HistorySvg : public ::testing::Test {
 protected:
  HistorySvg() {
    for (const double speed : {10.0, 40.0}) results_.push_back(testing::sample_simulation(speed));
    chart_.title = "Q & T_y <test>";
    chart_.y = {{"ws1_right.Q_N", "Q [kN]", 1e-3, {62e3}, "static <load>"}, {"ws1_right.Ty_N", "", 1.0}};
    runs_ = {{&results_[0], "V < 20", "slow & \"low\""}, {&results_[1], "V = 40", "fast"}};
  }

  std::vector<io::SimulationResult> results_;
  std::vector<pictures::HistoryRun> runs_;
  pictures::HistoryChart chart_;
};

/// Value of y at a pixel, from two numbers at the axis of the first chart.
double read_y(const testing::XmlElement& chart, double pixel) {
  std::vector<std::array<double, 2>> ticks;
  for (const auto* text : chart.find("text", "text-anchor", "end"))
    if (std::regex_match(text->text, std::regex("-?[0-9.]+")))
      ticks.push_back({std::stod(text->attributes.at("y")) - 4.0, std::stod(text->text)});
  const auto &a = ticks.front(), &b = ticks.back();
  return a[1] + (pixel - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
}

TEST_F(HistorySvg, PanelsCurvesAndLegend) {
  const testing::XmlElement root = testing::read_xml(pictures::history_svg(runs_, chart_));
  const auto panels = root.find("g", "class", "chart");
  ASSERT_EQ(panels.size(), 2u);
  for (const auto* panel : panels) EXPECT_EQ(panel->find("path", "class", "line").size(), 2u);
  EXPECT_EQ(panels[0]->find("path", "class", "level").size(), 1u);
  ASSERT_EQ(root.find("g", "class", "legend").size(), 1u);
  std::vector<std::string> texts;
  for (const auto* text : root.find("text")) texts.push_back(text->text);
  for (const char* words : {"Q &amp; T_y &lt;test&gt;", "V &lt; 20"})  // the reader keeps entities
    EXPECT_EQ(std::count(texts.begin(), texts.end(), words), 1) << words;
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "ws1_right.Ty_N"), 1);
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "t [s]"), 1);
  EXPECT_EQ(std::count(texts.begin(), texts.end(), "dotted: static &lt;load&gt;"), 1);
}

TEST_F(HistorySvg, ThePeakCanBeReadOffThePicture) {
  const testing::XmlElement root = testing::read_xml(pictures::history_svg(runs_, chart_));
  const auto* panel = root.find("g", "class", "chart").at(0);
  for (std::size_t run = 0; run < 2; ++run) {
    const auto points = path_points(panel->find("path", "class", "line").at(run)->attributes.at("d"));
    EXPECT_LE(points.size(), 4u * 641u);
    double top = 1e9;
    for (const pictures::Pixel& point : points) top = std::min(top, point[1]);
    const double wanted = results_[run].summary[0].value * 1e-3;
    EXPECT_NEAR(read_y(*panel, top), wanted, 0.15);  // [kN], the rounding of the ticks' places
  }
}

TEST_F(HistorySvg, NumbersHaveAtMostTwoDecimals) {
  const std::string svg = pictures::history_svg(runs_, chart_);
  EXPECT_FALSE(std::regex_search(svg.substr(svg.find("class=\"line\"")), std::regex("[ML ][0-9]+\\.[0-9]{3}")));
  EXPECT_LT(svg.size(), 200000u);
}

TEST_F(HistorySvg, ARangeOfXFillsTheFrame) {
  chart_.x_range = {0.0401, 0.0702};
  const testing::XmlElement root = testing::read_xml(pictures::history_svg(runs_, chart_));
  const auto* panel = root.find("g", "class", "chart").at(0);
  const auto points = path_points(panel->find("path", "class", "line").at(0)->attributes.at("d"));
  const auto* frame = panel->find("rect", "class", "frame").at(0);
  const double left = std::stod(frame->attributes.at("x")), width = std::stod(frame->attributes.at("width"));
  EXPECT_NEAR(points.front()[0], left, 0.01);
  EXPECT_NEAR(points.back()[0], left + width, 0.01);
}

TEST_F(HistorySvg, SmallPanelsShareTheirScales) {
  chart_.y.resize(1);
  const testing::XmlElement root = testing::read_xml(pictures::history_multiples_svg(runs_, chart_));
  const auto panels = root.find("g", "class", "chart");
  ASSERT_EQ(panels.size(), 2u);
  for (const auto* panel : panels) EXPECT_EQ(panel->find("text", "class", "label halo").size(), 1u);
  double top[2] = {1e9, 1e9};
  for (std::size_t i = 0; i < 2; ++i)
    for (const pictures::Pixel& point : path_points(panels[i]->find("path", "class", "line").at(0)->attributes.at("d")))
      top[i] = std::min(top[i], point[1]);
  // The second panel has no numbers: those of the first hold.
  EXPECT_NEAR(read_y(*panels[0], top[1]), results_[1].summary[0].value * 1e-3, 0.15);
  runs_[0].panel = runs_[1].panel = "";
  const testing::XmlElement one = testing::read_xml(pictures::history_multiples_svg(runs_, chart_));
  EXPECT_EQ(one.find("text", "class", "label halo").size(), 2u);
}

TEST_F(HistorySvg, TheTableHoldsThePlottedNumbers) {
  chart_.x_range = {0.1, {}};
  const auto lines = testing::read_lines(pictures::history_chart_csv(runs_, chart_));
  EXPECT_EQ(lines[0], "run,panel,t_s,ws1_right.Q_N,ws1_right.Ty_N");
  ASSERT_EQ(lines.size(), 1u + 2u * 1001u);
  const io::SimulationResult& result = results_[0];
  EXPECT_EQ(lines[1], fmt::format("V < 20,\"slow & \"\"low\"\"\",{},{},{}", result.values[4000], result.values[4002],
                                  result.values[4003]));
}

TEST_F(HistorySvg, RefusesWhatCannotBeDrawn) {
  pictures::HistoryChart wrong = chart_;
  wrong.y[0].column = "Q";
  try {
    pictures::history_svg(runs_, wrong);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.advice().find("ws1_right.Q_N"), std::string::npos);
  }
  wrong = chart_;
  wrong.y.clear();
  EXPECT_THROW(pictures::history_svg(runs_, wrong), Error);
  EXPECT_THROW(pictures::history_multiples_svg(runs_, chart_), Error);  // two axes
  wrong = chart_;
  wrong.x_range = {2.0, 1.0};
  EXPECT_THROW(pictures::history_svg(runs_, wrong), Error);
  wrong = chart_;
  wrong.y[0].factor = kNaN;
  EXPECT_THROW(pictures::history_svg(runs_, wrong), Error);
  results_[0].values.pop_back();
  EXPECT_THROW(pictures::history_svg(runs_, chart_), Error);
  EXPECT_THROW(pictures::history_chart_csv(runs_, chart_), Error);
}

TEST_F(HistorySvg, NothingToShowIsSaid) {
  EXPECT_NE(pictures::history_svg({}, chart_).find("no values"), std::string::npos);
  chart_.x_range = {5.0, 6.0};
  EXPECT_NE(pictures::history_svg(runs_, chart_).find("no values"), std::string::npos);
}

}  // namespace
}  // namespace treadmark
