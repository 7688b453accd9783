// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/import_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/app/report/html_text.hpp"
#include "treadmark/app/report/pages/page_parts.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/pictures/imports/import_map.hpp"

namespace treadmark::app::report {
namespace {

constexpr std::size_t kMostAlong = 1000, kMostAcross = 160;  // cells of a map in a page
constexpr std::size_t kMostHoles = 300, kMostDamage = 30;

using Points = std::vector<std::array<double, 2>>;

/// Mean of the known values of a block of cells.
double mean(const io::BandMap& map, std::size_t row0, std::size_t row1, std::size_t column0, std::size_t column1) {
  double sum = 0.0, count = 0.0;
  for (std::size_t row = row0; row < row1; ++row)
    for (std::size_t column = column0; column < column1; ++column)
      if (const float value = map.value[row * map.columns + column]; std::isfinite(value)) {
        sum += value;
        count += 1.0;
      }
  return count > 0.0 ? sum / count : std::nan("");
}

/// Greatest size that is shown; infinite where no few values stand far out.
double limit_of(const io::BandMap& map) {
  constexpr double kFew = 1e-3, kFar = 3.0;
  const auto extent = pictures::map_extent(map, kFew);
  if (!extent) return INFINITY;
  const double greatest = std::max(-extent->least, extent->greatest), usual = std::max(-extent->low, extent->high);
  return usual > 0.0 && greatest > kFar * usual ? usual : INFINITY;
}

/// A mark that crosses the seam of a whole wheel stands at both ends.
void add_mark(std::vector<MapView::Mark>& marks, const Points& points, const std::string& label, const io::BandMap& map,
              double round_mm) {
  const double low = kMilli * map.a_min, high = kMilli * map.a_max;
  for (const double turn : {0.0, -round_mm, round_mm}) {
    if (turn != 0.0 && round_mm == 0.0) continue;
    MapView::Mark mark{label, {}};
    bool inside = false;
    for (const auto& [a, s] : points) {
      inside = inside || (a + turn > low && a + turn < high);
      mark.points.push_back({std::clamp(a + turn, low, high), std::clamp(s, kMilli * map.s_min, kMilli * map.s_max)});
    }
    if (inside) marks.push_back(std::move(mark));
  }
}

Points ellipse(double a, double s, double diameter) {
  constexpr int kCorners = 32;
  Points out;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kCorners;
    out.push_back({a + 0.5 * diameter * std::cos(angle), s + 0.5 * diameter * std::sin(angle)});
  }
  return out;
}

Points rectangle(double a, double s, double length, double width) {
  const double l = 0.5 * length, w = 0.5 * width;
  return {{a - l, s - w}, {a + l, s - w}, {a + l, s + w}, {a - l, s + w}, {a - l, s - w}};
}

}  // namespace

std::vector<MapView::Mark> import_marks(const io::ImportReport& report) {
  std::vector<MapView::Mark> marks;
  const io::BandMap& map = report.fitted;
  if (!pictures::is_drawable(map)) return marks;
  const bool wheel = report.body == Body::wheel;
  const double round_mm = wheel && report.closed ? 2.0 * kPi * kMilli * report.nominal_radius : 0.0;
  const auto mm = [](double length) { return in_file(kMilli * length); };
  const auto along = [&](double u) {
    return wheel ? kPi / 180.0 * in_file(180.0 / kPi * u) * kMilli * report.nominal_radius : mm(u);
  };
  for (std::size_t i = 0; i < std::min(report.holes.size(), kMostHoles); ++i) {
    const auto& hole = report.holes[i];
    const double a = along(hole.u), s = mm(hole.s), diameter = mm(hole.diameter);
    if (std::isfinite(a + s) && diameter > 0.0)
      add_mark(marks, ellipse(a, s, diameter), hole.filled ? "" : fmt::format("open, {} mm", shown({diameter, 2})), map,
               round_mm);
  }
  for (std::size_t i = 0; i < std::min(report.damage.size(), kMostDamage); ++i) {
    const auto& damage = report.damage[i];
    const double a = along(damage.u), s = mm(damage.s), length = mm(damage.length), width = mm(damage.width),
                 depth = mm(damage.depth);
    if (std::isfinite(a + s + length + width))
      add_mark(marks, rectangle(a, s, length, width),
               fmt::format("{}: {} mm {}", i + 1, shown({std::fabs(depth), 3}), depth < 0.0 ? "high" : "deep"), map,
               round_mm);
  }
  return marks;
}

std::pair<std::string, double> length_unit_of(const io::BandMap& map) {
  constexpr double kSmall = 0.2e-3;  // [m]
  const auto extent = pictures::map_extent(map, 1e-3);
  if (extent && std::max(-extent->low, extent->high) >= kSmall) return {"mm", 1e3};
  return {"µm", 1e6};
}

std::vector<Block> map_figure(const io::BandMap& map, Body body, MapFigure what, std::vector<MapView::Mark> marks) {
  if (!pictures::is_drawable(map)) return {};
  MapView view;
  view.x = {body == Body::wheel ? "along the circumference" : "along the track", "mm"};
  view.y = {"along the section", "mm"};
  view.label = what.label;
  view.unit = what.unit;
  view.diverging = what.diverging;
  const std::size_t nx = std::min(map.rows, kMostAlong), ny = std::min(map.columns, kMostAcross);
  view.nx = static_cast<int>(nx);
  view.ny = static_cast<int>(ny);
  view.dx = kMilli * (map.a_max - map.a_min) / static_cast<double>(nx);
  view.dy = kMilli * (map.s_max - map.s_min) / static_cast<double>(ny);
  view.x0 = kMilli * map.a_min + 0.5 * view.dx;
  view.y0 = kMilli * map.s_min + 0.5 * view.dy;
  const double limit = limit_of(map);
  bool limited = false;
  for (std::size_t iy = 0; iy < ny; ++iy)
    for (std::size_t ix = 0; ix < nx; ++ix) {
      double value =
          mean(map, ix * map.rows / nx, (ix + 1) * map.rows / nx, iy * map.columns / ny, (iy + 1) * map.columns / ny);
      if (std::fabs(value) > limit) {
        value = std::copysign(limit, value);
        limited = true;
      }
      view.values.push_back(what.factor * value);
    }
  if (std::ranges::none_of(view.values, [](double value) { return std::isfinite(value); })) return {};
  view.marks = std::move(marks);
  const auto add_note = [&](const std::string& words) { what.note += (what.note.empty() ? "" : " ") + words; };
  if (nx < map.rows || ny < map.columns)
    add_note(fmt::format("Means over {:.2g} mm x {:.2g} mm; maps.h5 has {} x {} cells.", view.dx, view.dy, map.rows,
                         map.columns));
  if (limited)
    add_note(fmt::format("Values of more than {} {} are shown as that.", shown({what.factor * limit, 3}), what.unit));
  return {Figure{what.id, what.title, std::move(view), std::move(what.note)}};
}

ChartView residual_chart(const io::ImportReport& report) {
  ChartView view;
  const std::vector<double> counts(report.residual_histogram.begin(), report.residual_histogram.end());
  const double range = 1e3 * in_file(kMilli * report.residual_range);  // [µm]
  if (counts.empty() || !(range > 0.0)) return view;
  Axis axis{"measured less fitted", "µm"};
  const double width = 2.0 * range / static_cast<double>(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i)
    axis.values.push_back(-range + (static_cast<double>(i) + 0.5) * width);
  view.x = std::move(axis);
  view.panels = {{"points", "", false, {{"points", counts}}, {}}};
  return view;
}

}  // namespace treadmark::app::report
