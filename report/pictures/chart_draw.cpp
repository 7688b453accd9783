// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kLabelFont = 11.0;  // as in kChartStyle
constexpr double kReach = 1.3;       // of a marker's corners, over the radius of its area
constexpr double kObstacle = 8.0;    // [px] between places of a curve that labels keep clear of
constexpr double kClear = 2.0;       // [px] around them
constexpr std::size_t kMostTried = 200000, kMostDots = 12000;

/// Axes of a chart and where values lie in the picture [px].
class Frame {
 public:
  Frame(const Chart& chart, const Box& box)
      : box_(box),
        down_(chart.y_down || !chart.y_names.empty()),
        x_(axis(chart, chart.x_range, chart.x_scale, chart.x_floor, chart.x_names.size(), true)),
        y_(axis(chart, chart.y_range, chart.y_scale, chart.y_floor, chart.y_names.size(), false)) {}

  std::optional<double> x(double value) const {
    const auto at = x_.place(value);
    return at ? std::optional(x_at(*at)) : std::nullopt;
  }
  std::optional<double> y(double value) const {
    const auto at = y_.place(value);
    return at ? std::optional(y_at(*at)) : std::nullopt;
  }
  bool at_floor(const ChartPoint& point) const { return x_.at_floor(point.x) || y_.at_floor(point.y); }
  const Box& box() const { return box_; }
  /// The part of a rectangle inside the frame, of at least this width and height unless it has none.
  Box inside(const ChartShape& shape, double least) const {
    const double x0 = x_at(x_.nearest(shape.x_low)), x1 = x_at(x_.nearest(shape.x_high));
    const double y0 = y_at(y_.nearest(shape.y_high)), y1 = y_at(y_.nearest(shape.y_low));
    const auto size = [least](double length) { return length > 0.0 ? std::max(least, length) : 0.0; };
    return {x0, std::min(y0, y1), size(x1 - x0), size(std::abs(y1 - y0))};
  }
  std::string grid(const Chart& chart) const {
    std::string lines, numbers;
    const auto path = [&](const char* name, double x, double y, char direction, double length) {
      lines += fmt::format("<path class=\"{}\" d=\"M{:.1f} {:.1f}{}{:.1f}\"/>\n", name, x, y, direction, length);
    };
    for (const AxisTick& tick : x_ticks(chart)) {
      const double at = x_at(tick.at);
      if (chart.image)
        path("tick", at, box_.bottom(), 'v', 4.0);
      else
        path(tick.label.empty() ? "minor" : "grid", at, box_.y, 'v', box_.height);
      if (!tick.label.empty() && chart.x_numbers)
        numbers += chart.x_names.empty() ? svg_text(at, box_.bottom() + 16.0, tick.label)
                                         : turned_text(at + 4.0, box_.bottom() + 16.0, tick.label, "end", -35);
    }
    for (const AxisTick& tick : chart.top) {
      path("tick", x_at(tick.at), box_.y, 'v', -4.0);
      numbers += svg_text(x_at(tick.at), box_.y - 7.0, tick.label);
    }
    for (const AxisTick& tick : y_ticks(chart)) {
      const double at = y_at(tick.at);
      if (chart.image)
        path("tick", box_.x, at, 'h', -4.0);
      else if (chart.y_names.empty())
        path(tick.label.empty() ? "minor" : "grid", box_.x, at, 'h', box_.width);
      if (!tick.label.empty() && chart.y_numbers) numbers += svg_text(box_.x - 6.0, at + 4.0, tick.label, "end");
    }
    return bands(chart) + lines + numbers;
  }

  /// Middle of the words along the y axis.
  double y_label_x(const Chart& chart) const {
    double widest = 0.0;
    for (const AxisTick& tick : y_ticks(chart)) widest = std::max(widest, text_width(tick.label, kChartFont));
    return box_.x - std::max(46.0, 16.0 + widest);
  }

