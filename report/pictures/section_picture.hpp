// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {

/// A section across wheel and rail, in true proportions.
struct SectionPicture {
  std::string title;
  Curve rail, wheel;              ///< (y, -z) [mm]; NaN interrupts; empty: not known
  std::vector<ChartPoint> marks;  ///< likewise
  std::string marks_name;
};

/// SVG of it.
std::string section_svg(SectionPicture picture);

}  // namespace treadmark::pictures
