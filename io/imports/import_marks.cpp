// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/io/imports/import_section.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr std::size_t kMostHoles = 300, kMostDamage = 8;
constexpr double kLine = 18.0;

/// Middles in the map [mm]: one, or two where the mark crosses the seam of a whole wheel.
std::vector<Vec2> places(const ImportReport& report, double u, double y, double s, double length) {
  const BandMap& map = report.fitted;
  const bool wheel = report.body == Body::wheel;
  if (!std::isfinite(s)) s = s_of_y(report.section, map.s_min, map.s_max, y);
  double a = wheel ? u * report.nominal_radius : u;
  if (!std::isfinite(s) || !std::isfinite(a)) return {};
  const double round = 2.0 * std::numbers::pi * report.nominal_radius;
  const bool whole = wheel && report.closed && round > 0.0;
  if (whole) a -= round * std::floor((a - map.a_min) / round);
  std::vector<Vec2> out{{1e3 * a, 1e3 * s}};
  if (whole && a + 0.5 * length > map.a_max) out.push_back({1e3 * (a - round), 1e3 * s});
  if (whole && a - 0.5 * length < map.a_min) out.push_back({1e3 * (a + round), 1e3 * s});
  return out;
}

/// The part of a rectangle inside the frame [px].
ChartBox rectangle(const PlotFrame& frame, const Vec2& middle, double length, double width) {
  const ChartBox& box = frame.box();
  const double x0 = std::clamp(frame.px(middle.x() - 0.5 * length), box.x, box.x + box.width);
  const double x1 = std::clamp(frame.px(middle.x() + 0.5 * length), box.x, box.x + box.width);
  const double y0 = std::clamp(frame.py(middle.y() + 0.5 * width), box.y, box.y + box.height);
  const double y1 = std::clamp(frame.py(middle.y() - 0.5 * width), box.y, box.y + box.height);
  return {x0, y0, x1 - x0, y1 - y0};
}

std::string rectangle_element(const ChartBox& r) {
  return fmt::format(
      "<rect class=\"damage\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
      "stroke=\"#111111\" stroke-width=\"1.3\"/>\n",
      r.x, r.y, std::max(1.0, r.width), std::max(1.0, r.height));
}

std::string depth_text(double depth) {
  return depth < 0.0 ? length_text(-depth, "\u00b5") + " high" : length_text(depth, "\u00b5");
}

bool overlap(const ChartBox& a, const ChartBox& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// Beside the mark, on as few others as can be.
ChartBox label_box(const ChartBox& mark, double width, const std::vector<ChartBox>& taken, const ChartBox& frame) {
  const double height = 15.0, middle = mark.y + 0.5 * mark.height - 0.5 * height, gap = 4.0;
  const double right = mark.x + mark.width + gap, left = mark.x - gap - width;
  const double centre = mark.x + 0.5 * (mark.width - width);
  const std::array<ChartBox, 8> trials{{{right, middle, width, height},
                                        {left, middle, width, height},
                                        {centre, mark.y - height - gap, width, height},
                                        {centre, mark.y + mark.height + gap, width, height},
                                        {right, mark.y, width, height},
                                        {right, mark.y + mark.height - height, width, height},
                                        {left, mark.y, width, height},
                                        {left, mark.y + mark.height - height, width, height}}};
  ChartBox best = trials[0];
  int least = -1;
  for (const ChartBox& trial : trials) {
    int cost = static_cast<int>(
        std::count_if(taken.begin(), taken.end(), [&](const ChartBox& t) { return overlap(trial, t); }));
    if (trial.x < frame.x || trial.x + width > frame.x + frame.width) cost += 3;
    if (trial.y < frame.y || trial.y + height > frame.y + frame.height) cost += 3;
    if (least < 0 || cost < least) least = cost, best = trial;
  }
  best.x = std::clamp(best.x, frame.x + 1.0, std::max(frame.x + 1.0, frame.x + frame.width - width - 1.0));
  best.y = std::clamp(best.y, frame.y + 1.0, std::max(frame.y + 1.0, frame.y + frame.height - height - 1.0));
  return best;
}

std::string draw_holes(const ImportReport& report, const PlotFrame& frame) {
  std::string path;
  const double per_mm_x = frame.box().width / frame.x().length(), per_mm_y = frame.box().height / frame.y().length();
  std::size_t count = 0;
  for (const ImportReport::Hole& hole : report.holes) {
    if (++count > kMostHoles) break;
    const double radius = 500.0 * hole.diameter;
    if (!(radius > 0.0 && radius < 1e6)) continue;
    for (const Vec2& middle : places(report, hole.u, hole.y, hole.s, hole.diameter)) {
      if (!frame.holds(middle)) continue;
      const double rx = std::max(1.0, radius * per_mm_x), ry = std::max(1.0, radius * per_mm_y);
      path += fmt::format(
          "<ellipse class=\"hole\" cx=\"{:.1f}\" cy=\"{:.1f}\" rx=\"{:.1f}\" ry=\"{:.1f}\" fill=\"none\" "
          "stroke=\"#7a1fa2\" "
          "stroke-width=\"1\"{}/>\n",
          frame.px(middle.x()), frame.py(middle.y()), rx, ry, hole.filled ? " stroke-dasharray=\"2 2\"" : "");
    }
  }
  return path;
}

}  // namespace