 private:
  static std::vector<double> values(const Chart& chart, bool of_x) {
    std::vector<double> out;
    for (const ChartSeries& series : chart.series) {
      for (const ChartPoint& point : series.points) out.push_back(of_x ? point.x : point.y);
      if (!of_x) out.insert(out.end(), series.levels.begin(), series.levels.end());
      for (const Curve* curve : {&series.curve, &series.dots})
        for (const auto& point : *curve) out.push_back(point[of_x ? 0 : 1]);
    }
    return out;
  }
  static ChartAxis axis(const Chart& chart, const std::optional<AxisRange>& range, AxisScale scale, double floor,
                        std::size_t names, bool of_x) {
    if (names > 0) return {AxisScale::linear, AxisRange{-0.5, static_cast<double>(names) - 0.5}};
    return range ? ChartAxis(scale, *range) : ChartAxis(scale, values(chart, of_x), floor);
  }
  static std::vector<AxisTick> categories(const std::vector<std::string>& names) {
    std::vector<AxisTick> out;
    out.reserve(names.size());
    for (const std::string& name : names)
      out.push_back({(static_cast<double>(out.size()) + 0.5) / static_cast<double>(names.size()), name});
    return out;
  }
  std::vector<AxisTick> x_ticks(const Chart& chart) const {
    return chart.x_names.empty() ? x_.ticks(chart.x_ticks) : categories(chart.x_names);
  }
  std::vector<AxisTick> y_ticks(const Chart& chart) const {
    return chart.y_names.empty() ? y_.ticks(chart.y_ticks) : categories(chart.y_names);
  }
  /// Every second row of names on grey, and the notes.
  std::string bands(const Chart& chart) const {
    std::string out;
    const double height = box_.height / static_cast<double>(std::max<std::size_t>(1, chart.y_names.size()));
    for (std::size_t i = 0; i < chart.y_names.size(); ++i) {
      const double y = box_.y + height * static_cast<double>(i);
      if (i % 2 == 1) out += svg_box("band", {box_.x, y, box_.width, height}, " fill=\"#f5f5f5\"");
      if (i < chart.y_notes.size() && !chart.y_notes[i].empty())
        out += remark(box_.x + 6.0, y + 0.5 * height + 4.0, chart.y_notes[i]);
    }
    return out;
  }
  double x_at(double part) const { return box_.x + part * box_.width; }
  double y_at(double part) const { return box_.y + (down_ ? part : 1.0 - part) * box_.height; }

  Box box_;
  bool down_;
  ChartAxis x_, y_;
};

std::string_view colour_of(const ChartSeries& series) {
  return series.colour.empty() ? chart_colour(series.style) : std::string_view(series.colour);
}

std::string with_details(const std::string& element, const char* name, const std::string& details) {
  return element + (details.empty() ? "/>\n" : "><title>" + xml_text(details) + fmt::format("</title></{}>\n", name));
}

std::string marker(const ChartSeries& series, double x, double y, double radius, bool hollow,
                   const std::string& details = {}) {
  const std::string_view colour = colour_of(series);
  return with_details(fmt::format("<path class=\"mark\" stroke=\"{}\" fill=\"{}\" fill-opacity=\"{}\" d=\"{}\"", colour,
                                  hollow ? std::string_view("#ffffff") : colour, hollow ? 1 : 0.85,
                                  chart_marker_path(series.style, x, y, radius)),
                      "path", details);
}

/// Of a line or level, from its class to its path.
std::string stroke(const ChartSeries& series, bool level) {
  std::string out = fmt::format("class=\"{}\" stroke=\"{}\" stroke-width=\"{:.3g}\"", level ? "level" : "line",
                                colour_of(series), series.width);
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
  std::vector<const ChartSeries*> of;
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
      of.push_back(&series);
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
  const std::vector<Pixel> places = place_labels(labels, frame.box(), kLabelFont);
  std::string out;
  for (std::size_t i = 0; i < count; ++i)
    out += svg_text(places[i][0], places[i][1], labels[i].text, "start",
                    fmt::format(" class=\"label halo\" fill=\"{}\"", colour_of(*of[i])).c_str());
  return out;
}

std::string draw_dots(const ChartSeries& series, const Frame& frame) {
  std::set<std::pair<std::int64_t, std::int64_t>> places;  // in half pixels
  const std::size_t stride = 1 + series.dots.size() / kMostTried;
  for (std::size_t i = 0; i < series.dots.size(); i += stride)
    if (const auto x = frame.x(series.dots[i][0]), y = frame.y(series.dots[i][1]); x && y)
      places.insert({to_whole<long long>(std::round(2.0 * *x)), to_whole<long long>(std::round(2.0 * *y))});
  if (places.empty()) return {};
  const std::size_t every = 1 + places.size() / kMostDots;
  std::string path;
  std::size_t count = 0;
  for (const auto& [x, y] : places)
    if (count++ % every == 0)
      path += fmt::format("M{:g} {:g}h0", 0.5 * static_cast<double>(x), 0.5 * static_cast<double>(y));
  return fmt::format(
      "<path class=\"dots\" fill=\"none\" stroke-linecap=\"round\" stroke=\"{}\" stroke-width=\"{:.3g}\" d=\"{}\"/>\n",
      colour_of(series), series.width, path);
}

