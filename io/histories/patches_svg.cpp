// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/patches_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/csv_text.hpp"
#include "treadmark/io/histories/contour_lines.hpp"
#include "treadmark/io/histories/patches_view.hpp"
#include "treadmark/io/results/chart_curve.hpp"
#include "treadmark/io/results/chart_labels.hpp"
#include "treadmark/io/results/svg_panel.hpp"
#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {
namespace {

// Sizes in pixels.
constexpr double kLongest = 230.0;  // side of a panel
constexpr double kPatchesLeft = 62.0, kPatchesTop = 76.0, kPatchesBottom = 48.0, kPatchesLegend = 190.0;
constexpr double kGapX = 20.0, kGapY = 72.0;
constexpr double kTitleWidth = 116.0;  // of the words above a panel, at least
constexpr double kTitleFont = 13.0, kTitleGap = 10.0;
constexpr double kShape = 1.7;  // wished width over height of the picture
constexpr int kMostContours = 8;
constexpr double kTickShare = 0.75;  // steps of an axis this long part the greatest depth into at most kMostContours

constexpr const char* kStyle =
    ".round{fill:none;stroke:#9b0000;stroke-width:1.6}.under{fill:none;stroke:#ffffff;stroke-width:3;stroke-opacity:."
    "75}"
    ".depth{fill:none;stroke:#8c8c8c;stroke-width:.9}.head{font-size:13px;font-weight:bold}";

struct Sheet {
  PanelScale panel;
  int columns = 1, rows = 1;
  double title_width = kTitleWidth;

