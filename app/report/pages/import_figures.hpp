// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/app/report/page.hpp"
#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::app::report {

/// Maps of an import as views, averaged where they are finer than a page needs; nothing of a map without values. Marks
/// are outlines of holes and damage as report.json has them.
std::vector<MapView::Mark> import_marks(const io::ImportReport& report);

struct MapFigure {
  const char* id;
  const char* title;
  std::string label, unit;  ///< of the values
  double factor = 1.0;      ///< from SI to the unit
  bool diverging = false;
  std::string note = {};
};

/// A figure of a map, or nothing without values. Few values far beyond all others would take all colours: they are
/// shown at a limit, which the note says.
std::vector<Block> map_figure(const io::BandMap& map, Body body, MapFigure what, std::vector<MapView::Mark> marks = {});

/// mm, or µm where all values are small: unit and factor from metres.
std::pair<std::string, double> length_unit_of(const io::BandMap& map);

/// Counts of residuals; no panels where there are none.
ChartView residual_chart(const io::ImportReport& report);

}  // namespace treadmark::app::report
