// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/pictures/chart_axis.hpp"

namespace treadmark::io {

/// Range of an axis in the unit that is shown.
struct PlotRange {
  double low = 0.0, high = 1.0;

  double length() const { return high - low; }
  bool usable() const;  ///< not empty, of ordinary size, and long enough for its ends to be told apart
};

/// Round values inside a range, at most `most` + 1 of them.
std::vector<double> round_ticks(const PlotRange& range, int most);

/// A box with two linear axes. Curves and points outside the box are cut off. Thread-safe.
class PlotFrame {
 public:
  /// Ranges that cannot be used become 0 .. 1. y_down: the values of y grow downwards.
  PlotFrame(const ChartBox& box, PlotRange x, PlotRange y, bool y_down = false);

  const ChartBox& box() const { return box_; }
  const PlotRange& x() const { return x_; }
  const PlotRange& y() const { return y_; }
  double px(double x) const { return box_.x + (x - x_.low) / x_.length() * box_.width; }
  double py(double y) const;
  bool holds(const Vec2& p) const;

  /// Grid lines, numbers and the names of the axes; the frame itself is drawn last, by border().
  std::string axes(const std::string& x_name, const std::string& y_name, bool grid = true) const;
  std::string border() const;

  /// Broken where a point is not finite. more: further attributes with a leading blank.
  std::string curve(std::span<const Vec2> points, const std::string& colour, double width,
                    const std::string& more = "") const;
  /// Dots of a diameter [px]; those that would cover each other are drawn once.
  std::string dots(std::span<const Vec2> points, const std::string& colour, double diameter) const;
  std::string level(double y, const std::string& dashes = "4 3") const;

 private:
  std::string clip() const;

  ChartBox box_;
  PlotRange x_, y_;
  bool y_down_;
};

/// Entry of a legend in one line.
struct PlotKey {
  enum class Kind { line, dashes, dot, box, hatch } kind = Kind::line;
  std::string colour, name;
};
/// From (x, y) to the right; y is the middle of the letters.
std::string draw_keys(std::span<const PlotKey> keys, double x, double y);

/// Grey stripes as a pattern "holes" for what is not there.
std::string hole_pattern();

/// Heading of a picture, a line below it, and what is left for the rest starts at kPictureTop.
std::string picture_heading(const std::string& title, const std::string& line);
inline constexpr double kPictureWidth = 1000.0, kPictureTop = 62.0;  // [px]
inline constexpr double kPlotLeft = 64.0, kPlotWidth = 840.0;

/// Rules of the style sheets of all pictures of an import.
extern const char* const kImportStyle;

inline constexpr const char* kRawColour = "#8a8f98";
inline constexpr const char* kNominalColour = "#0072b2";
inline constexpr const char* kSectionColour = "#111111";
inline constexpr const char* kRemovedColour = "#d1380a";

}  // namespace treadmark::io
