// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/pictures/pressure_svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "treadmark/pictures/patch_picture.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kPicturePanel = 170.0;     // longest side of a panel [px]
constexpr double kPictureMargin = 0.06;     // of the window, around the contact
constexpr double kPictureEqualScale = 4.0;  // windows longer than this get their own scale in each direction

/// The windows of all panels have one size; one place too if that does not make them much larger.
void place_windows(PatchSheet& sheet) {
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
  sheet.scale = {{-5.0, 5.0, -5.0, 5.0}, 0.1 * kPicturePanel, 0.1 * kPicturePanel};
  if (!all) return;
  const bool common = all->width() * all->height() <= 2.0 * width * height;
  if (common) width = all->width(), height = all->height();
  width *= 1.0 + 2.0 * kPictureMargin, height *= 1.0 + 2.0 * kPictureMargin;
  double scale_x = kPicturePanel / std::max(width, height), scale_y = scale_x;
  if (std::max(width, height) > kPictureEqualScale * std::min(width, height))
    scale_x = kPicturePanel / width, scale_y = kPicturePanel / height;
  const auto around = [&](const Window& target) {
    const double x = 0.5 * (target.x_low + target.x_high), y = 0.5 * (target.y_low + target.y_high);
    return Window{x - 0.5 * width, x + 0.5 * width, y - 0.5 * height, y + 0.5 * height};
  };
  sheet.scale = {around(*all), scale_x, scale_y};
  for (PatchPanel& panel : sheet.panels)
    if (panel.window) panel.window = common ? sheet.scale.window : around(*panel.window);
}

/// Wheelsets that stand at several places along the track, all with the same pitch, are told apart by their places.
bool differ_in_place(const std::vector<io::CaseResult>& cases) {
  const io::CaseResult* first = nullptr;
  bool places = false;
  for (const io::CaseResult& c : cases) {
    if (!c.has_wheelset) continue;
    if (first == nullptr) first = &c;
    if (c.pitch != first->pitch) return false;
    places = places || c.s != first->s;
  }
  return places;
}

}  // namespace

std::string pressure_svg(const io::RunResult& run) {
  PatchSheet sheet;
  double top_pressure = 0.0;
  const bool by_place = differ_in_place(run.cases);
  for (const io::CaseResult& result : run.cases) {
    PatchPanel& panel = sheet.panels.emplace_back();
    panel.patches = patch_pictures(result);
    panel.titles = {!result.has_wheelset ? fmt::format("case {}", result.number)
                    : by_place           ? fmt::format("s {:.4g} mm", 1e3 * result.s)
                                         : pitch_text(result)};
    for (const PatchPicture& patch : panel.patches) top_pressure = std::max(top_pressure, patch.greatest());
    (panel.patches.empty() ? panel.words : panel.remark) =
        panel.patches.empty() ? reason_without_patches(result) : force_and_pressure(result);
  }
  place_windows(sheet);
  sheet.steps = colour_steps({0.0, top_pressure});
  sheet.legend = pressure_legend(top_pressure);
  return draw_patch_sheet(std::move(sheet));
}

}  // namespace treadmark::pictures
