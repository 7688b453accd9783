// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/pictures/chart_draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/pictures/chart_marks.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr double kLabelFont = 11.0;  // as in kChartStyle
constexpr double kReach = 1.3;       // of a marker's corners, over the radius of its area
constexpr double kObstacle = 8.0;    // [px] between places of a curve that labels keep clear of
constexpr double kClear = 2.0;       // [px] around them

/// Axes of a chart and where values lie in the picture [px].
class Frame {
 public:
  Frame(const Chart& chart, const ChartBox& box)
      : box_(box),
        x_(chart.x_range ? ChartAxis((*chart.x_range)[0], (*chart.x_range)[1])
                         : ChartAxis(chart.x_scale, values(chart, true), chart.x_floor)),
        y_(chart.y_range ? ChartAxis((*chart.y_range)[0], (*chart.y_range)[1])
                         : ChartAxis(chart.y_scale, values(chart, false), chart.y_floor)) {}

  std::optional<double> x(double value) const {
    const auto at = x_.place(value);
    return at ? std::optional(x_at(*at)) : std::nullopt;
  }
  std::optional<double> y(double value) const {
    const auto at = y_.place(value);
    return at ? std::optional(y_at(*at)) : std::nullopt;
  }
  bool at_floor(const ChartPoint& point) const { return x_.at_floor(point.x) || y_.at_floor(point.y); }
  const ChartBox& box() const { return box_; }
  bool empty(const Chart& chart) const {
    for (const ChartSeries& series : chart.series) {
      for (const ChartPoint& point : series.points)
        if (x(point.x) && y(point.y)) return false;
      for (const double level : series.levels)
        if (y(level)) return false;
      for (const auto& [at, value] : series.curve)
        if (x(at) && y(value)) return false;
    }
    return true;
  }

  std::string grid(const Chart& chart) const {
    std::string lines, numbers;
    for (const AxisTick& tick : x_.ticks()) {
      lines += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>\n", tick.label.empty() ? "minor" : "grid",
                           x_at(tick.at), box_.y, box_.height);
      if (!tick.label.empty() && chart.x_numbers)
        numbers += svg_text(x_at(tick.at), box_.y + box_.height + 16.0, tick.label);
    }
    for (const AxisTick& tick : y_.ticks()) {
      lines += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", tick.label.empty() ? "minor" : "grid",
                           box_.x, y_at(tick.at), box_.width);
      if (!tick.label.empty() && chart.y_numbers)
        numbers += svg_text(box_.x - 6.0, y_at(tick.at) + 4.0, tick.label, "end");
    }
    return lines + numbers;
  }

  /// Middle of the words along the y axis.
  double y_label_x() const {
    double widest = 0.0;
    for (const AxisTick& tick : y_.ticks()) widest = std::max(widest, text_width(tick.label, kChartFont));
    return box_.x - std::max(46.0, 16.0 + widest);
  }

 private:
  static std::vector<double> values(const Chart& chart, bool of_x) {
    std::vector<double> out;
    for (const ChartSeries& series : chart.series) {
      for (const ChartPoint& point : series.points) out.push_back(of_x ? point.x : point.y);
      if (!of_x) out.insert(out.end(), series.levels.begin(), series.levels.end());
      for (const auto& point : series.curve) out.push_back(point[of_x ? 0 : 1]);
    }
    return out;
  }
  double x_at(double part) const { return box_.x + part * box_.width; }
  double y_at(double part) const { return box_.y + (1.0 - part) * box_.height; }

  ChartBox box_;
  ChartAxis x_, y_;
};

std::string marker(int style, double x, double y, double radius, bool hollow, const std::string& details = {}) {
  const std::string_view colour = chart_colour(style);
  std::string out = fmt::format("<path class=\"mark\" stroke=\"{}\" fill=\"{}\" fill-opacity=\"{}\" d=\"{}\"", colour,
                                hollow ? std::string_view("#ffffff") : colour, hollow ? 1 : 0.85,
                                chart_marker_path(style, x, y, radius));
  return out + (details.empty() ? "/>\n" : "><title>" + xml_text(details) + "</title></path>\n");
}

/// Of a line or level, from its class to its path.
std::string stroke(const ChartSeries& series, bool level) {
  std::string out = fmt::format("class=\"{}\" stroke=\"{}\" stroke-width=\"{:.3g}\"", level ? "level" : "line",
                                chart_colour(series.style), series.width);
  if (!level && !series.dashes.empty()) out += fmt::format(" stroke-dasharray=\"{}\"", series.dashes);
  return out;
}

/// The parts of a curve between values that cannot be shown.
std::vector<std::vector<Pixel>> curve_parts(const ChartSeries& series, const Frame& frame) {
  std::vector<std::vector<Pixel>> parts;
  bool open = false;
  for (const auto& [at, value] : series.curve) {
    const auto x = frame.x(at), y = frame.y(value);
    if (x && y && !open) parts.emplace_back();
    open = x && y;
    if (open) parts.back().push_back({*x, *y});
  }
  for (auto& part : parts) part = thin_curve(part);
  return parts;
}