std::string draw_shapes(const ChartSeries& series, const Frame& frame) {
  std::string out;
  for (const ChartShape& shape : series.shapes) {
    const Box box = frame.inside(shape, series.least);
    out += series.ellipses
               ? fmt::format("<ellipse cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"{:.1f}\" ry=\"{:.1f}\" {}/>\n", box.middle_x(),
                             box.middle_y(), 0.5 * box.width, 0.5 * box.height, series.shape_look)
               : with_details(fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                                          "height=\"{:.1f}\" {}",
                                          box.x, box.y, box.width, box.height, series.shape_look),
                              "rect", shape.details);
  }
  return out;
}

std::string draw_lines(const ChartSeries& series, const Frame& frame) {
  std::string out = draw_dots(series, frame) + draw_shapes(series, frame) + draw_curve(series, frame);
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
      out += marker(series, *x, *y, point.radius, frame.at_floor(point), point.details);
      labels.push_back({*x, *y, kReach * point.radius, point.label});
    }
  const std::size_t count = labels.size();
  for (const ChartSeries& series : chart.series)
    for (const ChartShape& shape : series.shapes)
      if (const Box box = frame.inside(shape, series.least); !shape.label.empty())
        labels.push_back({box.middle_x(), box.middle_y(), 0.5 * box.width, shape.label, 0.5 * box.height});
  const std::vector<Pixel> places = place_labels(labels, frame.box(), kLabelFont);
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (!labels[i].text.empty())
      out += svg_text(places[i][0], places[i][1], labels[i].text, "start",
                      i < count ? " class=\"label\"" : " class=\"label halo\"");
  return out;
}

/// The hatched ground, what is known over it, and what the colours mean.
std::string draw_image(const ChartImage& image, const Box& box) {
  constexpr const char* kHatched = " fill=\"url(#holes)\"";
  return svg_box("ground", box, kHatched) + image_element(image.pixels, box) +
         draw_colour_bar(image.colours, {box.right() + 16.0, box.y, kBarWidth, box.height}, kImageSteps,
                         box.height < 60.0 ? 2 : 4) +
         svg_text(box.right() + 80.0, box.y - 9.0, image.label, "end");
}

}  // namespace

std::string remark(double x, double y, const std::string& words) {
  return svg_text(x, y, words, "start", " class=\"remark\"");
}

std::string draw_chart(const Chart& chart, const Box& box) {
  const Frame frame(chart, box);
  std::string lines;
  for (const ChartSeries& series : chart.series) lines += draw_lines(series, frame);
  const std::string points = draw_points(chart, frame);
  const bool nothing = !chart.image && lines.empty() && points.empty();
  std::string out = "<g class=\"chart\">\n";
  if (chart.image) out += draw_image(*chart.image, box);
  if (!nothing || chart.x_range || !chart.x_label.empty()) out += frame.grid(chart);
  out += lines + svg_box("frame", box) + points + draw_curve_labels(chart, frame);
  const double middle = box.middle_x(), left = frame.y_label_x(chart), centre = box.middle_y();
  if (nothing) out += svg_text(middle, centre, chart.nothing);
  out += svg_text(middle, box.y - 8.0, chart.title, "middle", " class=\"title\"");
  out += svg_text(middle, box.y + box.height + 36.0, chart.x_label);
  return out + turned_text(left, centre, chart.y_label) + "</g>\n";
}

std::string draw_chart_legend(const std::vector<ChartSeries>& series, double x, double y, double width) {
  std::string out = "<g class=\"legend\">\n";
  const double left = x;
  for (const ChartSeries& item : series) {
    const bool line = !item.curve.empty() || (item.joined && !item.points.empty());
    const bool level = !line && item.points.empty() && !item.levels.empty();
    const double sample = line || level || width == 0.0 ? 28.0 : 14.0;
    const double gap = width > 0.0 ? 6.0 : 8.0, step = sample + gap + text_width(item.name, kChartFont) + 10.0;
    if (width > 0.0 && x > left && x + step > left + width + 10.0) x = left, y += kLegendLine;
    if (line || level) out += fmt::format("<path {} d=\"M{:.1f} {:.1f}h28\"/>\n", stroke(item, level), x, y);
    if (!item.points.empty())
      out += marker(item, x + 0.5 * sample, y, item.joined ? item.points.front().radius : ChartPoint{}.radius, false);
    else if (!item.dots.empty())
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n", x + 0.5 * sample, y,
                         colour_of(item));
    else if (!item.shape_look.empty())
      out +=
          fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"10\" {}/>\n", x, y - 5.0, item.shape_look);
    out += svg_text(x + sample + gap, y + 4.0, item.name, "start");
    if (width > 0.0)
      x += step;
    else
      y += kLegendLine;
  }
  return out + "</g>\n";
}

}  // namespace treadmark::pictures
