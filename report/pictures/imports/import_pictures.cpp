// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/imports/import_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "treadmark/core/output_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/imports/import_maps.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/report/pictures/imports/import_map.hpp"
#include "treadmark/report/pictures/imports/import_section.hpp"

namespace treadmark::pictures {

namespace {

using io::grouped, io::shortened;

constexpr std::size_t kMostBars = 16;
constexpr const char* kAllColour = "#b9bdc4";

/// Sections have their series as keys, and say what lies beyond the frame.
ImportPanel with_series(ImportPanel panel, std::vector<ChartSeries> series, std::size_t counted, const char* kind) {
  if (const std::string title = beyond(panel, series[counted], kind); !title.empty()) panel.title = title;
  panel.keys = panel.chart.series = std::move(series);
  return panel;
}

/// A bar a reason on a logarithmic axis from 1, with count and part of all points in its row's name.
ImportPanel removed_bars(const io::ImportReport& report) {
  ImportPanel out{"Removed points by reason", {}, 480.0, 30.0};
  const std::size_t count = std::min(report.removed.size(), kMostBars);
  out.chart.nothing = count == 0 ? "nothing was looked for" : "";
  if (report.removed.size() > count)
    out.remark = fmt::format("{} more reasons in the summary", report.removed.size() - count);
  std::vector<ChartShape> bars;
  double most = 10.0;
  for (std::size_t i = 0; i < count; ++i) {
    const io::ImportReport::Removed& removed = report.removed[i];
    const double points = static_cast<double>(removed.count), row = static_cast<double>(i);
    most = std::max(most, points);
    bars.push_back({1.0, std::max(1.0, points), row - 0.33, row + 0.33, {}, removed.reason + ": " + removed.why});
    out.chart.y_names.push_back(shortened(removed.reason, 32) + "   " +
                                (removed.count == 0 ? "none"
                                                    : fmt::format("{} ({})", grouped(removed.count),
                                                                  io::percent(removed.count, report.points_read))));
  }
  out.height = std::max(30.0, 21.0 * static_cast<double>(count));
  out.indent = 360.0;
  out.chart.x_scale = AxisScale::log;
  out.chart.x_range = {1.0, std::pow(10.0, std::ceil(std::log10(most) - 1e-9))};
  out.chart.x_label = "points removed (logarithmic)";
  if (count > 0)
    out.chart.series = {shape_series("", fmt::format("class=\"bar\" fill=\"{}\"", kRemovedColour), bars, 2.0)};
  return out;
}

}  // namespace

std::string import_heading(const io::ImportReport& report) {
  std::string out = report.inputs.empty() ? "no input" : shortened(report.inputs.front().file, 60);
  if (report.inputs.size() > 1) out += fmt::format(" and {} more", report.inputs.size() - 1);
  out += fmt::format(", {}", body_name(report.body));
  out += report.from_map ? ", a map of deviations" : fmt::format(", {} points", grouped(report.points_read));
  out += fmt::format(", unit {}", report.unit.empty() ? "unknown" : shortened(report.unit, 20));
  return report.unit_from.empty() ? out : out + fmt::format(" ({})", shortened(report.unit_from, 40));
}

std::string import_before_svg(const io::ImportReport& report) {
  ImportPicture picture("Scan before cleaning");
  picture.add(with_series(section_panel(report, "All points, seen along the axis"),
                          {dot_series("points as read", kRawColour, in_mm(report.raw_section), 1.7),
                           line_series("fitted section", kSectionColour, in_mm(report.section)),
                           line_series("nominal profile " + shortened(report.nominal, 40), kNominalColour,
                                       in_mm(report.nominal_section), 1.4, "6 3")},
                          0, "points"));
  picture.add(map_panel(report, report.density, sequential_colours(report.density, "1/mm\u00b2", 1e-6),
                        "Points per mm\u00b2 over the unrolled band, before cleaning", PixelRule::any));
  return picture.finish(report);
}

std::string import_removed_svg(const io::ImportReport& report) {
  ImportPicture picture("What was removed");
  picture.add(with_series(section_panel(report, "Removed points, seen along the axis"),
                          {dot_series("all points", kAllColour, in_mm(report.raw_section), 1.5),
                           dot_series("removed", kRemovedColour, in_mm(report.removed_section), 2.2)},
                          1, "removed points"));
  picture.add(removed_bars(report));
  picture.add(map_panel(report, report.removed_map,
                        sequential_colours(report.removed_map, "1/mm\u00b2", 1e-6, Palette::from_white),
                        "Removed points per mm\u00b2 over the unrolled band", PixelRule::any));
  const std::size_t kept = report.points_used;
  return picture.finish(
      report,
      report.from_map ? "" : fmt::format("; {} used ({})", grouped(kept), io::percent(kept, report.points_read)));
}

namespace {

constexpr double kTimesNoise = 3.0;  // ends of the colours of residuals

/// From -3 to +3 noise levels; without a noise level as the values ask for.
ColourScale residual_colours(const io::ImportReport& report) {
  if (!(report.noise > 0.0 && std::isfinite(report.noise))) return diverging_colours(report.residual);
  const double limit = kTimesNoise * report.noise;
  const io::PictureUnit unit = io::picture_unit(limit);
  ColourScale out{-limit * unit.factor, limit * unit.factor, Palette::diverging, false, false, unit.name, unit.factor};
  if (const auto extent = map_extent(report.residual, 0.0)) {
    out.below = extent->least < -limit;
    out.above = extent->greatest > limit;
  }
  return out;
}

/// Counts as bars with the Gaussian of the noise level.
ImportPanel histogram(const io::ImportReport& report) {
  ImportPanel out{"Distribution of the residuals", {}, 460.0, 190.0};
  out.chart.nothing = "no residuals";
  const std::vector<std::size_t>& counts = report.residual_histogram;
  const double range = report.residual_range;
  double total = 0.0, top = 0.0;
  for (const std::size_t count : counts) {
    total += static_cast<double>(count);
    top = std::max(top, static_cast<double>(count));
  }
  if (!(total > 0.0) || !(range > 1e-12 && range < 1e6)) return out;
  const io::PictureUnit unit = io::picture_unit(range);
  const double half = unit.factor * range, bin = 2.0 * half / static_cast<double>(counts.size());
  const double sigma = unit.factor * report.noise;
  const bool bell = std::isfinite(sigma) && sigma > 0.0;
  const double peak = bell ? total * bin / (sigma * std::sqrt(2.0 * std::numbers::pi)) : 0.0;
  out.chart.x_range = {-half, half};
  out.chart.y_range = {0.0, 108.0 * std::max(top, std::min(peak, 2.0 * top)) / total};
  out.chart.x_label = fmt::format("measured less fitted [{}]", unit.name);
  out.chart.y_label = "% of the points";
  std::vector<ChartShape> bars;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (const double x = -half + static_cast<double>(i) * bin; counts[i] > 0)
      bars.push_back({x, x + bin, 0.0, 100.0 * static_cast<double>(counts[i]) / total});
  constexpr const char* kLook = "class=\"bars\" fill=\"#9fb8cc\" stroke=\"#6d8aa3\" stroke-width=\".5\"";
  out.chart.series = {shape_series("", kLook, std::move(bars))};
  if (!bell) return out;
  Curve curve;
  for (int i = 0; i <= 240; ++i) {
    const double x = half * (i / 120.0 - 1.0);
    curve.push_back({x, 100.0 / total * peak * std::exp(-0.5 * (x / sigma) * (x / sigma))});
  }
  out.chart.series.push_back(line_series("normal distribution of the noise", kRemovedColour, std::move(curve)));
  out.keys = {out.chart.series.back()};
  return out;
}

}  // namespace

std::string import_residual_svg(const io::ImportReport& report) {
  ImportPicture picture("Residuals");
  picture.add(map_panel(report, report.residual, residual_colours(report),
                        report.noise > 0.0 ? "Mean of measured less fitted, colours from -3 to +3 times the noise"
                                           : "Mean of measured less fitted",
                        PixelRule::any));
  const auto extent = map_extent(report.noise_map, 1e-3);
  const io::PictureUnit unit = io::picture_unit(extent ? extent->high : 1.0);
  picture.add(map_panel(report, report.noise_map, sequential_colours(report.noise_map, unit.name, unit.factor),
                        "Noise: standard deviation of the points", PixelRule::any));
  picture.add(histogram(report));
  picture.beside();
  const auto length = [](double metres) { return io::length_text(metres, "\u00b5"); };
  picture.add_table("Fit in numbers", kPlotLeft + 540.0, {0.0, 330.0},
                    {{"noise of the points (standard deviation)", length(report.noise)},
                     {"points fitted", grouped(report.fitted_points)},
                     {"residuals, rms", length(report.residual_rms)},
                     {"residuals, largest", length(report.residual_max)},
                     {"points held out of the fit", grouped(report.held_out_points)},
                     {"residuals of these, rms", length(report.held_out_rms)},
                     {"error of the surface", io::surface_error_text(report, "\u00b5")}});
  return picture.finish(report);
}

void write_import_report(const std::string& folder, const io::ImportReport& report) {
  const std::filesystem::path place(folder);
  write_file(place / "before.svg", import_before_svg(report));
  write_file(place / "removed.svg", import_removed_svg(report));
  write_file(place / "fitted.svg", import_fitted_svg(report));
  write_file(place / "residual.svg", import_residual_svg(report));
  if (has_part("hdf5")) io::write_import_maps(place / "maps.h5", report);
  write_file(place / "settings.toml", report.settings_toml);
  write_file(place / "summary.txt", io::import_summary(report));
  write_file(place / "times.json", io::import_times_json(report));
  write_file(place / "report.json", io::import_json(report, false));
  if (report.track) write_import_report((place / kLeftRail).string(), *report.track->left);
}

}  // namespace treadmark::pictures
