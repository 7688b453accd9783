// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/imports/import_map.hpp"
#include "treadmark/io/imports/import_pictures.hpp"
#include "treadmark/io/imports/import_section.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/results/svg_text.hpp"

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

}  // namespace treadmark::io
