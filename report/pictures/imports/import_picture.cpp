// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/imports/import_picture.hpp"

#include <algorithm>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/report/pictures/imports/import_pictures.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kPictureWidth = 1000.0, kRow = 19.0;     // [px]
constexpr double kPerTickX = 44.0, kPerTickY = 22.0;      // least room of a number [px]
constexpr double kBelowFrame = 68.0, kAboveFrame = 12.0;  // axis names, title [px]

}  // namespace

void ImportPicture::end(double bottom) {
  bottom_ = std::max(bottom_, bottom);
  y_ = bottom_;
}

void ImportPicture::add(ImportPanel panel, double left) {
  begin_ = y_;
  elements_ += svg_text(left, y_, panel.title, "start", " class=\"title\"");
  double y = y_ + kAboveFrame;
  std::vector<ChartSeries> keys = named(panel.keys);
  std::erase_if(keys, [](const auto& key) { return key.curve.empty() && key.dots.empty() && key.shape_look.empty(); });
  if (!keys.empty()) {
    elements_ += draw_chart_legend(keys, left, y + 2.0, kFullWidth);
    y += 16.0;
  } else if (!panel.remark.empty()) {
    elements_ += remark(left, y + 5.0, panel.remark);
    y += 16.0;
  }
  if (!panel.chart.top.empty()) y += 14.0;
  panel.chart.x_ticks = std::max(3, to_whole<int>(panel.width / kPerTickX));
  panel.chart.y_ticks = std::max(2, to_whole<int>(panel.height / kPerTickY));
  elements_ += draw_chart(panel.chart, {left + panel.indent, y, panel.width, panel.height});
  end(y + panel.height + (panel.chart.x_label.empty() ? 24.0 : kBelowFrame));
}

void ImportPicture::add_table(const std::string& title, double x, const std::vector<double>& edges,
                              const std::vector<std::vector<std::string>>& rows, const std::string& words) {
  begin_ = y_;
  elements_ += svg_text(x, y_, title, "start", " class=\"title\"");
  double y = y_ + kRow + 2.0;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!row[i].empty())
        elements_ += svg_text(edges[i] > 0.0 ? x + edges[i] : x, y, row[i], edges[i] > 0.0 ? "end" : "start",
                              &row == &rows.front() && row.front().empty() ? " class=\"remark\"" : "");
    y += kRow;
  }
  if (!words.empty()) elements_ += remark(x, y, words);
  end(y + kRow);
}

std::string ImportPicture::finish(const io::ImportReport& report, const std::string& more) const {
  return svg_head(kPictureWidth, bottom_, kChartFont, std::string(kChartStyle).append(kTickStyle)) + hole_pattern() +
         svg_text(20.0, 28.0, heading_, "start", " font-size=\"17px\" font-weight=\"bold\"") +
         svg_text(20.0, 47.0, import_heading(report) + more, "start", " fill=\"#555555\"") + elements_ + "</svg>\n";
}

ChartSeries line_series(std::string name, const char* colour, Curve curve, double width, const char* dashes) {
  ChartSeries out{std::move(name)};
  out.colour = colour;
  out.curve = std::move(curve);
  out.width = width;
  out.dashes = dashes;
  return out;
}

ChartSeries dot_series(std::string name, const char* colour, Curve dots, double diameter) {
  ChartSeries out{std::move(name)};
  out.colour = colour;
  out.dots = std::move(dots);
  out.width = diameter;
  return out;
}

ChartSeries shape_series(std::string name, std::string look, std::vector<ChartShape> shapes, double least) {
  ChartSeries out{std::move(name)};
  out.shape_look = std::move(look);
  out.shapes = std::move(shapes);
  out.least = least;
  return out;
}

Curve in_mm(const io::SectionPoints& points) {
  Curve out;
  out.reserve(points.size());
  for (const Vec2& p : points) out.push_back({1e3 * p.x(), 1e3 * p.y()});
  return out;
}

}  // namespace treadmark::pictures