std::string draw_marks(const ImportReport& report, const MapPanel& panel) {
  if (!is_drawable(report.fitted)) return {};
  const PlotFrame& frame = panel.frame;
  std::string out = draw_holes(report, frame), words;
  std::vector<ChartBox> marks, taken;
  const std::size_t count = std::min(report.damage.size(), kMostDamage);
  std::vector<ChartBox> first(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ImportReport::Damage& part = report.damage[i];
    if (!(part.length >= 0.0 && part.width >= 0.0 && std::isfinite(part.length + part.width))) continue;
    for (const Vec2& middle : places(report, part.u, part.y, part.s, part.length)) {
      const ChartBox mark = rectangle(frame, middle, 1e3 * part.length, 1e3 * part.width);
      out += rectangle_element(mark);
      taken.push_back(mark);
      if (mark.width * mark.height >= first[i].width * first[i].height) first[i] = mark;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (first[i].y == 0.0) continue;  // not on the map
    const std::string text = fmt::format("{}: {}", i + 1, depth_text(report.damage[i].depth));
    const ChartBox box = label_box(first[i], text_width(text, 11.0) + 6.0, taken, frame.box());
    taken.push_back(box);
    words += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" rx=\"2\" fill=\"#ffffff\" "
        "fill-opacity=\"0.85\"/>\n",
        box.x, box.y, box.width, box.height);
    words += svg_text(box.x + 0.5 * box.width, box.y + 11.5, text, "middle", " class=\"number bold\"");
  }
  return out + words;
}

std::string draw_damage_table(const ImportReport& report, double x, double y, double& bottom) {
  const std::size_t count = std::min(report.damage.size(), kMostDamage);
  std::string out = svg_text(x, y,
                             report.damage_threshold > 0.0 ? fmt::format("Damage beyond {}, largest first",
                                                                         length_text(report.damage_threshold, "\u00b5"))
                                                           : std::string("Damage, largest first"),
                             "start", " class=\"title\"");
  y += kLine + 2.0;
  if (count == 0) {
    bottom = y + kLine;
    return out + svg_text(x, y, "none", "start");
  }
  const std::array<const char*, 6> names{
      "", report.body == Body::wheel ? "at angle" : "at x", "y", "length \u00d7 width", "deepest", "missing volume"};
  const std::array<double, 6> right{12.0, 120.0, 205.0, 360.0, 460.0, 585.0};
  const auto row = [&](const std::array<std::string, 6>& cells, const char* style) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (!cells[i].empty()) out += svg_text(x + right[i], y, cells[i], "end", style);
    y += kLine;
  };
  row({names[0], names[1], names[2], names[3], names[4], names[5]}, " class=\"remark\"");
  for (std::size_t i = 0; i < count; ++i) {
    const ImportReport::Damage& part = report.damage[i];
    row({std::to_string(i + 1), place_text(report, part.u, "\u00b0"), decimals(1e3 * part.y, 1) + " mm",
         fmt::format("{} \u00d7 {} mm", decimals(1e3 * part.length, 1), decimals(1e3 * part.width, 1)),
         depth_text(part.depth), decimals(1e9 * part.volume, 1) + " mm\u00b3"},
        " class=\"number\"");
  }
  if (report.damage.size() > count) {
    out += svg_text(x, y, fmt::format("and {} more in the summary's numbers", report.damage.size() - count), "start",
                    " class=\"remark\"");
    y += kLine;
  }
  bottom = y;
  return out;
}

}  // namespace treadmark::io
