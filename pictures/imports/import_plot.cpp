// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/pictures/imports/import_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr double kBeyond = 4000.0;  // [px]; points farther from the box are not written
constexpr double kSame = 0.25;      // [px]; points of a curve this near to each other are one
constexpr std::size_t kMostDots = 12000;
constexpr double kFont = 12.0;
constexpr double kLargest = 1e9;  // of a value on an axis

}  // namespace

const char* const kImportStyle =
    ".head{font-size:17px;font-weight:bold}.sub{font-size:12px;fill:#555555}.title{font-size:13px;font-weight:bold}"
    ".frame{fill:none;stroke:#444444}.grid{fill:none;stroke:#dddddd;stroke-width:.8}"
    ".tick{fill:none;stroke:#444444;stroke-width:.8}.curve{fill:none;stroke-linejoin:round}"
    ".dots{fill:none;stroke-linecap:round}.remark{font-size:11px;fill:#555555}.number{font-size:11px}"
    ".table{font-size:12px;white-space:pre}.bold{font-weight:bold}";

bool PlotRange::usable() const {
  return std::abs(low) < kLargest && std::abs(high) < kLargest &&
         high - low > 1e-9 * std::max({std::abs(low), std::abs(high), 1e-12});
}

std::vector<double> round_ticks(const PlotRange& range, int most) {
  std::vector<double> out;
  if (!range.usable()) return out;
  const double step = tick_step(range.length() * 6.0 / most);
  for (double i = std::ceil(range.low / step - 1e-9); i * step <= range.high + 1e-9 * step; ++i) {
    out.push_back(i * step + 0.0);
    if (out.size() > static_cast<std::size_t>(most)) break;
  }
  return out;
}

PlotFrame::PlotFrame(const ChartBox& box, PlotRange x, PlotRange y, bool y_down)
    : box_(box), x_(x.usable() ? x : PlotRange{}), y_(y.usable() ? y : PlotRange{}), y_down_(y_down) {}

double PlotFrame::py(double y) const {
  const double part = (y - y_.low) / y_.length();
  return box_.y + (y_down_ ? part : 1.0 - part) * box_.height;
}

bool PlotFrame::holds(const Vec2& p) const {
  return p.x() >= x_.low && p.x() <= x_.high && p.y() >= y_.low && p.y() <= y_.high;
}

std::string PlotFrame::axes(const std::string& x_name, const std::string& y_name, bool grid) const {
  const double bottom = box_.y + box_.height;
  std::string lines, numbers;
  for (const double value : round_ticks(x_, std::max(3, static_cast<int>(box_.width / 44.0)))) {
    const double at = px(value);
    if (grid) lines += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>\n", at, box_.y, box_.height);
    lines += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v4\"/>\n", at, bottom);
    numbers += svg_text(at, bottom + 16.0, fmt::format("{:.6g}", value), "middle", " class=\"number\"");
  }
  double widest = 0.0;
  for (const double value : round_ticks(y_, std::max(2, static_cast<int>(box_.height / 22.0)))) {
    const double at = py(value);
    const std::string text = fmt::format("{:.6g}", value);
    if (grid) lines += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", box_.x, at, box_.width);
    lines += fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}h-4\"/>\n", box_.x, at);
    numbers += svg_text(box_.x - 7.0, at + 4.0, text, "end", " class=\"number\"");
    widest = std::max(widest, text_width(text, 11.0));
  }
  if (!x_name.empty()) numbers += svg_text(box_.x + 0.5 * box_.width, bottom + 33.0, x_name);
  if (!y_name.empty()) {
    const double left = box_.x - std::max(40.0, widest + 18.0), middle = box_.y + 0.5 * box_.height;
    numbers += svg_text(left, middle, y_name, "middle",
                        fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", left, middle).c_str());
  }
  return lines + numbers;
}

std::string PlotFrame::border() const {
  return fmt::format("<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n", box_.x,
                     box_.y, box_.width, box_.height);
}

std::string PlotFrame::clip() const { return fmt::format("clip-{:.0f}-{:.0f}", box_.x, box_.y); }

