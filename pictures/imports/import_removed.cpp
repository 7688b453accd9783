// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/pictures/imports/import_map.hpp"
#include "treadmark/pictures/imports/import_pictures.hpp"
#include "treadmark/pictures/imports/import_section.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {

namespace {

constexpr double kBarLine = 21.0, kBarLeft = 300.0, kRemovedBarWidth = 470.0;  // [px]
constexpr std::size_t kMostBars = 16;

/// A bar a reason on a logarithmic axis from 1, with count and part of all points to its right.
std::string draw_bars(const ImportReport& report, double y, double& bottom) {
  const std::size_t count = std::min(report.removed.size(), kMostBars);
  std::size_t most = 10;
  for (const ImportReport::Removed& removed : report.removed) most = std::max(most, removed.count);
  const double decades = std::ceil(std::log10(static_cast<double>(most)) - 1e-9);
  const double height = kBarLine * static_cast<double>(std::max<std::size_t>(count, 1)) + 6.0;
  std::string out;
  for (int k = 0; k <= static_cast<int>(decades); ++k) {
    const double x = kBarLeft + kRemovedBarWidth * k / decades;
    out += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>\n", x, y, height);
    out += svg_text(x, y + height + 16.0,
                    k < 8 ? grouped(static_cast<std::size_t>(std::llround(std::pow(10.0, k)))) : fmt::format("1e{}", k),
                    "middle", " class=\"number\"");
  }
  out += svg_text(kBarLeft + 0.5 * kRemovedBarWidth, y + height + 33.0, "points removed (logarithmic)");
  for (std::size_t i = 0; i < count; ++i) {
    const ImportReport::Removed& removed = report.removed[i];
    const double middle = y + 3.0 + (static_cast<double>(i) + 0.5) * kBarLine;
    const double width =
        removed.count == 0 ? 0.0
                           : std::max(2.0, kRemovedBarWidth * std::log10(static_cast<double>(removed.count)) / decades);
    out += fmt::format("<g class=\"reason\"><title>{}</title>\n", xml_text(removed.reason + ": " + removed.why));
    out += svg_text(kBarLeft - 10.0, middle + 4.0, shortened(removed.reason, 40), "end");
    out += fmt::format("<rect class=\"bar\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"14\" fill=\"{}\"/>\n",
                       kBarLeft, middle - 7.0, width, kRemovedColour);
    out += svg_text(kBarLeft + kRemovedBarWidth + 12.0, middle + 4.0,
                    removed.count == 0
                        ? "none"
                        : fmt::format("{}  ({})", grouped(removed.count), percent(removed.count, report.points_read)),
                    "start");
    out += "</g>\n";
  }
  if (count == 0) out += svg_text(kBarLeft + 0.5 * kRemovedBarWidth, y + 0.5 * height + 4.0, "nothing was looked for");
  out +=
      fmt::format("<path class=\"tick\" d=\"M{:.1f} {:.1f}v{:.1f}h{:.1f}\"/>\n", kBarLeft, y, height, kRemovedBarWidth);
  bottom = y + height + 44.0;
  if (report.removed.size() > count)
    out += svg_text(kBarLeft - 10.0, y + height + 16.0,
                    fmt::format("{} more reasons in the summary", report.removed.size() - count), "end",
                    " class=\"remark\"");
  return out;
}

}  // namespace

std::string import_removed_svg(const ImportReport& report) {
  std::string out;
  double y = kPictureTop + 20.0;
  out += svg_text(kPlotLeft, y, "Removed points, seen along the axis", "start", " class=\"title\"");
  const std::vector<PlotKey> keys{{PlotKey::Kind::dot, kRemovedColour, "removed"},
                                  {PlotKey::Kind::dot, "#b9bdc4", "all points"}};
  out += draw_keys(keys, kPlotLeft, y + 13.0);
  const SectionPanel section =
      place_section(report, kPlotLeft, y + 26.0, kPictureWidth - kPlotLeft - 24.0, 360.0, 10e-3);
  const PlotFrame& frame = section.frame;
  out += draw_section(report, section,
                      frame.dots(in_mm(report.raw_section), "#b9bdc4", 1.5) +
                          frame.dots(in_mm(report.removed_section), kRemovedColour, 2.2),
                      report.removed_section, "removed points");

  y = section.bottom + 24.0;
  out += svg_text(kPlotLeft, y, "Removed points by reason", "start", " class=\"title\"");
  double bottom = 0.0;
  out += draw_bars(report, y + 14.0, bottom);

  const MapPanel map = place_map(report, report.removed_map, bottom + 24.0);
  out += draw_map(report, report.removed_map,
                  sequential_colours(report.removed_map, "1/mm\u00b2", 1e-6, Palette::from_white), map,
                  "Removed points per mm\u00b2 over the unrolled band", PixelRule::any);
  const std::size_t kept = report.points_used;
  return svg_head(kPictureWidth, map.bottom + 8.0, 12, kImportStyle) + hole_pattern() +
         picture_heading("What was removed",
                         report.from_map ? import_heading(report)
                                         : import_heading(report) + fmt::format("; {} used ({})", grouped(kept),
                                                                                percent(kept, report.points_read))) +
         out + "</svg>\n";
}

std::string import_heading(const ImportReport& report) {
  std::string out = report.inputs.empty() ? "no input" : shortened(report.inputs.front().file, 60);
  if (report.inputs.size() > 1) out += fmt::format(" and {} more", report.inputs.size() - 1);
  out += fmt::format(", {}", body_name(report.body));
  out += report.from_map ? ", a map of deviations" : fmt::format(", {} points", grouped(report.points_read));
  out += fmt::format(", unit {}", report.unit.empty() ? "unknown" : shortened(report.unit, 20));
  return report.unit_from.empty() ? out : out + fmt::format(" ({})", shortened(report.unit_from, 40));
}

std::string import_before_svg(const ImportReport& report) {
  std::string out;
  double y = kPictureTop + 20.0;
  const SectionPanel section =
      place_section(report, kPlotLeft, y + 26.0, kPictureWidth - kPlotLeft - 24.0, 360.0, 10e-3);
  out += svg_text(kPlotLeft, y, "All points, seen along the axis", "start", " class=\"title\"");
  std::vector<PlotKey> keys{{PlotKey::Kind::dot, kRawColour, "points as read"}};
  if (!report.nominal_section.empty())
    keys.push_back({PlotKey::Kind::dashes, kNominalColour, "nominal profile " + shortened(report.nominal, 40)});
  if (!report.section.empty()) keys.push_back({PlotKey::Kind::line, kSectionColour, "fitted section"});
  out += draw_keys(keys, kPlotLeft, y + 13.0);
  const PlotFrame& frame = section.frame;
  out += draw_section(report, section,
                      frame.dots(in_mm(report.raw_section), kRawColour, 1.7) +
                          frame.curve(in_mm(report.section), kSectionColour, 1.6) +
                          frame.curve(in_mm(report.nominal_section), kNominalColour, 1.4, " stroke-dasharray=\"6 3\""),
                      report.raw_section, "points");
  y = section.bottom + 24.0;

  const MapPanel map = place_map(report, report.density, y);
  out += draw_map(report, report.density, sequential_colours(report.density, "1/mm\u00b2", 1e-6), map,
                  "Points per mm\u00b2 over the unrolled band, before cleaning", PixelRule::any);
  return svg_head(kPictureWidth, map.bottom + 8.0, 12, kImportStyle) + hole_pattern() +
         picture_heading("Scan before cleaning", import_heading(report)) + out + "</svg>\n";
}

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