  double width() const { return panel.window.width() * panel.scale_x; }
  double height() const { return panel.window.height() * panel.scale_y; }
  double step_x() const { return std::max(width() + kGapX, title_width); }
  double step_y() const { return height() + kGapY; }
  double picture_width() const {
    return kPatchesLeft + (columns - 1) * step_x() + std::max(width(), title_width) + kPatchesLegend;
  }
  double picture_height() const { return kPatchesTop + (rows - 1) * step_y() + height() + kPatchesBottom; }
};

std::string title_of(const PatchesPanel& panel) {
  return panel.title.empty() ? fmt::format("pitch {:.2f}°", panel.result->pitch * 180.0 / std::numbers::pi + 0.0)
                             : panel.title;
}

Sheet make_sheet(const Window& window, std::span<const PatchesPanel> panels) {
  const int count = static_cast<int>(panels.size());
  Sheet sheet;
  for (const PatchesPanel& panel : panels)
    sheet.title_width = std::max(sheet.title_width, text_width(title_of(panel), kTitleFont) + kTitleGap);
  const double scale = kLongest / std::max(window.width(), window.height());
  sheet.panel = {window, scale, scale};
  double best = 0.0;
  Sheet trial = sheet;
  for (trial.columns = 1; trial.columns <= std::max(1, count); ++trial.columns) {
    trial.rows = std::max(1, (count + trial.columns - 1) / trial.columns);
    const double empty = 1.0 - static_cast<double>(count) / (trial.columns * trial.rows);
    const double misfit = empty + std::abs(std::log(trial.picture_width() / trial.picture_height() / kShape));
    if (trial.columns == 1 || misfit < best) {
      best = misfit;
      sheet = trial;
    }
  }
  return sheet;
}

/// Step between lines of equal depth in all panels [mm]; 0 = none.
double contour_step(std::span<const PatchesPanel> panels) {
  double deepest = 0.0;
  for (const PatchesPanel& panel : panels)
    for (const double depth : panel.depth)
      if (std::isfinite(depth)) deepest = std::max(deepest, depth * kMilli);
  return deepest > 0.0 ? tick_step(kTickShare * deepest) : 0.0;
}

std::string draw_depth(const PatchesPanel& panel, double step_mm, const PanelScale& scale) {
  if (panel.depth.empty() || !(step_mm > 0.0)) return {};
  std::string path;
  for (int i = 0; i <= kMostContours; ++i) {
    const double level_mm = i == 0 ? 0.1 * step_mm : i * step_mm;  // the first one: the rim of the defect
    for (const ContourLine& line : contour_lines(panel.depth_grid, panel.depth, level_mm / kMilli)) {
      std::vector<Pixel> pixels;
      for (const auto& [x, y] : line)
        pixels.push_back({(y * kMilli - scale.window.x_low) * scale.scale_x,
                          (scale.window.y_high - (x - panel.x_origin) * kMilli) * scale.scale_y});
      path += curve_path(pixels);
    }
  }
  return path.empty() ? "" : fmt::format("<path class=\"depth\" d=\"{}\"/>\n", path);
}

std::string draw_round_wheel(const std::vector<PatchPicture>& patches, const PanelScale& scale) {
  std::string path;
  for (const PatchPicture& one : patches)
    path += path_at(outline({one.nx, one.ny, one.contact}), (one.x_low - scale.window.x_low) * scale.scale_x,
                    (scale.window.y_high - one.y_low) * scale.scale_y, one.dx * scale.scale_x, -one.dy * scale.scale_y);
  if (path.empty()) return {};
  return fmt::format("<path class=\"under\" d=\"{0}\"/>\n<path class=\"round\" d=\"{0}\"/>\n", path);
}

std::string draw_panel(const PatchesPanel& panel, const PatchesView& view, const Sheet& sheet, double step_mm,
                       int index, int count) {
  const double width = sheet.width(), height = sheet.height();
  const int column = index % sheet.columns, row = index / sheet.columns;
  const auto at = static_cast<std::size_t>(index);
  std::string out = fmt::format("<g class=\"panel\" transform=\"translate({:.1f} {:.1f})\">\n",
                                kPatchesLeft + column * sheet.step_x(), kPatchesTop + row * sheet.step_y());
  out += svg_text(0.5 * width, -20.0, title_of(panel), "middle", " class=\"title\"");
  out += "<g clip-path=\"url(#panel)\">\n";
  for (const PatchPicture& one : view.contact[at]) out += draw_patch(one, view.top_pressure, sheet.panel);
  out += draw_depth(panel, step_mm, sheet.panel) + draw_round_wheel(view.round_wheel[at], sheet.panel) + "</g>\n";
  if (view.contact[at].empty()) {
    std::string words(to_string(panel.result->status));
    std::replace(words.begin(), words.end(), '_', ' ');
    out += svg_text(0.5 * width, -7.0, panel.result->status == Status::ok ? "no fields" : words);
  } else {
    out += svg_text(0.5 * width, -7.0, panel.remark.empty() ? force_and_pressure(*panel.result) : panel.remark);
  }
  out += draw_panel_axes(sheet.panel, column == 0);
  if (column == 0)
    out += svg_text(-40.0, 0.5 * height, "x [mm], rolling direction up", "middle",
                    fmt::format(" transform=\"rotate(-90 -40 {:.1f})\"", 0.5 * height).c_str());
  if (index + sheet.columns >= count) out += svg_text(0.5 * width, height + 30.0, "y [mm]");
  return out + "</g>\n";
}

std::string draw_legend(const PatchesView& view, const Sheet& sheet, double step_mm, bool round) {
  const double height = std::min(sheet.picture_height() - kPatchesTop - kPatchesBottom - 84.0, 220.0);
  std::string out = fmt::format("<g class=\"legend\" transform=\"translate({:.1f} {:.1f})\">\n",
                                sheet.picture_width() - kPatchesLegend + 24.0, kPatchesTop);
  out += svg_text(0.0, -7.0, "pressure [MPa]", "start") + draw_pressure_bar(view.top_pressure, height);
  double y = height + 22.0;
  const auto line = [&](const char* name, const std::string& words) {
    if (std::string_view(name) == "adhesion")
      out += fmt::format("<rect x=\"0\" y=\"{:.1f}\" width=\"16\" height=\"8\" fill=\"{}\"/>\n", y - 4.0,
                         step_colour(kPressureSteps / 2));
    out += fmt::format("<path class=\"{}\" d=\"M0 {:.1f}h16\"/>\n", name, y);
    out += svg_text(22.0, y + 3.5, words, "start");
    y += 16.0;
  };
  line("contact", "edge of contact");
  line("adhesion", "edge of adhesion");
  if (round) line("round", "contact of a round wheel");
  if (step_mm > 0.0) line("depth", fmt::format("depth of the defect: {:.3g},", 0.1 * step_mm));
  if (step_mm > 0.0) out += svg_text(22.0, y + 0.5, fmt::format("then every {:.3g} mm", step_mm), "start");
  return out + "</g>\n";
}

bool inside(const Window& window, double x, double y) {
  return x >= window.x_low && x <= window.x_high && y >= window.y_low && y <= window.y_high;
}

}  // namespace