std::string PlotFrame::curve(std::span<const Vec2> points, const std::string& colour, double width,
                             const std::string& more) const {
  std::string path;
  bool open = false;
  double last_x = 0.0, last_y = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = px(points[i].x()), y = py(points[i].y());
    if (!(std::abs(x) < kBeyond && std::abs(y) < kBeyond)) {
      open = false;
      continue;
    }
    if (open && i + 1 < points.size() && std::abs(x - last_x) < kSame && std::abs(y - last_y) < kSame) continue;
    path += fmt::format("{}{:.1f} {:.1f}", open ? 'L' : 'M', x, y);
    open = true;
    last_x = x;
    last_y = y;
  }
  if (path.empty()) return {};
  return fmt::format(
      "<clipPath id=\"{0}\"><rect x=\"{1:.1f}\" y=\"{2:.1f}\" width=\"{3:.1f}\" height=\"{4:.1f}\"/></clipPath>\n"
      "<path class=\"curve\" clip-path=\"url(#{0})\" stroke=\"{5}\" stroke-width=\"{6:.3g}\"{7} d=\"{8}\"/>\n",
      clip() + colour.substr(1), box_.x, box_.y, box_.width, box_.height, colour, width, more, path);
}

std::string PlotFrame::dots(std::span<const Vec2> points, const std::string& colour, double diameter) const {
  std::set<std::pair<std::int64_t, std::int64_t>> places;  // in half pixels
  const std::size_t stride = 1 + points.size() / 200000;
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (holds(points[i])) places.insert({std::llround(2.0 * px(points[i].x())), std::llround(2.0 * py(points[i].y()))});
  if (places.empty()) return {};
  const std::size_t every = 1 + places.size() / kMostDots;
  std::string path;
  std::size_t count = 0;
  for (const auto& [x, y] : places)
    if (count++ % every == 0)
      path += fmt::format("M{:g} {:g}h0", 0.5 * static_cast<double>(x), 0.5 * static_cast<double>(y));
  return fmt::format("<path class=\"dots\" stroke=\"{}\" stroke-width=\"{:.3g}\" d=\"{}\"/>\n", colour, diameter, path);
}

std::string PlotFrame::level(double y, const std::string& dashes) const {
  if (!(y > y_.low && y < y_.high)) return {};
  return fmt::format("<path class=\"tick\" stroke-dasharray=\"{}\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", dashes, box_.x,
                     py(y), box_.width);
}

std::string draw_keys(std::span<const PlotKey> keys, double x, double y) {
  std::string out = "<g class=\"legend\">\n";
  for (const PlotKey& key : keys) {
    double width = 22.0;
    if (key.kind == PlotKey::Kind::line || key.kind == PlotKey::Kind::dashes)
      out += fmt::format("<path class=\"curve\" stroke=\"{}\" stroke-width=\"1.8\"{} d=\"M{:.1f} {:.1f}h{:.0f}\"/>\n",
                         key.colour, key.kind == PlotKey::Kind::dashes ? " stroke-dasharray=\"6 3\"" : "", x, y, width);
    else if (key.kind == PlotKey::Kind::dot)
      out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n", x + 0.5 * (width = 8.0), y,
                         key.colour);
    else
      out +=
          fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.0f}\" height=\"10\" fill=\"{}\" stroke=\"{}\"/>\n", x,
                      y - 5.0, width = 14.0, key.kind == PlotKey::Kind::hatch ? "url(#holes)" : "none", key.colour);
    out += svg_text(x + width + 6.0, y + 4.0, key.name, "start");
    x += width + 6.0 + text_width(key.name, kFont) + 20.0;
  }
  return out + "</g>\n";
}

std::string hole_pattern() {
  return "<pattern id=\"holes\" width=\"6\" height=\"6\" patternUnits=\"userSpaceOnUse\">"
         "<rect width=\"6\" height=\"6\" fill=\"#cfcfcf\"/>"
         "<path d=\"M-1 1l2 -2M0 6l6 -6M5 7l2 -2\" stroke=\"#8c8c8c\" stroke-width=\"1\"/></pattern>\n";
}

std::string picture_heading(const std::string& title, const std::string& line) {
  return svg_text(20.0, 28.0, title, "start", " class=\"head\"") +
         svg_text(20.0, 47.0, line, "start", " class=\"sub\"");
}

}  // namespace treadmark::io
