// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/pictures/picture_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "treadmark/io/files/atomic_file.hpp"
#include "treadmark/io/results/field_table.hpp"
#include "treadmark/pictures/picture_patch.hpp"
#include "treadmark/pictures/svg_text.hpp"

namespace treadmark::io {
namespace {

// Sizes in pixels.
constexpr double kPicturePanel = 170.0;  // longest side of a panel
constexpr double kGapX = 44.0, kGapY = 64.0, kPictureLeft = 58.0, kPictureTop = 44.0, kPictureBottom = 44.0,
                 kLegend = 156.0;
constexpr double kPictureMargin = 0.06;     // of the window, around the contact
constexpr double kPictureEqualScale = 4.0;  // windows longer than this get their own scale in each direction
constexpr double kShape = 1.7;              // wished width over height of the picture

struct CasePicture {
  const CaseResult* result = nullptr;
  std::vector<PatchPicture> patches;
  Window extent;
  bool contact = false;
};

CasePicture make_case_picture(const CaseResult& result) {
  CasePicture picture{&result, {}, {}, false};
  int number = 0;
  for (const PatchResult& patch : result.patches) {
    check_field_sizes(patch.fields, result.number, ++number);
    PatchPicture shown = make_patch_picture(patch.fields);
    if (shown.nx == 0) continue;
    if (picture.contact)
      picture.extent.include(shown.extent());
    else
      picture.extent = shown.extent();
    picture.contact = true;
    picture.patches.push_back(std::move(shown));
  }
  return picture;
}

/// The windows of all cases have one size; one place too if that does not make them much larger.
struct PictureLayout {
  double width = 10.0, height = 10.0;     ///< of a window [mm]
  double scale_x = 17.0, scale_y = 17.0;  ///< [px/mm]
  bool common = false;
  Window all;
  int columns = 1, rows = 1;

  double panel_width() const { return width * scale_x; }
  double panel_height() const { return height * scale_y; }
  double picture_width() const { return kPictureLeft + columns * panel_width() + (columns - 1) * kGapX + kLegend; }
  double picture_height() const { return kPictureTop + rows * panel_height() + (rows - 1) * kGapY + kPictureBottom; }

