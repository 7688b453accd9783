// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/imports/import_map.hpp"
#include "treadmark/io/imports/import_pictures.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {
namespace {

constexpr double kTimesNoise = 3.0;  // ends of the colours of residuals

/// From -3 to +3 noise levels; without a noise level as the values ask for.
MapColours residual_colours(const ImportReport& report) {
  if (!(report.noise > 0.0 && std::isfinite(report.noise))) return diverging_colours(report.residual);
  const double limit = kTimesNoise * report.noise;
  const LengthUnit unit = picture_unit(limit);
  MapColours out{-limit * unit.factor, limit * unit.factor, Palette::diverging, false, false, unit.name, unit.factor};
  if (const auto extent = map_extent(report.residual, 0.0)) {
    out.below = extent->least < -limit;
    out.above = extent->greatest > limit;
  }
  return out;
}

/// Counts as bars with the Gaussian of the noise level.
std::string draw_histogram(const ImportReport& report, const ChartBox& box) {
  const std::vector<std::size_t>& counts = report.residual_histogram;
  const double range = report.residual_range;
  std::string out = svg_text(box.x, box.y - 10.0, "Distribution of the residuals", "start", " class=\"title\"");
  double total = 0.0, top = 0.0;
  for (const std::size_t count : counts) {
    total += static_cast<double>(count);
    top = std::max(top, static_cast<double>(count));
  }
  if (!(total > 0.0) || !(range > 1e-12 && range < 1e6))
    return out + PlotFrame(box, {}, {}).border() +
           svg_text(box.x + 0.5 * box.width, box.y + 0.5 * box.height, "no residuals");
  const LengthUnit unit = picture_unit(range);
  const double half = unit.factor * range, bin = 2.0 * half / static_cast<double>(counts.size());
  const double sigma = unit.factor * report.noise;
  const bool bell = std::isfinite(sigma) && sigma > 0.0;
  const double peak = bell ? total * bin / (sigma * std::sqrt(2.0 * std::numbers::pi)) : 0.0;
  const double whole = std::max(top, std::min(peak, 2.0 * top));
  const PlotFrame frame(box, {-half, half}, {0.0, 108.0 * whole / total});
  out += frame.axes(fmt::format("measured less fitted [{}]", unit.name), "% of the points");
  std::string bars;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const double x0 = frame.px(-half + static_cast<double>(i) * bin),
                 x1 = frame.px(-half + static_cast<double>(i + 1) * bin);
    const double y = frame.py(100.0 * static_cast<double>(counts[i]) / total);
    bars += fmt::format("M{:.1f} {:.1f}V{:.1f}H{:.1f}V{:.1f}z", x0, box.y + box.height, y, x1, box.y + box.height);
  }
  out += fmt::format("<path class=\"bars\" fill=\"#9fb8cc\" stroke=\"#6d8aa3\" stroke-width=\".5\" d=\"{}\"/>\n", bars);
  if (bell) {
    std::vector<Vec2> curve;
    for (int i = 0; i <= 240; ++i) {
      const double x = half * (i / 120.0 - 1.0);
      curve.push_back({x, 100.0 / total * peak * std::exp(-0.5 * (x / sigma) * (x / sigma))});
    }
    out += frame.curve(curve, kRemovedColour, 1.6);
  }
  return out + frame.border();
}

std::string draw_numbers(const ImportReport& report, double x, double y) {
  std::string out = svg_text(x, y - 10.0, "Fit in numbers", "start", " class=\"title\"");
  y += 12.0;
  const auto row = [&](const std::string& name, const std::string& value) {
    out += svg_text(x, y, name, "start") + svg_text(x + 330.0, y, value, "end");
    y += 20.0;
  };
  const auto length = [](double metres) { return length_text(metres, "\u00b5"); };
  row("noise of the points (standard deviation)", length(report.noise));
  row("points fitted", grouped(report.fitted_points));
  row("residuals, rms", length(report.residual_rms));
  row("residuals, largest", length(report.residual_max));
  row("points held out of the fit", grouped(report.held_out_points));
  row("residuals of these, rms", length(report.held_out_rms));
  row("error of the surface they tell of", length(report.held_out_error));
  return out;
}

}  // namespace

std::string import_residual_svg(const ImportReport& report) {
  double y = kPictureTop + 20.0;
  const MapPanel residual = place_map(report, report.residual, y);
  std::string out = draw_map(report, report.residual, residual_colours(report), residual,
                             report.noise > 0.0 ? "Mean of measured less fitted, colours from -3 to +3 times the noise"
                                                : "Mean of measured less fitted",
                             PixelRule::any);
  const MapPanel noise = place_map(report, report.noise_map, residual.bottom + 24.0);
  const auto extent = map_extent(report.noise_map, 1e-3);
  const LengthUnit unit = picture_unit(extent ? extent->high : 1.0);
  out += draw_map(report, report.noise_map, sequential_colours(report.noise_map, unit.name, unit.factor), noise,
                  "Noise: standard deviation of the points", PixelRule::any);
  y = noise.bottom + 34.0;
  out += draw_histogram(report, {kPlotLeft, y + 14.0, 460.0, 190.0});
  const std::vector<PlotKey> keys{{PlotKey::Kind::line, kRemovedColour, "normal distribution of the noise"}};
  if (report.noise > 0.0) out += draw_keys(keys, kPlotLeft + 220.0, y);
  out += draw_numbers(report, kPlotLeft + 540.0, y + 14.0);
  return svg_head(kPictureWidth, y + 14.0 + 190.0 + 50.0, 12, kImportStyle) + hole_pattern() +
         picture_heading("Residuals", import_heading(report)) + out + "</svg>\n";
}

}  // namespace treadmark::io
