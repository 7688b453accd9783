// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/io/histories/patches_svg.hpp"
#include "treadmark/io/results/picture_patch.hpp"

namespace treadmark::io {

/// What the panels of patches_svg show, in the picture's plane: x to the right is y of the track, y upwards is x of the
/// track from the panel's origin [mm].
struct PatchesView {
  std::vector<std::vector<PatchPicture>> contact, round_wheel;  ///< of each panel
  Window window{-10.0, 10.0, -10.0, 10.0};                      ///< of all panels
  double top_pressure = 0.0;                                    ///< [Pa]
};

/// Errors: as patches_svg. Thread-safe.
PatchesView make_patches_view(std::span<const PatchesPanel> panels);

}  // namespace treadmark::io
