// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace treadmark::io {

enum class AxisScale { linear, log };

/// Mark on an axis; at = 0 (low end) .. 1 (high end). A mark without a label is a minor one.
struct AxisTick {
  double at = 0.0;
  std::string label;
};

/// Range of an axis around some values, and where a value lies on it. Values that are not finite or beyond 1e+-300 are
/// passed over. On a logarithmic axis with a floor > 0 values from 0 to the floor are shown at the floor; other values
/// that are not positive cannot be shown. Without any value to show the range is 0 .. 1 or 0.1 .. 10. Thread-safe.
class ChartAxis {
 public:
  ChartAxis(AxisScale scale, std::span<const double> values, double floor = 0.0);

  /// Linear, of exactly this range; low < high, both finite.
  ChartAxis(double low, double high) : scale_(AxisScale::linear), floor_(0.0), low_(low), high_(high) {}

  double low() const { return low_; }
  double high() const { return high_; }

  /// 0 .. 1 for values inside the range, nothing for those that cannot be shown.
  std::optional<double> place(double value) const;

  /// The value is shown at the floor, not where it is.
  bool at_floor(double value) const { return scale_ == AxisScale::log && value >= 0.0 && value < floor_; }

  std::vector<AxisTick> ticks() const;

 private:
  std::optional<double> shown(double value) const;
  std::optional<double> part(double value) const;
  std::vector<AxisTick> linear_ticks() const;
  std::vector<AxisTick> log_ticks() const;

  AxisScale scale_;
  double floor_, low_, high_;
};

/// Rectangle in pixels, y downwards.
struct ChartBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

/// A point that wants a text beside it [px].
struct LabelPoint {
  double x = 0.0, y = 0.0, radius = 0.0;
  std::string text;
};

/// Where the text goes: its baseline's start (left end).
struct LabelPlace {
  double x = 0.0, y = 0.0;
};

/// Rough width of a text in the pictures' font.
double text_width(const std::string& text, double font_size);

/// Places of the texts, in the order of the points: beside, above or below each, inside the box, on as few markers and
/// other texts as can be found one after the other. Points without a text are only kept clear. Thread-safe.
std::vector<LabelPlace> place_labels(std::span<const LabelPoint> points, const ChartBox& box, double font_size);

}  // namespace treadmark::io
