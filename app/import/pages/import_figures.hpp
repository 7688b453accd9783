// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// Maps of an import as views, averaged where they are finer than a page needs; nothing of a map without values. Marks
/// are outlines of holes and damage as report.json has them.
std::vector<report::MapView::Mark> import_marks(const io::ImportReport& report);

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
std::vector<report::Block> map_figure(const io::BandMap& map, Body body, MapFigure what,
                                      std::vector<report::MapView::Mark> marks = {});

/// mm, or µm where all values are small: unit and factor from metres.
std::pair<std::string, double> length_unit_of(const io::BandMap& map);

/// Distribution of the residuals over that of the noise, with their numbers; nothing where there are none.
std::vector<report::Block> residual_figure(const io::ImportReport& report);

/// The points in space, coloured by residual or distance from the section; nothing without points.
std::vector<report::Block> cloud_figure(const io::ImportReport& report);

/// Numbers of the surface against the truth and where it differs; nothing where no truth was named.
std::vector<report::Block> truth_blocks(const io::ImportReport& report);

}  // namespace treadmark::app::pages
