// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/histories/history_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::io {
namespace {

constexpr double kWidest = 3.0, kNarrowest = 1.3;  // [px]
constexpr const char* kDashes = "7 3.5";

using Point = std::array<double, 2>;

bool finite(const Point& point) { return std::isfinite(point[0]) && std::isfinite(point[1]); }

Point between(const Point& a, const Point& b, double x) {
  return {x, std::lerp(a[1], b[1], (x - a[0]) / (b[0] - a[0]))};
}

/// Parts of a curve, put together with a NaN between them.
class Parts {
 public:
  void part() { parted_ = !out.empty(); }
  void add(const Point& point) {
    if (parted_) out.push_back({kNone, kNone});
    parted_ = false;
    if (out.empty() || out.back() != point) out.push_back(point);
  }
  Curve out;

 private:
  bool parted_ = false;
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace

Curve cut_curve(const Curve& curve, const Range& x) {
  const double low = x.low.value_or(-std::numeric_limits<double>::infinity());
  const double high = x.high.value_or(std::numeric_limits<double>::infinity());
  const auto inside = [&](const Point& point) { return point[0] >= low && point[0] <= high; };
  Parts parts;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Point& here = curve[i];
    if (!finite(here)) {
      parts.part();
      continue;
    }
    const bool joined = i > 0 && finite(curve[i - 1]);
    if (joined && !(inside(here) && inside(curve[i - 1]))) {
      const Point& before = curve[i - 1];
      const bool forward = before[0] < here[0];
      const double first = forward ? low : high, last = forward ? high : low;
      const auto crosses = [&](double end) {
        return (before[0] < end) != (here[0] < end) && before[0] != end && here[0] != end;
      };
      if (!inside(before)) parts.part();
      if (!inside(before) && crosses(first)) parts.add(between(before, here, first));
      if (!inside(here) && crosses(last)) parts.add(between(before, here, last));
    }
    if (inside(here)) parts.add(here);
  }
  return std::move(parts.out);
}

Curve history_curve(const SimulationResult& result, const std::string& x, const std::string& y) {
  const std::size_t of_x = column_index(result, x), of_y = column_index(result, y), width = result.columns.size();
  Curve out;
  out.reserve(result.rows());
  for (std::size_t row = 0; row < result.rows(); ++row)
    out.push_back({result.values[row * width + of_x], result.values[row * width + of_y]});
  return out;
}

void set_look(ChartSeries& series, std::size_t index, std::size_t count) {
  series.style = static_cast<int>(index);
  series.width =
      count < 2 ? 1.6 : std::lerp(kWidest, kNarrowest, static_cast<double>(index) / static_cast<double>(count - 1));
  if (index % 2 != 0) series.dashes = kDashes;
}

double legend_width(const std::vector<ChartSeries>& series) {
  double widest = 0.0;
  for (const ChartSeries& one : series) widest = std::max(widest, text_width(one.name, kChartFont));
  return series.empty() ? 0.0 : widest + 46.0;
}

}  // namespace treadmark::io
