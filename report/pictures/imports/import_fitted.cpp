// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/tables/shown.hpp"
#include "treadmark/report/pictures/imports/import_map.hpp"
#include "treadmark/report/pictures/imports/import_pictures.hpp"
#include "treadmark/report/pictures/imports/import_section.hpp"

namespace treadmark::pictures {

namespace {

constexpr double kHalf = 400.0, kSecondLeft = kPlotLeft + kHalf + 96.0, kNearLeft = 760.0;  // [px]
constexpr std::size_t kMostHoles = 300, kMostDamage = 8;

/// The lowest cell of a map, of a map that is nowhere below 0 the highest.
std::optional<std::size_t> deepest_cell(const io::BandMap& map) {
  std::optional<std::size_t> low, high;
  for (std::size_t i = 0; is_drawable(map) && i < map.value.size(); ++i) {
    const float v = map.value[i];
    if (!std::isfinite(v)) continue;
    if (!low || v < map.value[*low]) low = i;
    if (!high || v > map.value[*high]) high = i;
  }
  return low && map.value[*low] >= 0.0f ? high : low;
}

/// Range around values, 0 included, with some room.
AxisRange range_of_y(const Curve& points) {
  double low = 0.0, high = 0.0;
  for (const auto& p : points)
    if (std::isfinite(p[1])) low = std::min(low, p[1]), high = std::max(high, p[1]);
  const double margin = 0.08 * (high - low);
  return high > low ? AxisRange{low - margin, high + margin} : AxisRange{-1.0, 1.0};
}

/// The fitted distance along a through the deepest cell.
struct Course {
  Curve points;  ///< a [mm], distance [unit]
  std::size_t deepest = 0;
  double s = 0.0;  ///< [m]
  io::PictureUnit unit;
};

std::optional<Course> course_of(const io::BandMap& map) {
  const std::optional<std::size_t> cell = deepest_cell(map);
  if (!cell) return {};
  Course out;
  const std::size_t column = *cell % map.columns;
  const double step = (map.a_max - map.a_min) / static_cast<double>(map.rows);
  out.deepest = *cell / map.columns;
  out.unit = io::picture_unit(map.value[*cell]);
  out.s = map.s_min + (static_cast<double>(column) + 0.5) / static_cast<double>(map.columns) * (map.s_max - map.s_min);
  for (std::size_t row = 0; row < map.rows; ++row)
    out.points.push_back({1e3 * (map.a_min + (static_cast<double>(row) + 0.5) * step),
                          out.unit.factor * static_cast<double>(map.value[row * map.columns + column])});
  return out;
}

/// A curve with its zero.
Chart distance_chart(Curve curve, const AxisRange& x, const std::string& x_label, const std::string& unit) {
  Chart out;
  out.x_range = x, out.y_range = range_of_y(curve);
  out.x_label = x_label;
  if (!unit.empty()) out.y_label = fmt::format("distance [{}]", unit);
  out.series = {line_series("", "#444444", {{x[0], 0.0}, {x[1], 0.0}}, 0.8),
                line_series("", kNominalColour, std::move(curve), 1.4)};
  return out;
}

/// Threshold of damage and the deepest place.
void mark_deepest(Chart& chart, const io::ImportReport& report, const Course& course, double x) {
  const double level = -course.unit.factor * report.damage_threshold;
  if (level < 0.0)
    chart.series.push_back(
        line_series("", "#444444", {{(*chart.x_range)[0], level}, {(*chart.x_range)[1], level}}, 0.8, "4 3"));
  ChartSeries place;
  place.colour = kRemovedColour;
  place.points = {{x, course.points[course.deepest][1], 3.5}};
  chart.series.push_back(std::move(place));
}

ImportPanel course_panel(const io::ImportReport& report, const std::optional<Course>& course, const ImportPanel& map) {
  ImportPanel out{"Distance along a through the deepest place", {}, map.width};
  if (!course) return out;
  out.title += fmt::format(", s = {} mm", io::shown_number(1e3 * course->s, 1));
  if (report.damage_threshold > 0.0) out.title += "; dashed: deeper is damage";
  out.chart = distance_chart(course->points, *map.chart.x_range,
                             report.body == Body::wheel ? "along the circumference [mm]" : "x along the track [mm]",
                             course->unit.name);
  mark_deepest(out.chart, report, *course, course->points[course->deepest][0]);
  return out;
}

/// The same near the deepest place: as far as the largest damage is long to each side.
ImportPanel near_panel(const io::ImportReport& report, const Course& course) {
  const double length = report.damage.empty() ? 0.0 : report.damage.front().length;
  const double reach = length > 0.0 && length < 10.0 ? std::max(1e3 * length, 10.0) : 50.0;
  const double middle = course.points[course.deepest][0];
  Curve shown;
  for (const auto& [a, distance] : course.points)
    if (std::abs(a - middle) <= reach) shown.push_back({a - middle, distance});
  ImportPanel out{fmt::format("The deepest place [{}]", course.unit.name), {}, 216.0, 120.0};
  out.chart = distance_chart(std::move(shown), {-reach, reach}, "along a from there [mm]", "");
  mark_deepest(out.chart, report, course, 0.0);
  return out;
}

ImportPanel profiles_panel(const io::ImportReport& report) {
  ImportPanel out = section_panel(report, "Section", {kHalf, 190.0, 4e-3});
  out.chart.series = {line_series("fitted", kSectionColour, in_mm(report.section)),
                      line_series("nominal " + io::shortened(report.nominal, 30), kNominalColour,
                                  in_mm(report.nominal_section), 1.4, "6 3")};
  out.keys = out.chart.series;
  return out;
}

/// Distance of section and nominal profile over y.
ImportPanel deviation_panel(const io::ImportReport& report, const ImportPanel& section) {
  ImportPanel out{"Section less nominal profile", {}, kHalf, section.height};
  out.remark = "along the profile's normal; above 0: out of the material";
  out.chart.nothing = "no nominal profile";
  const std::vector<Vec2> deviation = deviation_from_nominal(report.section, report.nominal_section, report.body);
  if (deviation.empty()) return out;
  double greatest = 0.0;
  for (const Vec2& p : deviation) greatest = std::max(greatest, std::abs(p.y()));
  const io::PictureUnit unit = io::picture_unit(greatest);
  Curve curve;
  for (const Vec2& p : deviation) curve.push_back({1e3 * p.x(), unit.factor * p.y()});
  out.chart =
      distance_chart(std::move(curve), section.chart.x_range.value_or(AxisRange{-50.0, 50.0}), "y [mm]", unit.name);
  return out;
}

std::string depth_text(double depth) {
  return depth < 0.0 ? io::length_text(-depth, "\u00b5") + " high" : io::length_text(depth, "\u00b5");
}

/// Adds a mark in the map [mm]; twice where it crosses the seam of a whole wheel, the text at the first.
void add_mark(std::vector<ChartShape>& out, const io::ImportReport& report, const io::ImportReport::Hole& mark,
              double length, double width, std::string label = {}) {
  const io::BandMap& map = report.fitted;
  const bool wheel = report.body == Body::wheel;
  double s = mark.s, a = wheel ? mark.u * report.nominal_radius : mark.u;
  if (!std::isfinite(s)) s = s_of_y(report.section, map.s_min, map.s_max, mark.y);
  if (!(std::isfinite(s + a + length + width) && std::abs(length + width) < 1e3)) return;
  const double round = 2.0 * std::numbers::pi * report.nominal_radius;
  const bool whole = wheel && report.closed && round > 0.0;
  if (whole) a -= round * std::floor((a - map.a_min) / round);
  for (const double turn : {0.0, -round, round}) {
    const double low = a + turn - 0.5 * length, high = a + turn + 0.5 * length;
    if ((turn != 0.0 && !whole) || high < map.a_min || low > map.a_max) continue;
    out.push_back({1e3 * low, 1e3 * high, 1e3 * (s - 0.5 * width), 1e3 * (s + 0.5 * width), std::move(label)});
    label.clear();
  }
}

/// Outlines of the holes and, numbered and with their depths, rectangles of the damage on the fitted map.
std::vector<ChartSeries> marks(const io::ImportReport& report) {
  std::vector<ChartShape> open, filled, damage;
  for (std::size_t i = 0; i < std::min(report.holes.size(), kMostHoles); ++i)
    if (const auto& hole = report.holes[i]; hole.diameter > 0.0)
      add_mark(hole.filled ? filled : open, report, hole, hole.diameter, hole.diameter);
  for (std::size_t i = 0; i < std::min(report.damage.size(), kMostDamage); ++i) {
    const auto& part = report.damage[i];
    io::ImportReport::Hole place;
    place.u = part.u, place.y = part.y, place.s = part.s;
    if (part.length >= 0.0 && part.width >= 0.0)
      add_mark(damage, report, place, part.length, part.width, fmt::format("{}: {}", i + 1, depth_text(part.depth)));
  }
  const std::string hole = "class=\"hole\" fill=\"none\" stroke=\"#7a1fa2\"";
  std::vector<ChartSeries> out{
      shape_series("no surface: holes that stay open", "fill=\"url(#holes)\" stroke=\"#8c8c8c\"", {}),
      shape_series("open holes", hole, std::move(open), 2.0),
      shape_series("filled holes", hole + " stroke-dasharray=\"2 2\"", std::move(filled), 2.0),
      shape_series("damage: number and depth", "class=\"damage\" fill=\"none\" stroke=\"#111111\" stroke-width=\"1.3\"",
                   std::move(damage), 1.0)};
  out[1].ellipses = out[2].ellipses = true;
  return out;
}

/// A line each for the largest damage, their numbers as on the map.
void add_damage_table(ImportPicture& picture, const io::ImportReport& report) {
  const std::size_t count = std::min(report.damage.size(), kMostDamage), more = report.damage.size() - count;
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < count; ++i) {
    const io::ImportReport::Damage& part = report.damage[i];
    if (i == 0)
      rows.push_back({"", report.body == Body::wheel ? "at angle" : "at x", "y", "length \u00d7 width", "deepest",
                      "missing volume"});
    rows.push_back(
        {std::to_string(i + 1), io::place_text(report, part.u, "\u00b0"), io::shown_number(1e3 * part.y, 1) + " mm",
         fmt::format("{} \u00d7 {} mm", io::shown_number(1e3 * part.length, 1), io::shown_number(1e3 * part.width, 1)),
         depth_text(part.depth), io::shown_number(1e9 * part.volume, 1) + " mm\u00b3"});
  }
  const std::string what =
      report.damage_threshold > 0.0 ? "Damage beyond " + io::length_text(report.damage_threshold, "\u00b5") : "Damage";
  picture.add_table(what + ", largest first", kPlotLeft, {12.0, 120.0, 205.0, 360.0, 460.0, 585.0}, rows,
                    count == 0 ? "none"
                    : more > 0 ? fmt::format("and {} more in the summary's numbers", more)
                               : "");
}

}  // namespace

std::string import_fitted_svg(const io::ImportReport& report) {
  ImportPicture picture("Fitted surface");
  ImportPanel map =
      map_panel(report, report.fitted, diverging_colours(report.fitted),
                "Distance of the fitted surface from its section; above 0: out of the material", PixelRule::half);
  if (map.chart.image) map.keys = map.chart.series = marks(report);
  const std::optional<Course> course = course_of(report.fitted);
  const ImportPanel below = course_panel(report, course, map), section = profiles_panel(report);
  picture.add(std::move(map));
  picture.add(below);
  picture.add(section);
  picture.beside();
  picture.add(deviation_panel(report, section), kSecondLeft);
  add_damage_table(picture, report);
  picture.beside();
  if (course) picture.add(near_panel(report, *course), kNearLeft);
  return picture.finish(report);
}

}  // namespace treadmark::pictures
