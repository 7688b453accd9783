// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/pictures/imports/import_fitted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/pictures/imports/import_pictures.hpp"
#include "treadmark/pictures/imports/import_section.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {

namespace {

constexpr double kHalf = 400.0;  // width of a panel beside another [px]
constexpr double kRight = kPlotLeft + kHalf + 96.0;
constexpr double kNearLeft = 760.0;

/// The lowest cell of a map, of a map that is nowhere below 0 the highest.
std::optional<std::size_t> deepest_cell(const BandMap& map) {
  std::optional<std::size_t> low, high;
  for (std::size_t i = 0; is_drawable(map) && i < map.value.size(); ++i) {
    const float v = map.value[i];
    if (!std::isfinite(v)) continue;
    if (!low || v < map.value[*low]) low = i;
    if (!high || v > map.value[*high]) high = i;
  }
  return low && map.value[*low] >= 0.0f ? high : low;
}

/// Round range around values, 0 included.
PlotRange range_of(const std::vector<Vec2>& points) {
  double low = 0.0, high = 0.0;
  for (const Vec2& p : points)
    if (std::isfinite(p.y())) {
      low = std::min(low, p.y());
      high = std::max(high, p.y());
    }
  const double margin = 0.08 * (high - low);
  return high > low ? PlotRange{low - margin, high + margin} : PlotRange{-1.0, 1.0};
}

/// The fitted distance along a through the deepest cell.
struct Course {
  std::vector<Vec2> points;  ///< a [mm], distance [unit]
  std::size_t deepest = 0;
  double s = 0.0;  ///< [m]
  LengthUnit unit;
};

std::optional<Course> course_of(const BandMap& map) {
  const std::optional<std::size_t> cell = deepest_cell(map);
  if (!cell) return {};
  Course out;
  const std::size_t column = *cell % map.columns;
  const double step = (map.a_max - map.a_min) / static_cast<double>(map.rows);
  out.deepest = *cell / map.columns;
  out.unit = picture_unit(map.value[*cell]);
  out.s = map.s_min + (static_cast<double>(column) + 0.5) / static_cast<double>(map.columns) * (map.s_max - map.s_min);
  for (std::size_t row = 0; row < map.rows; ++row)
    out.points.push_back({1e3 * (map.a_min + (static_cast<double>(row) + 0.5) * step),
                          out.unit.factor * static_cast<double>(map.value[row * map.columns + column])});
  return out;
}

/// Grid, zero, threshold, and the course with its deepest place.
std::string draw_curve(const Course& course, const PlotFrame& frame, const std::string& x_name,
                       const std::string& y_name, double threshold) {
  std::string out = frame.axes(x_name, y_name) + frame.level(0.0, "none");
  if (threshold > 0.0) out += frame.level(-course.unit.factor * threshold);
  out += frame.curve(course.points, kNominalColour, 1.4);
  const Vec2& deepest = course.points[course.deepest];
  if (frame.holds(deepest))
    out += fmt::format(
        "<circle class=\"deepest\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"none\" stroke=\"{}\" "
        "stroke-width=\"1.5\"/>\n",
        frame.px(deepest.x()), frame.py(deepest.y()), kRemovedColour);
  return out + frame.border();
}

/// Under the map and with its axis of a.
std::string draw_course(const ImportReport& report, const std::optional<Course>& course, const MapPanel& panel,
                        double y, double& bottom) {
  const ChartBox box{panel.frame.box().x, y + 12.0, panel.frame.box().width, 130.0};
  bottom = box.y + box.height + 44.0;
  const std::string title = "Distance along a through the deepest place";
  if (!course)
    return svg_text(box.x, y, title, "start", " class=\"title\"") + PlotFrame(box, {}, {}).border() +
           svg_text(box.x + 0.5 * box.width, y + 80.0, "no values");
  std::string heading = fmt::format("{}, s = {} mm", title, decimals(1e3 * course->s, 1));
  if (report.damage_threshold > 0.0) heading += "; dashed: deeper is damage";
  const PlotFrame frame(box, panel.frame.x(), range_of(course->points));
  return svg_text(box.x, y, heading, "start", " class=\"title\"") +
         draw_curve(*course, frame,
                    report.body == Body::wheel ? "along the circumference [mm]" : "x along the track [mm]",
                    fmt::format("distance [{}]", course->unit.name), report.damage_threshold);
}

/// The same near the deepest place, beside the table of damage: as far as the largest damage is long to each side.
std::string draw_near(const ImportReport& report, const Course& course, double y, double& bottom) {
  const double length = report.damage.empty() ? 0.0 : report.damage.front().length;
  const double reach = length > 0.0 && length < 10.0 ? std::max(1e3 * length, 10.0) : 50.0;
  const double middle = course.points[course.deepest].x();
  Course near = course;
  std::vector<Vec2> shown;
  for (Vec2& p : near.points) {
    p.x() -= middle;
    if (std::abs(p.x()) <= reach) shown.push_back(p);
  }
  const PlotFrame frame({kNearLeft, y + 12.0, kPictureWidth - 24.0 - kNearLeft, 120.0}, {-reach, reach},
                        range_of(shown));
  bottom = y + 12.0 + 120.0 + 40.0;
  return svg_text(kNearLeft, y, fmt::format("The deepest place [{}]", course.unit.name), "start", " class=\"title\"") +
         draw_curve(near, frame, "along a from there [mm]", "", report.damage_threshold);
}

/// Section and nominal profile to the left, their distance over y to the right.
std::string draw_profiles(const ImportReport& report, double y, double& bottom) {
  std::string out = svg_text(kPlotLeft, y, "Section", "start", " class=\"title\"");
  const SectionPanel section = place_section(report, kPlotLeft, y + 26.0, kHalf, 190.0, 4e-3);
  std::vector<PlotKey> keys{{PlotKey::Kind::line, kSectionColour, "fitted"}};
  if (!report.nominal_section.empty())
    keys.push_back({PlotKey::Kind::dashes, kNominalColour, "nominal " + shortened(report.nominal, 30)});
  out += draw_keys(keys, kPlotLeft, y + 13.0);
  const PlotFrame& frame = section.frame;
  out += draw_section(report, section,
                      frame.curve(in_mm(report.section), kSectionColour, 1.6) +
                          frame.curve(in_mm(report.nominal_section), kNominalColour, 1.4, " stroke-dasharray=\"6 3\""));

  std::vector<Vec2> deviation = deviation_from_nominal(report.section, report.nominal_section, report.body);
  double greatest = 0.0;
  for (const Vec2& p : deviation) greatest = std::max(greatest, std::abs(p.y()));
  const LengthUnit unit = picture_unit(greatest);
  for (Vec2& p : deviation) p = {1e3 * p.x(), unit.factor * p.y()};
  const PlotFrame chart({kRight, frame.box().y, kHalf, frame.box().height}, frame.x(), range_of(deviation));
  out += svg_text(kRight, y, "Section less nominal profile", "start", " class=\"title\"");
  out += svg_text(kRight, y + 17.0, "along the profile's normal; above 0: out of the material", "start",
                  " class=\"remark\"");
  if (deviation.empty()) {
    out += svg_text(kRight + 0.5 * kHalf, frame.box().y + 0.5 * frame.box().height, "no nominal profile");
  } else {
    out += chart.axes("y [mm]", fmt::format("distance [{}]", unit.name));
    out += chart.level(0.0, "none") + chart.curve(deviation, kNominalColour, 1.4);
  }
  bottom = section.bottom;
  return out + chart.border();
}

}  // namespace

