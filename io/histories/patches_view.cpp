// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/patches_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/results/field_table.hpp"

namespace treadmark::io {
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

}  // namespace treadmark::io
