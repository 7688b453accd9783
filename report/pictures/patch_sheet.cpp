// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/report/pictures/patch_picture.hpp"

namespace treadmark::pictures {
namespace {

// Sizes in pixels.
constexpr double kSheetLeft = 58.0, kSheetBottom = 44.0, kSheetLegend = 156.0, kTitleBand = 32.0, kSheetTop = 44.0;
constexpr double kGapX = 44.0, kNarrowGapX = 20.0, kGapY = 64.0;
constexpr double kLegendGap = 20.0, kLine = 18.0, kTallestBar = 240.0;
constexpr double kPictureMargin = 0.06;     // of the window, around the contact
constexpr double kPictureEqualScale = 4.0;  // windows longer than this get their own scale in each direction
constexpr double kShape = 1.7;              // wished width over height of the picture

/// Rows and columns of panels, and the size of the picture.
struct SheetLayout {
  double panel_width, panel_height, step_x, step_y, top, legend;
  int columns = 1, rows = 1;

  explicit SheetLayout(const PatchSheet& sheet)
      : panel_width(sheet.scale.width()),
        panel_height(sheet.scale.height()),
        step_x(std::max(panel_width + (sheet.y_numbers_everywhere ? kGapX : kNarrowGapX), sheet.least_step)),
        step_y(panel_height + kGapY),
        top(kSheetTop + (sheet.title.empty() ? 0.0 : kTitleBand)),
        legend(kSheetLegend) {
    for (const PatchLegend::Line& line : sheet.legend.lines)
      legend = std::max(legend, 64.0 + 5.0 * static_cast<double>(line.words.size()));
    const int count = std::max(1, static_cast<int>(sheet.panels.size()));
    double best = 0.0;
    SheetLayout trial = *this;
    for (trial.columns = 1; trial.columns <= count; ++trial.columns) {
      trial.rows = (count + trial.columns - 1) / trial.columns;
      const double empty = 1.0 - static_cast<double>(count) / (trial.columns * trial.rows);
      const double misfit = empty + std::abs(std::log(trial.width(sheet) / trial.height() / kShape));
      if (trial.columns > 1 && misfit >= best) continue;
      best = misfit;
      columns = trial.columns, rows = trial.rows;
    }
  }
  double width(const PatchSheet& sheet) const {
    return kSheetLeft + (columns - 1) * step_x + std::max(panel_width, sheet.least_step) + legend;
  }
  double height() const { return top + (rows - 1) * step_y + panel_height + kSheetBottom; }
};

}  // namespace

void place_windows(PatchSheet& sheet, double longest) {
  std::optional<Window> all;
  double width = 0.0, height = 0.0;
  for (PatchPanel& panel : sheet.panels) {
    panel.window = window_of(panel.patches);
    if (!panel.window) continue;
    width = std::max(width, panel.window->width());
    height = std::max(height, panel.window->height());
    if (all) all->include(*panel.window);
    if (!all) all = panel.window;
  }
  sheet.scale = {{-5.0, 5.0, -5.0, 5.0}, 0.1 * longest, 0.1 * longest};
  if (!all) return;
  const bool common = all->width() * all->height() <= 2.0 * width * height;
  if (common) width = all->width(), height = all->height();
  width *= 1.0 + 2.0 * kPictureMargin, height *= 1.0 + 2.0 * kPictureMargin;
  double scale_x = longest / std::max(width, height), scale_y = scale_x;
  if (std::max(width, height) > kPictureEqualScale * std::min(width, height))
    scale_x = longest / width, scale_y = longest / height;
  const auto around = [&](const Window& target) {
    const double x = 0.5 * (target.x_low + target.x_high), y = 0.5 * (target.y_low + target.y_high);
    return Window{x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height};
  };
  sheet.scale = {around(*all), scale_x, scale_y};
  for (PatchPanel& panel : sheet.panels)
    if (panel.window) panel.window = common ? sheet.scale.window : around(*panel.window);
}

PatchLegend pressure_legend(double top_pressure) {
  return {
      "pressure [MPa]",
      ColourScale{0.0, top_pressure * 1e-6},
      {{"contact", "edge of contact"}, {"adhesion", "edge of adhesion", step_colour(kPatchSteps / 2, kPatchSteps)}}};
}

std::string draw_patch_legend(const PatchLegend& legend, double height) {
  std::string out = svg_text(0.0, -7.0, legend.label, "start");
  if (legend.bar) out += draw_colour_bar(*legend.bar, {0.0, 0.0, kBarWidth, height}, kPatchSteps, legend.parts);
  double y = legend.bar ? height + kLegendGap : kLegendGap - 10.0;
  for (const PatchLegend::Line& line : legend.lines) {
    if (!line.fill.empty())
      out += fmt::format("<rect x=\"0\" y=\"{:.1f}\" width=\"14\" height=\"10\" fill=\"{}\"/>\n", y - 5.0, line.fill);
    if (!line.name.empty()) out += fmt::format("<path class=\"{}\" d=\"M0 {:.1f}h14\"/>\n", line.name, y);
    out += svg_text(20.0, y + 3.5, line.words, "start");
    y += kLine;
  }
  return out;
}

std::string draw_patch_sheet(PatchSheet sheet) {
  const SheetLayout layout(sheet);
  const double width = layout.width(sheet), height = layout.height();
  const int count = static_cast<int>(sheet.panels.size());
  std::string out = svg_head(width, height, 10, std::string(kPanelStyle) + sheet.style);
  if (std::any_of(sheet.panels.begin(), sheet.panels.end(), [](const PatchPanel& p) { return !p.over.empty(); }))
    out += fmt::format("<clipPath id=\"panel\"><rect width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n",
                       layout.panel_width, layout.panel_height);
  if (!sheet.title.empty())
    out += svg_text(0.5 * (kSheetLeft + width - layout.legend), 26.0, sheet.title, "middle",
                    " font-size=\"13px\" font-weight=\"bold\"");
  for (int i = 0; i < count; ++i) {
    PatchPanel& panel = sheet.panels[static_cast<std::size_t>(i)];
    const int column = i % layout.columns, row = i / layout.columns;
    panel.y_numbers = sheet.y_numbers_everywhere || column == 0;
    if (column == 0) panel.y_name = sheet.y_name;
    if (i + layout.columns >= count) panel.x_name = sheet.x_name;
    out += svg_group("panel", kSheetLeft + column * layout.step_x, layout.top + row * layout.step_y,
                     draw_patch_panel(panel, sheet.scale, sheet.steps));
  }
  const double below = kLegendGap + kLine * static_cast<double>(sheet.legend.lines.size());
  return out +
         svg_group("", width - layout.legend + 32.0, layout.top,
                   draw_patch_legend(sheet.legend, std::min(height - layout.top - kSheetBottom - below, kTallestBar))) +
         "</svg>\n";
}

}  // namespace treadmark::pictures
