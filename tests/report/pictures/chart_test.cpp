// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>

#include "treadmark/core/constants.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/svg_text.hpp"
#include "treadmark/tests/io/results/xml_reader.hpp"

namespace treadmark {
namespace {

constexpr double kChartRounding = 1e-9;

TEST(ChartAxis, EveryTickLiesWhereItsNumberBelongs) {
  const std::vector<std::vector<double>> data{{0.03, 4.2},   {17.0},    {1e-4, 1e4}, {3.0, 3.1},
                                              {1e-30, 1e30}, {-5.0, 8}, {1e6, 3e6},  {0.0}};
  for (const pictures::AxisScale scale : {pictures::AxisScale::linear, pictures::AxisScale::log})
    for (const auto& values : data) {
      const pictures::ChartAxis axis(scale, values);
      int labelled = 0;
      for (const pictures::AxisTick& tick : axis.ticks()) {
        EXPECT_GE(tick.at, 0.0);
        EXPECT_LE(tick.at, 1.0);
        if (tick.label.empty()) continue;
        ++labelled;
        const double value = std::stod(tick.label);
        const double at = scale == pictures::AxisScale::log
                              ? std::log(value / axis.low()) / std::log(axis.high() / axis.low())
                              : (value - axis.low()) / (axis.high() - axis.low());
        EXPECT_NEAR(tick.at, at, kChartRounding) << tick.label;
      }
      EXPECT_GE(labelled, 2);
      EXPECT_LE(labelled, 12);
      for (const double value : values)
        EXPECT_EQ(axis.place(value).has_value(), scale == pictures::AxisScale::linear || value > 0.0) << value;
    }
}

TEST(ChartAxis, NumbersAreInOrderAndDifferent) {
  for (const double high : {1.2, 3.0, 9.0, 50.0, 4e3, 1e7, 1e40}) {
    const std::vector<double> values{1.0, high};
    for (const pictures::AxisScale scale : {pictures::AxisScale::linear, pictures::AxisScale::log}) {
      double before = -1.0;
      for (const pictures::AxisTick& tick : pictures::ChartAxis(scale, values).ticks()) {
        EXPECT_GT(tick.at, before);
        before = tick.at;
      }
    }
  }
}

TEST(ChartAxis, AFloorHoldsZeroAndSmallValues) {
  const std::vector<double> values{0.0, 1e-9, 5.0};
  const pictures::ChartAxis axis(pictures::AxisScale::log, values, 1e-3);
  EXPECT_EQ(axis.place(0.0), axis.place(1e-3));
  EXPECT_EQ(axis.place(1e-9), axis.place(1e-3));
  EXPECT_TRUE(axis.at_floor(0.0));
  EXPECT_FALSE(axis.at_floor(1e-3));
  EXPECT_FALSE(axis.place(-1.0));
  EXPECT_LT(axis.low(), 1e-3);
  // Ticks below the floor stay where they are.
  std::map<double, int> count;
  for (const pictures::AxisTick& tick : axis.ticks()) EXPECT_EQ(++count[tick.at], 1);
}

TEST(ChartAxis, SurvivesWhatCannotBeShown) {
  const std::vector<std::vector<double>> data{{},          {kNaN},          {kInfinity, -kInfinity},
                                              {0.0, -3.0}, {1e308, 1e-320}, {1e300, 1e-300}};
  for (const pictures::AxisScale scale : {pictures::AxisScale::linear, pictures::AxisScale::log})
    for (const auto& values : data) {
      const pictures::ChartAxis axis(scale, values);
      EXPECT_LT(axis.low(), axis.high());
      EXPECT_TRUE(std::isfinite(axis.low()) && std::isfinite(axis.high()));
      EXPECT_LE(axis.ticks().size(), 100u);
      EXPECT_GE(axis.ticks().size(), 2u);
      EXPECT_FALSE(axis.place(kNaN));
      EXPECT_FALSE(axis.place(kInfinity));
    }
}

TEST(ChartMarker, EveryShapeHasTheAreaOfTheCircle) {
  for (int style = 0; style < 8; ++style) {
    const auto corners = pictures::chart_marker_corners(style, 3.0);
    double area = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
      area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
    EXPECT_NEAR(std::abs(area), 9.0 * M_PI, kChartRounding);
  }
}

TEST(ChartMarker, StylesDifferInColourAndShape) {
  std::map<std::string, int> seen;
  for (int style = 0; style < 56; ++style)
    EXPECT_EQ(++seen[std::string(pictures::chart_colour(style)) + pictures::chart_marker_path(style, 0, 0, 4)], 1)
        << style;
  EXPECT_EQ(pictures::chart_colour(56), pictures::chart_colour(0));
}

TEST(ChartLabels, AvoidEachOtherAndTheMarkers) {
  const pictures::Box box{0, 0, 500, 400};
  std::vector<pictures::LabelPoint> points;
  for (int i = 0; i < 12; ++i)  // a crowd on a diagonal, and points on the frame
    points.push_back({60.0 + 18.0 * i, 200.0 + 9.0 * i, 5.0, "candidate " + std::to_string(i)});
  points.push_back({500, 0, 5, "corner"});
  points.push_back({0, 400, 5, "corner"});
  const double font = 11.0;
  const auto places = pictures::place_labels(points, box, font);
  ASSERT_EQ(places.size(), points.size());
  const auto overlap = [](double a_low, double a_high, double b_low, double b_high) {
    return std::min(a_high, b_high) - std::max(a_low, b_low) > 1e-6;
  };
  int hits = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = places[i][0], y = places[i][1], width = pictures::text_width(points[i].text, font);
    EXPECT_GE(x, -6.0);
    EXPECT_LE(x + width, 506.0);
    for (std::size_t k = 0; k < i; ++k)
      hits += overlap(x, x + width, places[k][0], places[k][0] + pictures::text_width(points[k].text, font)) &&
              overlap(y - font, y, places[k][1] - font, places[k][1]);
  }
  EXPECT_EQ(hits, 0);
}

/// Value at a pixel of an axis, from two of its numbers.
double read_axis(const std::map<double, double>& pixel_of_value, double pixel) {
  const auto [v0, p0] = *pixel_of_value.begin();
  const auto [v1, p1] = *pixel_of_value.rbegin();
  return std::exp(std::log(v0) + (pixel - p0) / (p1 - p0) * std::log(v1 / v0));
}

TEST(ChartDraw, MarkersCanBeReadOffTheAxes) {
  pictures::Chart chart;
  chart.title = "a <title> & more";
  chart.x_scale = chart.y_scale = pictures::AxisScale::log;
  pictures::ChartSeries series;
  series.name = "one";
  const std::vector<std::pair<double, double>> values{{0.25, 0.013}, {0.5, 0.4}, {1.0, kNaN}, {2.0, 33.0}, {4.0, 41.0}};
  for (const auto& [x, y] : values) {
    pictures::ChartPoint point;
    point.x = x;
    point.y = y;
    point.details = "d<";
    series.points.push_back(point);
  }
  series.levels = {3.0, -1.0};
  chart.series = {series};
  const pictures::Box box{70, 40, 300, 200};
  const testing::XmlElement root = testing::read_xml("<svg>" + pictures::draw_chart(chart, box) + "</svg>");

  std::map<double, double> x_axis, y_axis;
  for (const auto* text : root.find("text")) {
    if (!std::regex_match(text->text, std::regex("[0-9.e+-]+"))) continue;
    if (text->attributes.at("text-anchor") == "end")
      y_axis[std::stod(text->text)] = std::stod(text->attributes.at("y")) - 4.0;  // middle of the digits
    else
      x_axis[std::stod(text->text)] = std::stod(text->attributes.at("x"));
  }
  const double kPixel = 0.01;  // relative, of a pixel's tenth in a few decades
  const auto marks = root.find("path", "class", "mark");
  ASSERT_EQ(marks.size(), 4u);  // not the NaN
  std::size_t next = 0;
  for (const auto& [x, y] : values) {
    if (std::isnan(y)) continue;
    std::string path = marks[next++]->attributes.at("d");
    double sum_x = 0.0, sum_y = 0.0;
    int count = 0;
    std::regex corner("[ML]([0-9.]+) ([0-9.]+)");
    for (std::sregex_iterator it(path.begin(), path.end(), corner), end; it != end; ++it, ++count) {
      sum_x += std::stod((*it)[1]);
      sum_y += std::stod((*it)[2]);
    }
    EXPECT_NEAR(read_axis(x_axis, sum_x / count), x, kPixel * x);
    EXPECT_NEAR(read_axis(y_axis, sum_y / count), y, kPixel * y);
  }
  EXPECT_EQ(root.find("path", "class", "level").size(), 1u);
  // The line is broken at the value that cannot be shown.
  const std::string line = root.find("path", "class", "line").at(0)->attributes.at("d");
  EXPECT_EQ(std::count(line.begin(), line.end(), 'M'), 2);
  EXPECT_EQ(std::count(line.begin(), line.end(), 'L'), 2);
}

TEST(ChartDraw, SaysWhenThereIsNothing) {
  EXPECT_NE(pictures::draw_chart({}, {0, 0, 100, 100}).find("no values"), std::string::npos);
}

TEST(ChartDraw, NamesStandFromTheTopInPlaceOfNumbers) {
  pictures::Chart chart;
  chart.y_names = {"first", "second", "third"};
  chart.y_notes = {"", "a note"};
  chart.series = {{"one"}};
  chart.series[0].points = {{1.0, 0.0}, {2.0, 2.0}};
  const testing::XmlElement root =
      testing::read_xml("<svg>" + pictures::draw_chart(chart, {100, 0, 300, 90}) + "</svg>");
  std::map<std::string, double> y;
  for (const auto* text : root.find("text")) y[text->text] = std::stod(text->attributes.at("y")) - 4.0;
  EXPECT_NEAR(y.at("first"), 15.0, 0.1);
  EXPECT_NEAR(y.at("third"), 75.0, 0.1);
  EXPECT_NEAR(y.at("a note"), 45.0, 0.1);
  EXPECT_EQ(root.find("rect", "class", "band").size(), 1u);
}

TEST(ChartDraw, ShapesAreCutAtTheFrameAndStayVisible) {
  pictures::Chart chart;
  chart.x_range = chart.y_range = {0.0, 10.0};
  chart.series = {{"one"}};
  chart.series[0].shape_look = "class=\"shape\"";
  chart.series[0].least = 2.0;
  chart.series[0].shapes = {{-5.0, 5.0, 2.0, 4.0}, {3.0, 3.01, 5.0, 5.01}, {kNaN, kInfinity, 1.0, 2.0}};
  const testing::XmlElement root =
      testing::read_xml("<svg>" + pictures::draw_chart(chart, {100, 50, 200, 100}) + "</svg>");
  const auto shapes = root.find("rect", "class", "shape");
  ASSERT_EQ(shapes.size(), 3u);
  const auto number = [&](std::size_t i, const char* key) { return std::stod(shapes[i]->attributes.at(key)); };
  EXPECT_EQ(number(0, "x"), 100.0);
  EXPECT_EQ(number(0, "width"), 100.0);
  EXPECT_EQ(number(0, "y"), 110.0);
  EXPECT_EQ(number(0, "height"), 20.0);
  EXPECT_EQ(number(1, "width"), 2.0);
  EXPECT_EQ(number(1, "height"), 2.0);
  EXPECT_EQ(number(2, "width"), 200.0);
}

TEST(ColourScale, IsNeverEmptyAndSignedOnesPartAtZero) {
  const pictures::ColourScale sign = pictures::colour_scale(-1.0, 3.0, true);
  EXPECT_EQ(sign.low, -3.0);
  EXPECT_EQ(sign.high, 3.0);
  EXPECT_EQ(pictures::colour(0.5, sign.palette), "#fafafa");
  const pictures::ColourScale flat = pictures::colour_scale(2.0, 2.0, false);
  EXPECT_LT(flat.low, flat.high);
  EXPECT_EQ(flat.step(1.0, 20), 0u);
  EXPECT_EQ(flat.step(9.0, 20), 19u);
  EXPECT_EQ(flat.step(kNaN, 20), 0u);
}

TEST(SvgText, KeepsOnlyWhatXmlAllows) {
  EXPECT_EQ(pictures::xml_text("a<b>&c"), "a&lt;b&gt;&amp;c");
  EXPECT_EQ(pictures::xml_text("µm € 𝛿"), "µm € 𝛿");
  EXPECT_EQ(pictures::xml_text("a\x01\n\x7f"), "a   ");
  EXPECT_EQ(pictures::xml_text("caf\xe9"), "caf?");
  EXPECT_EQ(pictures::xml_text("\xed\xa0\x80"), "???");  // half of a surrogate pair
  EXPECT_EQ(pictures::xml_text("\xc0\xaf"), "??");       // longer than needed
  EXPECT_EQ(pictures::xml_text("\xef\xbf\xbf"), "?");    // U+FFFF
}

}  // namespace
}  // namespace treadmark