  Window window(const CasePicture& picture) const {
    const Window& target = common || !picture.contact ? all : picture.extent;
    const double x = 0.5 * (target.x_low + target.x_high), y = 0.5 * (target.y_low + target.y_high);
    return {x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height};
  }
};

PictureLayout make_layout(const std::vector<CasePicture>& cases) {
  PictureLayout layout;
  bool any = false;
  double width = 0.0, height = 0.0;
  for (const CasePicture& picture : cases) {
    if (!picture.contact) continue;
    width = std::max(width, picture.extent.width());
    height = std::max(height, picture.extent.height());
    if (any)
      layout.all.include(picture.extent);
    else
      layout.all = picture.extent;
    any = true;
  }
  if (any) {
    layout.common = layout.all.width() * layout.all.height() <= 2.0 * width * height;
    if (layout.common) {
      width = layout.all.width();
      height = layout.all.height();
    }
    layout.width = width * (1.0 + 2.0 * kPictureMargin);
    layout.height = height * (1.0 + 2.0 * kPictureMargin);
    layout.scale_x = layout.scale_y = kPicturePanel / std::max(layout.width, layout.height);
    if (std::max(layout.width, layout.height) > kPictureEqualScale * std::min(layout.width, layout.height)) {
      layout.scale_x = kPicturePanel / layout.width;
      layout.scale_y = kPicturePanel / layout.height;
    }
  }
  const int count = std::max(1, static_cast<int>(cases.size()));
  double best = 0.0;
  for (int columns = 1; columns <= count; ++columns) {
    PictureLayout trial = layout;
    trial.columns = columns;
    trial.rows = (count + columns - 1) / columns;
    const double empty = 1.0 - static_cast<double>(count) / (trial.columns * trial.rows);
    const double misfit = empty + std::abs(std::log(trial.picture_width() / trial.picture_height() / kShape));
    if (columns == 1 || misfit < best) {
      best = misfit;
      layout.columns = trial.columns;
      layout.rows = trial.rows;
    }
  }
  return layout;
}

/// Wheelsets that stand at several places along the track, all with the same pitch, are told apart by their places.
bool differ_in_place(const std::vector<CaseResult>& cases) {
  const CaseResult* first = nullptr;
  bool places = false;
  for (const CaseResult& c : cases) {
    if (!c.has_wheelset) continue;
    if (first == nullptr) first = &c;
    if (c.pitch != first->pitch) return false;
    places = places || c.s != first->s;
  }
  return places;
}

std::string title_of(const CaseResult& result, bool by_place) {
  if (!result.has_wheelset) return fmt::format("case {}", result.number);
  return by_place ? fmt::format("s {:.4g} mm", 1e3 * result.s)
                  : fmt::format("pitch {:.2f}°", result.pitch * 180.0 / std::numbers::pi);
}

std::string draw_panel(const CasePicture& picture, const PictureLayout& layout, bool by_place, double top_pressure,
                       int index, int case_count) {
  const CaseResult& result = *picture.result;
  const PanelScale panel{layout.window(picture), layout.scale_x, layout.scale_y};
  const double width = layout.panel_width(), height = layout.panel_height();
  const int column = index % layout.columns, row = index / layout.columns;
  std::string out = fmt::format("<g class=\"panel\" transform=\"translate({:.1f} {:.1f})\">\n",
                                kPictureLeft + column * (width + kGapX), kPictureTop + row * (height + kGapY));

  out += svg_text(0.5 * width, -20.0, title_of(result, by_place), "middle", " class=\"title\"");
  if (picture.contact) {
    out += svg_text(0.5 * width, -7.0, force_and_pressure(result));
    for (const PatchPicture& patch : picture.patches) out += draw_patch(patch, top_pressure, panel);
  } else {
    std::string words(to_string(result.status));
    std::replace(words.begin(), words.end(), '_', ' ');
    out += svg_text(0.5 * width, 0.5 * height, result.status == Status::ok ? "no fields" : words);
  }
  out += draw_panel_axes(panel);
  if (column == 0)
    out += svg_text(-40.0, 0.5 * height, "y [mm]", "middle",
                    fmt::format(" transform=\"rotate(-90 -40 {:.1f})\"", 0.5 * height).c_str());
  if (index + layout.columns >= case_count) out += svg_text(0.5 * width, height + 28.0, "x [mm]");
  return out + "</g>\n";
}

std::string draw_legend(const PictureLayout& layout, double top_pressure) {
  const double height = std::min(layout.picture_height() - kPictureTop - kPictureBottom - 56.0, 240.0);
  std::string out =
      fmt::format("<g transform=\"translate({:.1f} {:.1f})\">\n", layout.picture_width() - kLegend + 32.0, kPictureTop);
  out += svg_text(0.0, -7.0, "pressure [MPa]", "start");
  out += draw_pressure_bar(top_pressure, height);
  out += fmt::format("<path class=\"contact\" d=\"M0 {:.1f}h14\"/>\n", height + 20.0);
  out += svg_text(20.0, height + 23.5, "edge of contact", "start");
  out += fmt::format("<rect x=\"0\" y=\"{:.1f}\" width=\"14\" height=\"10\" fill=\"{}\"/>\n", height + 33.0,
                     step_colour(kPressureSteps / 2));
  out += fmt::format("<path class=\"adhesion\" d=\"M0 {:.1f}h14\"/>\n", height + 38.0);
  out += svg_text(20.0, height + 41.5, "edge of adhesion", "start");
  return out + "</g>\n";
}

}  // namespace

std::string pressure_svg(const RunResult& run) {
  std::vector<CasePicture> cases;
  double top_pressure = 0.0;
  for (const CaseResult& result : run.cases) {
    cases.push_back(make_case_picture(result));
    for (const PatchPicture& patch : cases.back().patches)
      top_pressure = std::max(top_pressure, *std::max_element(patch.pressure.begin(), patch.pressure.end()));
  }
  const PictureLayout layout = make_layout(cases);

  std::string out = svg_head(layout.picture_width(), layout.picture_height(), 10, kPanelStyle);
  const bool by_place = differ_in_place(run.cases);
  int index = 0;
  for (const CasePicture& picture : cases)
    out += draw_panel(picture, layout, by_place, top_pressure, index++, static_cast<int>(cases.size()));
  return out + draw_legend(layout, top_pressure) + "</svg>\n";
}

void write_pressure_svg(const std::filesystem::path& path, const RunResult& run) {
  write_text_file(path, pressure_svg(run));
}

}  // namespace treadmark::io
