// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/pictures/histories/patches_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/pictures/chart_axis.hpp"
#include "treadmark/pictures/chart_marks.hpp"
#include "treadmark/pictures/svg_text.hpp"

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

namespace {

constexpr double kMargin = 0.08;  // of the window, around the contact

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
  turn(picture.pressure, out.pressure);
  turn(picture.contact, out.contact);
  turn(picture.adhesion, out.adhesion);
  return out;
}

std::vector<PatchPicture> pictures(const CaseResult* result, double x_origin_mm) {
  std::vector<PatchPicture> out;
  if (result == nullptr) return out;
  int number = 0;
  for (const PatchResult& patch : result->patches) {
    check_field_sizes(patch.fields, result->number, ++number);
    PatchPicture picture = turned(make_patch_picture(patch.fields), x_origin_mm);
    if (picture.nx > 0) out.push_back(std::move(picture));
  }
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
    view.contact.push_back(pictures(panel.result, panel.x_origin * kMilli));
    view.round_wheel.push_back(pictures(panel.round_wheel, panel.x_origin * kMilli));
    for (const PatchPicture& one : view.contact.back())
      view.top_pressure = std::max(view.top_pressure, *std::max_element(one.pressure.begin(), one.pressure.end()));
    for (const auto* list : {&view.contact.back(), &view.round_wheel.back()})
      for (const PatchPicture& one : *list) {
        if (all) all->include(one.extent());
        if (!all) all = one.extent();
      }
  }
  if (!all) return view;
  const double margin = kMargin * std::max(all->width(), all->height());
  view.window = {all->x_low - margin, all->x_high + margin, all->y_low - margin, all->y_high + margin};
  return view;
}

namespace {

/// Side of cells from point (ix, iy) to the next one in x or y.
using Side = std::size_t;

class Sides {
 public:
  Sides(const Grid2& grid, std::span<const double> values, double level)
      : grid_(grid), values_(values), level_(level) {}

  bool above(int ix, int iy) const { return value(ix, iy) >= level_; }
  double value(int ix, int iy) const { return values_[grid_.index(ix, iy)]; }
  Side along_x(int ix, int iy) const { return 2 * grid_.index(ix, iy); }
  Side along_y(int ix, int iy) const { return 2 * grid_.index(ix, iy) + 1; }

  /// Where the level is reached on a side.
  std::array<double, 2> point(Side side) const {
    const int from = static_cast<int>(side / 2), ix = from % grid_.nx, iy = from / grid_.nx;
    const bool y = side % 2 != 0;
    const double first = value(ix, iy), second = y ? value(ix, iy + 1) : value(ix + 1, iy);
    const double part = (level_ - first) / (second - first);
    return {grid_.x(ix) + (y ? 0.0 : part * grid_.dx), grid_.y(iy) + (y ? part * grid_.dy : 0.0)};
  }

  /// Adds the pieces of a line in a cell, each from side to side.
  void pieces(int ix, int iy, std::vector<std::array<Side, 2>>& out) const {
    const double sum = value(ix, iy) + value(ix + 1, iy) + value(ix + 1, iy + 1) + value(ix, iy + 1);
    if (!std::isfinite(sum)) return;
    // Corners counterclockwise from the lower left; side k runs from corner k to the next.
    const std::array<bool, 4> high{above(ix, iy), above(ix + 1, iy), above(ix + 1, iy + 1), above(ix, iy + 1)};
    const std::array<Side, 4> sides{along_x(ix, iy), along_y(ix + 1, iy), along_x(ix, iy + 1), along_y(ix, iy)};
    std::vector<Side> crossed;
    for (std::size_t k = 0; k < 4; ++k)
      if (high[k] != high[(k + 1) % 4]) crossed.push_back(sides[k]);
    if (crossed.size() == 2) out.push_back({crossed[0], crossed[1]});
    if (crossed.size() != 4) return;
    if ((sum >= 4.0 * level_) == high[0]) {  // corners 0 and 2 belong together: lines around 1 and 3
      out.push_back({crossed[0], crossed[1]});
      out.push_back({crossed[2], crossed[3]});
    } else {
      out.push_back({crossed[3], crossed[0]});
      out.push_back({crossed[1], crossed[2]});
    }
  }

 private:
  const Grid2& grid_;
  std::span<const double> values_;
  double level_;
};

/// Pieces joined at common sides: each side belongs to at most two.
class Joiner {
 public:
  explicit Joiner(const std::vector<std::array<Side, 2>>& pieces) {
    for (const auto& [a, b] : pieces) {
      neighbours_[a].push_back(b);
      neighbours_[b].push_back(a);
    }
  }

  /// Open lines from their ends, then closed ones.
  std::vector<std::vector<Side>> lines() {
    std::vector<std::vector<Side>> out;
    for (const std::size_t degree : {1u, 2u})
      for (auto& [side, others] : neighbours_)
        while (others.size() == degree) out.push_back(follow(side));
    return out;
  }

 private:
  std::vector<Side> follow(Side side) {
    std::vector<Side> line{side};
    while (!neighbours_[side].empty()) {
      const Side next = neighbours_[side].back();
      neighbours_[side].pop_back();
      std::erase(neighbours_[next], side);
      line.push_back(next);
      side = next;
    }
    return line;
  }

  std::map<Side, std::vector<Side>> neighbours_;  // in order: the same lines in every run
};

}  // namespace

std::vector<ContourLine> contour_lines(const Grid2& grid, std::span<const double> values, double level) {
  if (values.size() != grid.size())
    throw Error(ErrorKind::configuration, fmt::format("{} values on a grid of {} points", values.size(), grid.size()));
  const Sides sides(grid, values, level);
  std::vector<std::array<Side, 2>> pieces;
  for (int iy = 0; iy + 1 < grid.ny; ++iy)
    for (int ix = 0; ix + 1 < grid.nx; ++ix) sides.pieces(ix, iy, pieces);
  std::vector<ContourLine> out;
  for (const auto& line : Joiner(pieces).lines()) {
    out.emplace_back();
    for (const Side side : line) out.back().push_back(sides.point(side));
  }
  return out;
}

}  // namespace treadmark::io