std::string import_fitted_svg(const ImportReport& report) {
  const MapPanel panel = place_map(report, report.fitted, kPictureTop + 20.0);
  std::string out =
      draw_map(report, report.fitted, diverging_colours(report.fitted), panel,
               "Distance of the fitted surface from its section; above 0: out of the material", PixelRule::half);
  out += draw_marks(report, panel);
  const std::vector<PlotKey> keys{{PlotKey::Kind::hatch, "#8c8c8c", "no surface: holes that stay open"},
                                  {PlotKey::Kind::box, "#7a1fa2", "holes (circles; filled ones dashed)"},
                                  {PlotKey::Kind::box, "#111111", "damage: number and depth"}};
  double y = panel.bottom + 6.0;
  out += draw_keys(keys, kPlotLeft, y);
  const std::optional<Course> course = course_of(report.fitted);
  out += draw_course(report, course, panel, y + 36.0, y);
  out += draw_profiles(report, y + 24.0, y);
  const double top = y + 24.0;
  out += draw_damage_table(report, kPlotLeft, top, y);
  if (double bottom = 0.0; course) {
    out += draw_near(report, *course, top, bottom);
    y = std::max(y, bottom);
  }
  return svg_head(kPictureWidth, y + 12.0, 12, kImportStyle) + hole_pattern() +
         picture_heading("Fitted surface", import_heading(report)) + out + "</svg>\n";
}

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
