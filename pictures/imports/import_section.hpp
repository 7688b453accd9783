// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/pictures/imports/import_plot.hpp"

namespace treadmark::io {

/// A view of the plane of the section with equal scales, y to the right and z down [mm].
struct SectionPanel {
  PlotFrame frame;
  bool empty = false;   ///< neither points nor curves: a low frame
  double bottom = 0.0;  ///< where the next panel may begin [px]
};

/// Place of a view in a box of at most this width and height, its upper left corner at (x, y). It shows the curves and
/// what lies around them within margin [m]; without curves, all but the farthest hundredth of the points.
SectionPanel place_section(const ImportReport& report, double x, double y, double most_width, double most_height,
                           double margin);

/// Axes of a view with what is in front of them and its border; an empty one says so. Above it is said how
/// many of the points of a kind lie beyond it.
std::string draw_section(const ImportReport& report, const SectionPanel& panel, const std::string& content,
                         const SectionPoints& counted = {}, const std::string& kind = "");

/// In millimetres, as the panel's axes.
std::vector<Vec2> in_mm(const SectionPoints& points);

/// Distance of the section from the nominal profile along the profile's normal, over y; [m], > 0 out of the material.
/// Points beyond the profile's ends are left out; the body tells on which side the material is.
std::vector<Vec2> deviation_from_nominal(const SectionPoints& section, const SectionPoints& nominal, Body body);

/// Where a point of the section with this y lies along it, as s of the maps from s_min to s_max; NaN where y is beyond
/// the section. Used where a damage or hole does not say its s.
double s_of_y(const SectionPoints& section, double s_min, double s_max, double y);

}  // namespace treadmark::io
