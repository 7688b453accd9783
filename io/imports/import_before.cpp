// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include "treadmark/io/imports/import_map.hpp"
#include "treadmark/io/imports/import_pictures.hpp"
#include "treadmark/io/imports/import_section.hpp"
#include "treadmark/io/imports/import_words.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {

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

}  // namespace treadmark::io
