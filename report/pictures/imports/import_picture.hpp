// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <string>
#include <vector>

#include "treadmark/io/imports/import_report.hpp"
#include "treadmark/report/pictures/chart.hpp"

namespace treadmark::pictures {

inline constexpr double kPlotLeft = 64.0, kPlotWidth = 840.0, kFullWidth = 912.0;  // [px]
inline constexpr const char* kRawColour = "#8a8f98";
inline constexpr const char* kNominalColour = "#0072b2";
inline constexpr const char* kSectionColour = "#111111";
inline constexpr const char* kRemovedColour = "#d1380a";

/// A chart of an import with what stands above it.
struct ImportPanel {
  std::string title;
  Chart chart;
  double width = kPlotWidth, height = 130.0;  ///< of the frame [px]
  std::vector<ChartSeries> keys = {};         ///< legend in a line; of those with a name
  std::string remark = {};                    ///< in place of a legend
  double indent = 0.0;                        ///< of the frame: room for names
};

/// A picture of an import, put together from above to below. One thread.
class ImportPicture {
 public:
  explicit ImportPicture(std::string heading) : heading_(std::move(heading)) {}

  /// Below all others; left: of the frame.
  void add(ImportPanel panel, double left = kPlotLeft);
  /// The next one begins where the last one did.
  void beside() { y_ = begin_; }
  /// Rows of words: to the right edges of columns, from x on; the first row is a head unless it is empty.
  void add_table(const std::string& title, double x, const std::vector<double>& edges,
                 const std::vector<std::vector<std::string>>& rows, const std::string& remark = "");

  std::string finish(const io::ImportReport& report, const std::string& more = "") const;

 private:
  void end(double bottom);

  std::string heading_, elements_;
  double y_ = 82.0, begin_ = 82.0, bottom_ = 82.0;
};

/// A line, dots or shapes with a colour.
ChartSeries line_series(std::string name, const char* colour, Curve curve, double width = 1.6, const char* dashes = "");
ChartSeries dot_series(std::string name, const char* colour, Curve dots, double diameter);
ChartSeries shape_series(std::string name, std::string look, std::vector<ChartShape> shapes, double least = 0.0);

/// In millimetres.
Curve in_mm(const io::SectionPoints& points);

}  // namespace treadmark::pictures
