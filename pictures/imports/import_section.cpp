// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/pictures/imports/import_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr double kFarthest = 0.01;           // of the points, left out on each side where there is no curve
constexpr std::size_t kMostCompared = 1500;  // points of the section
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

bool is_finite(const Vec2& p) { return std::isfinite(p.x()) && std::isfinite(p.y()); }

/// Range of a coordinate of the points but for a part on each side.
PlotRange usual_range(const SectionPoints& points, int axis, double left_out) {
  std::vector<double> values;
  for (const Vec2& p : points)
    if (is_finite(p)) values.push_back(p[axis]);
  if (values.empty()) return {kNan, kNan};
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(left_out * static_cast<double>(values.size() - 1));
  return {values[rank], values[values.size() - 1 - rank]};
}

PlotRange joined(const PlotRange& a, const PlotRange& b) {
  if (!std::isfinite(a.low)) return b;
  if (!std::isfinite(b.low)) return a;
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace

SectionPanel place_section(const ImportReport& report, double x, double y, double most_width, double most_height,
                           double margin) {
  if (report.section.empty() && report.nominal_section.empty() && report.raw_section.empty() &&
      report.removed_section.empty())
    return {PlotFrame({x, y, most_width, 60.0}, {}, {}), true, y + 78.0};
  PlotRange ranges[2];
  for (int axis = 0; axis < 2; ++axis) {
    PlotRange& range = ranges[axis];
    range = joined(usual_range(report.section, axis, 0.0), usual_range(report.nominal_section, axis, 0.0));
    if (!std::isfinite(range.low)) range = usual_range(report.raw_section, axis, kFarthest);
    range = {1e3 * (range.low - margin), 1e3 * (range.high + margin)};
    if (!range.usable()) range = {-50.0, 50.0};
  }
  const double scale = std::min(most_width / ranges[0].length(), most_height / ranges[1].length());
  // The frame has the whole width and height; what the equal scales leave is shown as well.
  const double width = most_width,
               height = std::clamp(ranges[1].length() * scale, std::min(120.0, most_height), most_height);
  const double more[2] = {0.5 * (width / scale - ranges[0].length()), 0.5 * (height / scale - ranges[1].length())};
  for (int axis = 0; axis < 2; ++axis) ranges[axis] = {ranges[axis].low - more[axis], ranges[axis].high + more[axis]};
  return {PlotFrame({x, y, width, height}, ranges[0], ranges[1], true), false, y + height + 44.0};
}

std::string draw_section(const ImportReport& report, const SectionPanel& panel, const std::string& content,
                         const SectionPoints& counted, const std::string& kind) {
  const ChartBox& box = panel.frame.box();
  if (panel.empty)
    return panel.frame.border() +
           svg_text(box.x + 0.5 * box.width, box.y + 0.5 * box.height + 4.0, "no points and no section");
  std::string out = panel.frame.axes("y [mm]", report.body == Body::wheel ? "z = r - R [mm]" : "z [mm]") + content;
  const auto outside = static_cast<std::size_t>(
      std::count_if(counted.begin(), counted.end(), [&](const Vec2& p) { return !panel.frame.holds(1e3 * p); }));
  if (outside > 0)
    out += svg_text(
        box.x + box.width, box.y - 9.0,
        fmt::format("{} of {} {} drawn here lie beyond the frame", grouped(outside), grouped(counted.size()), kind),
        "end", " class=\"remark\"");
  return out + panel.frame.border();
}

std::vector<Vec2> in_mm(const SectionPoints& points) {
  std::vector<Vec2> out;
  out.reserve(points.size());
  for (const Vec2& p : points) out.push_back(1e3 * p);
  return out;
}

std::vector<Vec2> deviation_from_nominal(const SectionPoints& section, const SectionPoints& nominal, Body body) {
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

}  // namespace treadmark::io
