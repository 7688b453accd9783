// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/section_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/results/chart_draw.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::app::report {
namespace {

constexpr double kLeft = 70.0, kTop = 44.0, kWidth = 640.0, kBottom = 50.0;  // [px]
constexpr double kMargin = 0.004;                                            // around what is shown [m]

using Line = std::vector<std::array<double, 2>>;

/// Where the lines along the body, from station to station, pass x of the track: (y, -z) [mm]. NaN where they do not.
Line cut(const io::SampledSurface& surface, const Pose& X_TB, double x) {
  Line out;
  for (int iv = 0; iv < surface.nv; ++iv) {
    std::array<double, 2> best{NAN, NAN};
    double lowest = -INFINITY;
    for (int iu = 0; iu + 1 < surface.nu + (surface.closed ? 1 : 0); ++iu) {
      const auto point = [&](int station) {
        const std::size_t k = surface.index(station % surface.nu, iv);
        return X_TB.apply({surface.x[k], surface.y[k], surface.z[k]});
      };
      const Vec3 a = point(iu), b = point(iu + 1);
      if (!((a.x() - x) * (b.x() - x) <= 0.0) || a.x() == b.x()) continue;
      const Vec3 p = a + (x - a.x()) / (b.x() - a.x()) * (b - a);
      if (p.z() <= lowest) continue;  // the lower one of a wheel's two
      lowest = p.z();
      best = {kMilli * p.y(), -kMilli * p.z()};
    }
    out.push_back(best);
  }
  return out;
}

const io::SampledSurface* find(const std::vector<io::SampledSurface>& surfaces, const std::string& name) {
  const int index = io::surface_index(surfaces, name);
  return index < 0 ? nullptr : &surfaces[static_cast<std::size_t>(index)];
}

const io::CaseResult* most_loaded(const FrameSet& set, const io::PatchResult*& main) {
  const io::CaseResult* best = nullptr;
  for (const Frame& frame : set.frames)
    for (const io::PatchResult& patch : frame.result->patches)
      if (patch.has_reference && (main == nullptr || patch.fn > main->fn)) {
        main = &patch;
        best = frame.result.get();
      }
  return best;
}

}  // namespace

std::string section_svg(const FrameSet& set, const std::vector<io::SampledSurface>& surfaces) {
  const io::PatchResult* main = nullptr;
  const io::CaseResult* result = most_loaded(set, main);
  if (result == nullptr || !result->bodies)
    return io::svg_head(kLeft + kWidth, 60.0, io::kChartFont, io::kChartStyle) +
           io::svg_text(12.0, 34.0, "These results hold no surfaces of wheel and rail.", "start") + "</svg>\n";
  io::Chart chart;
  chart.x_label = "y [mm], to the right";
  chart.y_label = "height, -z [mm]";
  double y_low = INFINITY, y_high = -INFINITY, z_low = INFINITY, z_high = -INFINITY;
  const auto add = [&](const char* name, const std::string& surface, const Pose& X, int style, bool bounds) {
    const io::SampledSurface* sampled = find(surfaces, surface);
    if (sampled == nullptr) return;
    io::ChartSeries series;
    series.name = name;
    series.style = style;
    series.width = 2.0;
    series.curve = cut(*sampled, X, main->x_tr);
    for (const auto& [y, z] : series.curve)
      if (bounds && std::isfinite(y)) {
        y_low = std::min(y_low, y), y_high = std::max(y_high, y);
        z_low = std::min(z_low, z), z_high = std::max(z_high, z);
      }
    chart.series.push_back(std::move(series));
  };
  add("rail", result->rail_surface, result->bodies->X_TS, 0, true);
  add("wheel", result->wheel_surface, result->bodies->X_TA, 1, true);
  io::ChartSeries references;
  references.name = "contact reference";
  references.style = 4;
  references.joined = false;
  for (const io::PatchResult& patch : result->patches)
    if (patch.has_reference)
      references.points.push_back(
          {kMilli * patch.y_tr, -kMilli * patch.z_tr, 4.5, fmt::format("{:.1f} kN", 1e-3 * patch.fn), ""});
  chart.series.push_back(std::move(references));
  if (!(y_low < y_high)) y_low = -1.0, y_high = 1.0, z_low = -1.0, z_high = 1.0;
  const double margin = kMilli * kMargin;
  chart.x_range = {y_low - margin, y_high + margin};
  chart.y_range = {z_low - margin, z_high + margin};
  const double height =
      std::clamp(kWidth * (z_high - z_low + 2.0 * margin) / (y_high - y_low + 2.0 * margin), 80.0, 900.0);
  std::string out = io::svg_head(kLeft + kWidth + 180.0, kTop + height + kBottom, io::kChartFont, io::kChartStyle);
  out += io::svg_text(kLeft + 0.5 * kWidth, 22.0,
                      fmt::format("Wheel and rail at x = {:.1f} mm, case {}", kMilli * main->x_tr, result->number),
                      "middle", " class=\"title\"");
  out += io::draw_chart(chart, {kLeft, kTop, kWidth, height});
  out += io::draw_chart_legend(chart.series, kLeft + kWidth + 24.0, kTop + 10.0);
  return out + "</svg>\n";
}

}  // namespace treadmark::app::report
