// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/report/pictures/imports/import_picture.hpp"

namespace treadmark::pictures {

struct SectionSize {
  double width = kFullWidth, most_height = 360.0;  ///< [px]
  double margin = 10e-3;                           ///< [m]
};

/// A view of the plane of the section with equal scales, y to the right and z down [mm], without what is shown in it.
/// It covers the curves and what lies around them within the margin; without curves, all but the farthest hundredth of
/// the points.
ImportPanel section_panel(const io::ImportReport& report, const std::string& title, const SectionSize& size = {});

/// The title with how many of the dots of a kind lie beyond the frame; empty where none do.
std::string beyond(const ImportPanel& panel, const ChartSeries& series, const std::string& kind);

/// Distance of the section from the nominal profile along the profile's normal, over y; [m], > 0 out of the material.
/// Points beyond the profile's ends are left out; the body tells on which side the material is.
std::vector<Vec2> deviation_from_nominal(const io::SectionPoints& section, const io::SectionPoints& nominal, Body body);

/// Where a point of the section with this y lies along it, as s of the maps from s_min to s_max; NaN where y is beyond
/// the section. Used where a damage or hole does not say its s.
double s_of_y(const io::SectionPoints& section, double s_min, double s_max, double y);

}  // namespace treadmark::pictures
