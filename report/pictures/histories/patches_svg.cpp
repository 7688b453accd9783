// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/report/pictures/histories/patches_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/outline.hpp"

namespace treadmark::pictures {

namespace {

constexpr double kLongest = 230.0;                       // side of a panel [px]
constexpr double kTitleWidth = 116.0, kNameRoom = 10.0;  // of the words above a panel, at least [px]
constexpr double kNameFont = 13.0;                       // a little more than that of the style: it is bold
constexpr int kMostContours = 8;
constexpr double kTickShare = 0.75;  // steps of an axis this long part the greatest depth into at most kMostContours

constexpr const char* kStyle =
    ".round{fill:none;stroke:#9b0000;stroke-width:1.6}.under{fill:none;stroke:#ffffff;stroke-width:3;stroke-opacity:."
    "75}"
    ".depth{fill:none;stroke:#8c8c8c;stroke-width:.9}";

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
      for (const auto& [x, y] : line) pixels.push_back({scale.x(y * kMilli), scale.y((x - panel.x_origin) * kMilli)});
      path += curve_path(pixels);
    }
  }
  return path.empty() ? "" : fmt::format("<path class=\"depth\" d=\"{}\"/>\n", path);
}

std::string draw_round_wheel(const std::vector<PatchPicture>& patches, const PanelScale& scale) {
  std::string path;
  for (const PatchPicture& one : patches) path += contact_path(one, scale);
  if (path.empty()) return {};
  return fmt::format("<path class=\"under\" d=\"{0}\"/>\n<path class=\"round\" d=\"{0}\"/>\n", path);
}

bool inside(const Window& window, double x, double y) {
  return x >= window.x_low && x <= window.x_high && y >= window.y_low && y <= window.y_high;
}

}  // namespace

std::string patches_svg(std::span<const PatchesPanel> panels, const std::string& title) {
  const PatchesView view = make_patches_view(panels);
  const double step_mm = contour_step(panels);
  const double scale = kLongest / std::max(view.window.width(), view.window.height());
  PatchSheet sheet{title, {}, {view.window, scale, scale}, colour_steps({0.0, view.top_pressure})};
  sheet.legend = pressure_legend(view.top_pressure);
  sheet.x_name = "y [mm]", sheet.y_name = "x [mm], rolling direction up";
  sheet.y_numbers_everywhere = false;
  sheet.least_step = kTitleWidth;
  sheet.style = kStyle;
  bool round = false;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const io::CaseResult& result = *panels[i].result;
    PatchPanel& panel = sheet.panels.emplace_back();
    panel.patches = view.contact[i];
    panel.titles = {panels[i].title.empty() ? pitch_text(result) : panels[i].title};
    panel.remark = panel.patches.empty()      ? reason_without_patches(result)
                   : panels[i].remark.empty() ? force_and_pressure(result)
                                              : panels[i].remark;
    panel.over = draw_depth(panels[i], step_mm, sheet.scale) + draw_round_wheel(view.round_wheel[i], sheet.scale);
    sheet.least_step = std::max(sheet.least_step, text_width(panel.titles.front(), kNameFont) + kNameRoom);
    round = round || !view.round_wheel[i].empty();
  }
  if (round) sheet.legend.lines.push_back({"round", "contact of a round wheel"});
  if (step_mm > 0.0) {
    sheet.legend.lines.push_back({"depth", fmt::format("depth of the defect: {:.3g},", 0.1 * step_mm)});
    sheet.legend.lines.push_back({"", fmt::format("then every {:.3g} mm", step_mm)});
  }
  return draw_patch_sheet(std::move(sheet));
}

std::string patches_csv(std::span<const PatchesPanel> panels) {
  const PatchesView view = make_patches_view(panels);
  std::string out = "panel,pitch_rad,kind,x_m,y_m,value\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PatchesPanel& panel = panels[i];
    const auto row = [&](const char* kind, double x, double y, double value) {
      out += fmt::format("{},{},{},{:.7g},{:.7g},{}\n", i + 1, io::csv_number(panel.result->pitch), kind, x, y,
                         io::csv_number(value));
    };
    const auto cells = [&](const std::vector<PatchPicture>& patches, const char* kind) {
      for (const PatchPicture& one : patches)
        for (int iy = 0; iy < one.ny; ++iy)
          for (int ix = 0; ix < one.nx; ++ix) {
            const auto cell = static_cast<std::size_t>(ix + one.nx * iy);
            if (one.contact[cell] != 0)
              row(kind, (one.y_low + (iy + 0.5) * one.dy) / kMilli + panel.x_origin,
                  (one.x_low + (ix + 0.5) * one.dx) / kMilli, one.values[cell]);
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

namespace {

constexpr double kPatchesMargin = 0.08;  // of the window, around the contact

/// The picture with rows and columns exchanged.
PatchPicture turned(const PatchPicture& picture, double x_origin_mm) {
  PatchPicture out;
  out.nx = picture.ny;
  out.ny = picture.nx;
  out.dx = picture.dy;
  out.dy = picture.dx;
  out.x_low = picture.y_low;
  out.y_low = picture.x_low - x_origin_mm;
  const auto turn = [&](const auto& from, auto& to) {
    to.resize(from.size());
    const auto width = static_cast<std::size_t>(picture.nx), height = static_cast<std::size_t>(picture.ny);
    for (std::size_t iy = 0; iy < height; ++iy)
      for (std::size_t ix = 0; ix < width; ++ix) to[iy + height * ix] = from[ix + width * iy];
  };
  turn(picture.values, out.values);
  turn(picture.contact, out.contact);
  turn(picture.adhesion, out.adhesion);
  return out;
}

std::vector<PatchPicture> turned_pictures(const io::CaseResult* result, double x_origin_mm) {
  std::vector<PatchPicture> out;
  if (result != nullptr)
    for (const PatchPicture& picture : patch_pictures(*result)) out.push_back(turned(picture, x_origin_mm));
  return out;
}

}  // namespace

PatchesView make_patches_view(std::span<const PatchesPanel> panels) {
  PatchesView view;
  std::optional<Window> all;
  for (const PatchesPanel& panel : panels) {
    const auto number = &panel - panels.data() + 1;
    if (panel.result == nullptr) throw Error(ErrorKind::configuration, fmt::format("panel {} has no result", number));
    if (!panel.depth.empty() && panel.depth.size() != panel.depth_grid.size())
      throw Error(ErrorKind::configuration, fmt::format("panel {}: {} depths on a grid of {} points", number,
                                                        panel.depth.size(), panel.depth_grid.size()));
    view.contact.push_back(turned_pictures(panel.result, panel.x_origin * kMilli));
    view.round_wheel.push_back(turned_pictures(panel.round_wheel, panel.x_origin * kMilli));
    for (const PatchPicture& one : view.contact.back()) view.top_pressure = std::max(view.top_pressure, one.greatest());
    for (const auto& list : {view.contact.back(), view.round_wheel.back()})
      if (const auto window = window_of(list)) {
        if (all) all->include(*window);
        if (!all) all = window;
      }
  }
  if (!all) return view;
  const double margin = kPatchesMargin * std::max(all->width(), all->height());
  view.window = {all->x_low - margin, all->x_high + margin, all->y_low - margin, all->y_high + margin};
  return view;
}

}  // namespace treadmark::pictures
