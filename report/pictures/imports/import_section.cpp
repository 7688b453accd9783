// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/imports/import_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/report/pictures/imports/import_map.hpp"

namespace treadmark::pictures {
namespace {

using io::SectionPoints;

constexpr double kFarthest = 0.01;           // of the points, left out on each side where there is no curve
constexpr std::size_t kMostCompared = 1500;  // points of the section
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_finite(const Vec2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); }

/// Range of a coordinate of the points but for a part on each side.
AxisRange usual_range(const SectionPoints& points, int axis, double left_out) {
  std::vector<double> values;
  for (const Vec2& p : points)
    if (is_finite(p)) values.push_back(p[axis]);
  if (values.empty()) return {kNan, kNan};
  std::sort(values.begin(), values.end());
  const auto rank = to_whole<std::size_t>(left_out * static_cast<double>(values.size() - 1));
  return {values[rank], values[values.size() - 1 - rank]};
}

}  // namespace

ImportPanel section_panel(const io::ImportReport& report, const std::string& title, const SectionSize& size) {
  ImportPanel out{title, {}, size.width, 60.0};
  out.chart.nothing = "no points and no section";
  if (report.section.empty() && report.nominal_section.empty() && report.raw_section.empty() &&
      report.removed_section.empty())
    return out;
  AxisRange ranges[2];
  for (int axis = 0; axis < 2; ++axis) {
    AxisRange& range = ranges[axis];
    const AxisRange nominal = usual_range(report.nominal_section, axis, 0.0);
    range = usual_range(report.section, axis, 0.0);
    range = {std::fmin(range[0], nominal[0]), std::fmax(range[1], nominal[1])};
    if (!std::isfinite(range[0])) range = usual_range(report.raw_section, axis, kFarthest);
    range = {1e3 * (range[0] - size.margin), 1e3 * (range[1] + size.margin)};
    if (!is_usable(range)) range = {-50.0, 50.0};
  }
  const double length[2] = {ranges[0][1] - ranges[0][0], ranges[1][1] - ranges[1][0]};
  const double scale = std::min(size.width / length[0], size.most_height / length[1]);
  // The frame has the whole width and height; what the equal scales leave is shown as well.
  out.height = std::clamp(length[1] * scale, std::min(120.0, size.most_height), size.most_height);
  const double more[2] = {0.5 * (size.width / scale - length[0]), 0.5 * (out.height / scale - length[1])};
  out.chart.x_range = {ranges[0][0] - more[0], ranges[0][1] + more[0]};
  out.chart.y_range = {ranges[1][0] - more[1], ranges[1][1] + more[1]};
  out.chart.y_down = true;
  out.chart.x_label = "y [mm]";
  out.chart.y_label = report.body == Body::wheel ? "z = r - R [mm]" : "z [mm]";
  return out;
}

std::string beyond(const ImportPanel& panel, const ChartSeries& series, const std::string& kind) {
  if (!panel.chart.x_range) return {};
  const auto outside = std::count_if(series.dots.begin(), series.dots.end(), [&](const auto& p) {
    const AxisRange &x = *panel.chart.x_range, &y = *panel.chart.y_range;
    return !(p[0] >= x[0] && p[0] <= x[1] && p[1] >= y[0] && p[1] <= y[1]);
  });
  return outside == 0
             ? ""
             : fmt::format("{} ({} of {} {} beyond the frame)", panel.title,
                           io::grouped(static_cast<std::size_t>(outside)), io::grouped(series.dots.size()), kind);
}

std::vector<Vec2> deviation_from_nominal(const io::SectionPoints& section, const io::SectionPoints& nominal,
                                         Body body) {
  SectionPoints line;
  std::copy_if(nominal.begin(), nominal.end(), std::back_inserter(line), is_finite);
  std::vector<Vec2> out;
  if (line.size() < 2) return out;
  // A rail runs with increasing y and a wheel with decreasing y; then (t_z, -t_y) points out of the material.
  const bool grows = line.back().x() > line.front().x();
  const double side = grows == (body == Body::rail) ? 1.0 : -1.0;
  const std::size_t stride = 1 + section.size() / kMostCompared;
  for (std::size_t i = 0; i < section.size(); i += stride) {
    const Vec2& p = section[i];
    if (!is_finite(p)) continue;
    double nearest = std::numeric_limits<double>::infinity(), deviation = 0.0;
    bool beyond = false;
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      const Vec2 edge = line[k + 1] - line[k], to = p - line[k];
      const double length2 = edge.squaredNorm();
      if (!(length2 > 0.0)) continue;
      const double at = to.dot(edge) / length2, inside = std::clamp(at, 0.0, 1.0);
      const Vec2 offset = to - inside * edge;
      const double distance = offset.norm();
      if (!(distance < nearest)) continue;
      nearest = distance;
      beyond = (k == 0 && at < 0.0) || (k + 2 == line.size() && at > 1.0);
      deviation = std::copysign(distance, side * (offset.x() * edge.y() - offset.y() * edge.x()));
    }
    if (std::isfinite(nearest) && !beyond) out.push_back({p.x(), deviation});
  }
  return out;
}

double s_of_y(const SectionPoints& section, double s_min, double s_max, double y) {
  double whole = 0.0, before = kNan;
  for (std::size_t i = 0; i + 1 < section.size(); ++i) {
    const Vec2 &a = section[i], &b = section[i + 1];
    if (!is_finite(a) || !is_finite(b)) continue;
    const double length = (b - a).norm();
    if (std::isnan(before) && (a.x() - y) * (b.x() - y) <= 0.0 && a.x() != b.x())
      before = whole + length * (y - a.x()) / (b.x() - a.x());
    whole += length;
  }
  return whole > 0.0 ? s_min + (s_max - s_min) * before / whole : kNan;
}

}  // namespace treadmark::pictures
