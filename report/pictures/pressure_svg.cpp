// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/report/pictures/pressure_svg.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "treadmark/report/pictures/patch_picture.hpp"

namespace treadmark::pictures {
namespace {

constexpr double kPicturePanel = 170.0;  // longest side of a panel [px]

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

constexpr std::size_t kMostPanels = 500;

}  // namespace

std::string pressure_svg(const io::RunResult& run) {
  PatchSheet sheet;
  double top_pressure = 0.0;
  const bool by_place = differ_in_place(run.cases);
  const std::size_t count = run.cases.size(), shown = std::min(count, kMostPanels);
  if (shown < count) sheet.title = fmt::format("{} of {} cases, at equal distances", shown, count);
  for (std::size_t k = 0; k < shown; ++k) {
    const io::CaseResult& result = run.cases[shown < count ? k * (count - 1) / (shown - 1) : k];
    PatchPanel& panel = sheet.panels.emplace_back();
    panel.patches = patch_pictures(result);
    panel.titles = {!result.has_wheelset ? fmt::format("case {}", result.number)
                    : by_place           ? fmt::format("s {:.4g} mm", 1e3 * result.s)
                                         : pitch_text(result)};
    for (const PatchPicture& patch : panel.patches) top_pressure = std::max(top_pressure, patch.greatest());
    (panel.patches.empty() ? panel.words : panel.remark) =
        panel.patches.empty() ? reason_without_patches(result) : force_and_pressure(result);
  }
  place_windows(sheet, kPicturePanel);
  sheet.steps = colour_steps({0.0, top_pressure});
  sheet.legend = pressure_legend(top_pressure);
  return draw_patch_sheet(std::move(sheet));
}

}  // namespace treadmark::pictures
