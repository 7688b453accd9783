// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/results/result_model.hpp"
#include "treadmark/pictures/outline.hpp"

namespace treadmark::io {

/// Rectangle in the picture's plane [mm].
struct Window {
  double x_low = 0.0, x_high = 0.0, y_low = 0.0, y_high = 0.0;

  double width() const { return x_high - x_low; }
  double height() const { return y_high - y_low; }
  void include(const Window& other);
};

/// What the picture shows of a patch: the part of its grid that is in contact, coarsened when it is very fine.
struct PatchPicture {
  int nx = 0, ny = 0;               ///< 0 = nothing in contact
  double dx = 0.0, dy = 0.0;        ///< size of a cell [mm]
  double x_low = 0.0, y_low = 0.0;  ///< corner of the first cell [mm]
  std::vector<double> pressure;     ///< [Pa], 0 outside the contact
  std::vector<char> contact, adhesion;

  Window extent() const { return {x_low, x_low + nx * dx, y_low, y_low + ny * dy}; }
  CellMask above(double pressure_limit) const;  ///< cells in contact with at least this pressure
};

PatchPicture make_patch_picture(const PatchFields& fields);

/// Where the picture's plane lies on a panel: x_px = (x_mm - window.x_low) scale_x, y_px = (window.y_high - y_mm)
/// scale_y.
struct PanelScale {
  Window window;
  double scale_x = 1.0, scale_y = 1.0;  ///< [px/mm]
};

/// SVG elements of a patch on its panel: filled steps of pressure up to top_pressure [Pa], the edge of contact (dark)
/// and of the adhesion area (white).
std::string draw_patch(const PatchPicture& picture, double top_pressure, const PanelScale& panel);

/// Steps of pressure in the picture; step k of 0 .. kPressureSteps-1 has the colour of its middle.
inline constexpr int kPressureSteps = 20;
std::string step_colour(int step);

/// Colour of a value between 0 and 1 as "#rrggbb": dark violet over blue and green to yellow. Lightness grows evenly,
/// so that order survives in grey print and for colour-blind readers. Values outside are clamped, NaN is grey.
std::string colour(double value);

}  // namespace treadmark::io