std::string draw_curve(const ChartSeries& series, const Frame& frame) {
  std::string path;
  for (const auto& part : curve_parts(series, frame)) path += curve_path(part);
  return path.empty() ? ""
                      : fmt::format("<path {} stroke-linejoin=\"round\" d=\"{}\"/>\n", stroke(series, false), path);
}

/// The names of curves, each beside its highest place, clear of the others.
std::string draw_curve_labels(const Chart& chart, const Frame& frame) {
  std::vector<LabelPoint> labels;
  std::vector<int> styles;
  for (const ChartSeries& series : chart.series) {
    LabelPoint top;
    bool any = false;
    for (const auto& part : curve_parts(series, frame))
      for (const Pixel& point : part)
        if (!any || point[1] < top.y) {
          top = {point[0], point[1], kClear, series.curve_label};
          any = true;
        }
    if (any && !series.curve_label.empty()) {
      labels.push_back(top);
      styles.push_back(series.style);
    }
  }
  const std::size_t count = labels.size();
  if (count == 0) return {};
  for (const ChartSeries& series : chart.series)
    for (const auto& part : curve_parts(series, frame)) {
      Pixel before{-kObstacle, 0.0};
      for (const Pixel& point : part)
        if (std::hypot(point[0] - before[0], point[1] - before[1]) >= kObstacle) {
          labels.push_back({point[0], point[1], kClear, {}});
          before = point;
        }
    }
  const std::vector<LabelPlace> places = place_labels(labels, frame.box(), kLabelFont);
  std::string out;
  for (std::size_t i = 0; i < count; ++i)
    out += svg_text(places[i].x, places[i].y, labels[i].text, "start",
                    fmt::format(" class=\"label halo\" fill=\"{}\"", chart_colour(styles[i])).c_str());
  return out;
}

std::string draw_lines(const ChartSeries& series, const Frame& frame) {
  std::string out = draw_curve(series, frame);
  for (const double level : series.levels)
    if (const auto y = frame.y(level))
      out += fmt::format("<path {} d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", stroke(series, true), frame.box().x, *y,
                         frame.box().width);
  if (!series.joined) return out;
  std::string path;
  bool open = false;
  for (const ChartPoint& point : series.points) {
    const auto x = frame.x(point.x), y = frame.y(point.y);
    if (x && y) path += fmt::format("{}{:.1f} {:.1f}", open ? 'L' : 'M', *x, *y);
    open = x && y;
  }
  if (!path.empty()) out += fmt::format("<path {} d=\"{}\"/>\n", stroke(series, false), path);
  return out;
}

std::string draw_points(const Chart& chart, const Frame& frame) {
  std::string out;
  std::vector<LabelPoint> labels;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) {
      const auto x = frame.x(point.x), y = frame.y(point.y);
      if (!x || !y) continue;
      out += marker(series.style, *x, *y, point.radius, frame.at_floor(point), point.details);
      labels.push_back({*x, *y, kReach * point.radius, point.label});
    }
  const std::vector<LabelPlace> places = place_labels(labels, frame.box(), kLabelFont);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (!labels[i].text.empty()) out += svg_text(places[i].x, places[i].y, labels[i].text, "start", " class=\"label\"");
  return out;
}

}  // namespace

std::string draw_chart(const Chart& chart, const ChartBox& box) {
  const Frame frame(chart, box);
  std::string out = "<g class=\"chart\">\n" + frame.grid(chart);
  for (const ChartSeries& series : chart.series) out += draw_lines(series, frame);
  out += fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", box.x,
                     box.y, box.width, box.height);
  out += draw_points(chart, frame) + draw_curve_labels(chart, frame);
  const double middle = box.x + 0.5 * box.width, left = frame.y_label_x(), centre = box.y + 0.5 * box.height;
  if (frame.empty(chart)) out += svg_text(middle, centre, "no values");
  out += svg_text(middle, box.y - 8.0, chart.title, "middle", " class=\"title\"");
  out += svg_text(middle, box.y + box.height + 36.0, chart.x_label);
  out += svg_text(left, centre, chart.y_label, "middle",
                  fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", left, centre).c_str());
  return out + "</g>\n";
}

std::string draw_chart_legend(const std::vector<ChartSeries>& series, double x, double y) {
  std::string out = "<g class=\"legend\">\n";
  for (const ChartSeries& item : series) {
    const bool line = !item.curve.empty() || (item.joined && !item.points.empty());
    const bool level = !line && item.points.empty() && !item.levels.empty();
    if (line || level) out += fmt::format("<path {} d=\"M{:.1f} {:.1f}h28\"/>\n", stroke(item, level), x, y);
    if (!item.points.empty())
      out += marker(item.style, x + 14.0, y, item.joined ? item.points.front().radius : ChartPoint{}.radius, false);
    out += svg_text(x + 36.0, y + 4.0, item.name, "start");
    y += kLegendLine;
  }
  return out + "</g>\n";
}

}  // namespace treadmark::io
