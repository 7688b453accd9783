// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/report/pictures/patch_picture.hpp"

namespace treadmark::pictures {

/// An instant as one panel: contact patches, those of a round wheel and the defect of the wheel's surface.
struct PatchesPanel {
  const io::CaseResult* result = nullptr;
  const io::CaseResult* round_wheel = nullptr;  ///< at the same load; may be absent
  Grid2 depth_grid = {};                        ///< x, y of the track [m]
  std::vector<double> depth = {};  ///< of the defect at the grid's points [m]; NaN = not known; may be empty
  double x_origin = 0.0;           ///< x of the track that is drawn as 0: the wheelset's [m]
  std::string title = {};          ///< empty: the pitch angle
  std::string remark = {};         ///< below the title; empty: normal force and largest pressure
};

/// Contact patches at several instants as an SVG picture seen from above: x of the track upwards, the rolling
/// direction, y to the right; one scale of pressure, windows of one place and size. Shown are pressures, edges of
/// contact and adhesion, the outline of the round wheel's contact (dark red) and lines of equal depth of the defect
/// (grey). Thread-safe. Errors: Error(configuration) for fields and depths that do not match their grids.
std::string patches_svg(std::span<const PatchesPanel> panels, const std::string& title);

/// The plotted numbers as a table with commas: panel (from 1), pitch_rad, kind, x_m, y_m, value. Kinds: pressure_Pa and
/// round_wheel_pressure_Pa of the drawn cells in contact, defect_depth_m of points in the windows. Errors: as above.
/// Thread-safe.
std::string patches_csv(std::span<const PatchesPanel> panels);

/// What the panels of patches_svg show, in the picture's plane: x to the right is y of the track, y upwards is x of the
/// track from the panel's origin [mm].
struct PatchesView {
  std::vector<std::vector<PatchPicture>> contact, round_wheel;  ///< of each panel
  Window window{-10.0, 10.0, -10.0, 10.0};                      ///< of all panels
  double top_pressure = 0.0;                                    ///< [Pa]
};

/// Errors: as patches_svg. Thread-safe.
PatchesView make_patches_view(std::span<const PatchesPanel> panels);

}  // namespace treadmark::pictures