std::string patches_svg(std::span<const PatchesPanel> panels, const std::string& title) {
  const PatchesView view = make_patches_view(panels);
  const int count = static_cast<int>(panels.size());
  const Sheet sheet = make_sheet(view.window, panels);
  const double step_mm = contour_step(panels);
  std::string out = svg_head(sheet.picture_width(), sheet.picture_height(), 10, std::string(kPanelStyle) + kStyle);
  out += fmt::format("<clipPath id=\"panel\"><rect width=\"{:.1f}\" height=\"{:.1f}\"/></clipPath>\n", sheet.width(),
                     sheet.height());
  out +=
      svg_text(0.5 * (kPatchesLeft + sheet.picture_width() - kPatchesLegend), 26.0, title, "middle", " class=\"head\"");
  bool round = false;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    round = round || !view.round_wheel[at].empty();
    out += draw_panel(panels[at], view, sheet, step_mm, i, count);
  }
  return out + draw_legend(view, sheet, step_mm, round) + "</svg>\n";
}

std::string patches_csv(std::span<const PatchesPanel> panels) {
  const PatchesView view = make_patches_view(panels);
  std::string out = "panel,pitch_rad,kind,x_m,y_m,value\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PatchesPanel& panel = panels[i];
    const auto row = [&](const char* kind, double x, double y, double value) {
      out += fmt::format("{},{},{},{:.7g},{:.7g},{}\n", i + 1, csv_number(panel.result->pitch), kind, x, y,
                         csv_number(value));
    };
    const auto cells = [&](const std::vector<PatchPicture>& patches, const char* kind) {
      for (const PatchPicture& one : patches)
        for (int iy = 0; iy < one.ny; ++iy)
          for (int ix = 0; ix < one.nx; ++ix) {
            const auto cell = static_cast<std::size_t>(ix + one.nx * iy);
            if (one.contact[cell] != 0)
              row(kind, (one.y_low + (iy + 0.5) * one.dy) / kMilli + panel.x_origin,
                  (one.x_low + (ix + 0.5) * one.dx) / kMilli, one.pressure[cell]);
          }
    };
    cells(view.contact[i], "pressure_Pa");
    cells(view.round_wheel[i], "round_wheel_pressure_Pa");
    const Grid2& grid = panel.depth_grid;
    for (std::size_t k = 0; k < panel.depth.size(); ++k) {
      const auto width = static_cast<std::size_t>(grid.nx);
      const double x = grid.x(static_cast<int>(k % width)), y = grid.y(static_cast<int>(k / width));
      if (inside(view.window, y * kMilli, (x - panel.x_origin) * kMilli)) row("defect_depth_m", x, y, panel.depth[k]);
    }
  }
  return out;
}

void write_patches_svg(const std::filesystem::path& path, std::span<const PatchesPanel> panels,
                       const std::string& title) {
  write_text_file(path, patches_svg(panels, title));
}

void write_patches_csv(const std::filesystem::path& path, std::span<const PatchesPanel> panels) {
  write_text_file(path, patches_csv(panels));
}

}  // namespace treadmark::io
