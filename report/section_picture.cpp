// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/section_picture.hpp"
#include "treadmark/report/static_figure.hpp"

namespace treadmark::report {

namespace {

/// Where the lines along the body, from station to station, pass x of the track: (y, -z) [mm]. NaN where they do not.
pictures::Curve cut(const io::SampledSurface& surface, const Pose& X_TB, double x) {
  pictures::Curve out;
  for (int iv = 0; iv < surface.nv; ++iv) {
    pictures::Pixel best{NAN, NAN};
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
  if (result == nullptr || !result->bodies) {
    pictures::ChartSheet sheet;
    sheet.title = "These results hold no surfaces of wheel and rail.";
    return draw_sheet(sheet);
  }
  const auto curve_of = [&](const std::string& surface, const Pose& X) {
    const io::SampledSurface* sampled = find(surfaces, surface);
    return sampled == nullptr ? pictures::Curve{} : cut(*sampled, X, main->x_tr);
  };
  pictures::SectionPicture picture{
      fmt::format("Wheel and rail at x = {:.1f} mm, case {}", kMilli * main->x_tr, result->number),
      curve_of(result->rail_surface, result->bodies->X_TS),
      curve_of(result->wheel_surface, result->bodies->X_TA),
      {},
      "contact reference"};
  for (const io::PatchResult& patch : result->patches)
    if (patch.has_reference)
      picture.marks.push_back(
          {kMilli * patch.y_tr, -kMilli * patch.z_tr, 4.5, fmt::format("{:.1f} kN", 1e-3 * patch.fn)});
  return section_svg(std::move(picture));
}

std::string map_svg(const MapView& map, const std::string& title, std::size_t step) {
  pictures::ChartSheet sheet;
  sheet.title = title;
  sheet.right = 100.0, sheet.height = 260.0;
  if (map.nx < 1 || map.ny < 1) return draw_sheet(sheet);
  const std::vector<double>& shown = map.by_step.empty() ? map.values : map.by_step.at(step);
  const std::vector<float> values(shown.begin(), shown.end());
  float low = INFINITY, high = -INFINITY;
  for (const float value : values)
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  const auto colours = low <= high ? pictures::colour_scale(low, high, map.diverging) : pictures::ColourScale{};
  const auto nx = static_cast<std::size_t>(map.nx), ny = static_cast<std::size_t>(map.ny);
  pictures::Chart chart;
  chart.x_label = pictures::with_unit(map.x.label, map.x.unit);
  chart.y_label = pictures::with_unit(map.y.label, map.y.unit);
  chart.x_range = {map.x0 - 0.5 * map.dx, map.x0 + (map.nx - 0.5) * map.dx};
  chart.y_range = {map.y0 - 0.5 * map.dy, map.y0 + (map.ny - 0.5) * map.dy};
  chart.image = {small_image({values, nx, ny, 1, nx}, colours, pictures::PixelRule::any), colours,
                 pictures::with_unit(map.label, map.unit)};
  for (const MapView::Mark& mark : map.marks) {
    pictures::ChartSeries series{"", pictures::kBlack};
    series.curve = mark.points;
    series.curve_label = mark.label;
    chart.series.push_back(std::move(series));
  }
  sheet.charts = {std::move(chart)};
  return draw_sheet(sheet);
}

}  // namespace treadmark::report
