// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/core/to_whole.hpp"
#include "treadmark/report/pictures/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace treadmark::pictures {

namespace {

constexpr double kLargest = 1e300;
constexpr double kMargin = 0.05;    // of a linear range, beyond the values
constexpr double kFactor = 1.15;    // of a logarithmic one
constexpr double kRounding = 1e-9;  // of a range; ticks this far outside still belong to it
constexpr int kMostDecades = 8;     // with a number each

/// mantissa 10^exponent without the rounding of pow for negative exponents.
double scaled(double mantissa, int exponent) {
  return exponent < 0 ? mantissa / std::pow(10.0, -exponent) : mantissa * std::pow(10.0, exponent);
}

/// Largest 1, 2 or 5 times a power of ten that is not above the value, and its counterpart.
double round_down(double value) {
  const int exponent = to_whole<int>(std::floor(std::log10(value)));
  double best = scaled(5.0, exponent - 1);
  for (const double mantissa : {1.0, 2.0, 5.0})
    if (scaled(mantissa, exponent) <= value) best = scaled(mantissa, exponent);
  return best;
}

double round_up(double value) {
  const int exponent = to_whole<int>(std::floor(std::log10(value)));
  for (const double mantissa : {1.0, 2.0, 5.0})
    if (scaled(mantissa, exponent) >= value) return scaled(mantissa, exponent);
  return scaled(1.0, exponent + 1);
}

std::string power_label(int mantissa, int exponent) {
  return std::abs(exponent) <= 4 ? fmt::format("{:.6g}", scaled(mantissa, exponent))
                                 : fmt::format("{}e{}", mantissa, exponent);
}

}  // namespace

double tick_step(double length) {
  const double rough = length / 6.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10.0 * power;
}

ChartAxis::ChartAxis(AxisScale scale, std::span<const double> values, double floor)
    : scale_(scale), floor_(floor), low_(kLargest), high_(-kLargest) {
  for (const double value : values)
    if (const auto at = shown(value)) {
      low_ = std::min(low_, *at);
      high_ = std::max(high_, *at);
    }
  if (low_ > high_) {
    low_ = scale == AxisScale::log ? 0.1 : 0.0;
    high_ = scale == AxisScale::log ? 10.0 : 1.0;
  } else if (scale == AxisScale::log) {
    low_ = round_down(low_ / kFactor);
    high_ = round_up(high_ * kFactor);
  } else {
    const double length = high_ - low_;
    const double size = length > 1e-12 * std::max(std::abs(low_), std::abs(high_))
                            ? length
                            : std::max(std::abs(high_), std::abs(low_) > 0.0 ? 0.0 : 1.0);
    const double step = tick_step(size * (1.0 + 2.0 * kMargin));
    low_ = std::floor((low_ - kMargin * size) / step) * step;
    high_ = std::ceil((high_ + kMargin * size) / step) * step;
  }
}

std::optional<double> ChartAxis::shown(double value) const {
  if (!(std::abs(value) <= kLargest)) return {};
  if (scale_ == AxisScale::linear) return value;
  if (at_floor(value)) return floor_;
  if (value < 1.0 / kLargest) return {};
  return value;
}

std::optional<double> ChartAxis::place(double value) const {
  const auto at = shown(value);
  return at ? part(*at) : std::nullopt;
}

std::optional<double> ChartAxis::part(double value) const {
  const double at = scale_ == AxisScale::log ? (std::log(value) - std::log(low_)) / (std::log(high_) - std::log(low_))
                                             : (value - low_) / (high_ - low_);
  if (!(at >= -kRounding && at <= 1.0 + kRounding)) return {};
  return std::clamp(at, 0.0, 1.0);
}

double ChartAxis::nearest(double value) const {
  return part(std::isnan(value) ? low_ : std::clamp(value, low_, high_)).value_or(0.0);
}

std::vector<AxisTick> ChartAxis::ticks(int most) const {
  return scale_ == AxisScale::log ? log_ticks() : linear_ticks(most);
}

std::vector<AxisTick> ChartAxis::linear_ticks(int most) const {
  std::vector<AxisTick> out;
  const double step = tick_step((high_ - low_) * 6.0 / most);
  const double first = std::ceil(low_ / step - kRounding), last = std::floor(high_ / step + kRounding);
  for (double i = first; i <= last && out.size() < 40; ++i)
    if (const auto at = part(i * step)) out.push_back({*at, fmt::format("{:.6g}", i * step + 0.0)});
  return out;
}

std::vector<AxisTick> ChartAxis::log_ticks() const {
  const int first = to_whole<int>(std::floor(std::log10(low_) + kRounding));
  const int last = to_whole<int>(std::floor(std::log10(high_) + kRounding));
  const double decades = std::log10(high_) - std::log10(low_);
  const int every = 1 + to_whole<int>(decades) / kMostDecades;
  const auto labelled = [&](int mantissa) {
    return mantissa == 1 || decades < 1.0 || (decades < 2.5 && (mantissa == 2 || mantissa == 5));
  };
  std::vector<AxisTick> out;
  for (int exponent = first; exponent <= last; ++exponent) {
    if (every > 1 && exponent % every != 0) continue;
    for (int mantissa = 1; mantissa <= (every > 1 ? 1 : 9); ++mantissa)
      if (const auto at = part(scaled(mantissa, exponent)))
        out.push_back({*at, labelled(mantissa) ? power_label(mantissa, exponent) : ""});
  }
  return out;
}

namespace {

double overlap(const Box& a, const Box& b) {
  const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
  const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
  return width > 0.0 && height > 0.0 ? width * height : 0.0;
}

double outside(const Box& a, const Box& frame) { return a.width * a.height - overlap(a, frame); }

constexpr double kNothing = 1e-6;  // [px^2], the rounding of areas

/// Places to try, the best first: where the text's middle lies from the point's, in half widths and half heights.
constexpr std::array<std::array<double, 2>, 16> kSides{{{1, 0},
                                                        {-1, 0},
                                                        {0, -1},
                                                        {0, 1},
                                                        {1, -1},
                                                        {1, 1},
                                                        {-1, -1},
                                                        {-1, 1},
                                                        {0, -2.2},
                                                        {0, 2.2},
                                                        {1, -2.2},
                                                        {1, 2.2},
                                                        {-1, -2.2},
                                                        {-1, 2.2},
                                                        {0, -3.4},
                                                        {0, 3.4}}};

}  // namespace

std::vector<Pixel> place_labels(std::span<const LabelPoint> points, const Box& box, double font_size) {
  std::vector<Box> taken;
  const auto up = [](const LabelPoint& point) { return point.half_height < 0.0 ? point.radius : point.half_height; };
  for (const LabelPoint& point : points)
    taken.push_back({point.x - point.radius, point.y - up(point), 2.0 * point.radius, 2.0 * up(point)});

  std::vector<Pixel> places;
  for (const LabelPoint& point : points) {
    const double width = text_width(point.text, font_size), gap = 3.0;
    Box best;
    double least = -1.0;
    for (const auto& side : kSides) {
      const double reach_x = side[1] == 0.0 ? point.radius + gap : 0.7 * point.radius;
      const double reach_y = side[0] == 0.0 ? up(point) + gap : 0.7 * up(point);
      const double x = point.x + side[0] * (0.5 * width + reach_x);
      const double y = point.y + side[1] * 0.5 * font_size + (side[1] > 0.0 ? reach_y : side[1] < 0.0 ? -reach_y : 0.0);
      const Box trial{x - 0.5 * width, y - 0.5 * font_size, width, font_size};
      double cost = 3.0 * outside(trial, box);
      for (const Box& other : taken) cost += overlap(trial, other);
      if (least >= 0.0 && cost >= least - kNothing) continue;
      least = cost;
      best = trial;
      if (cost <= kNothing) break;
    }
    places.push_back({best.x, best.y + 0.83 * font_size});
    if (!point.text.empty()) taken.push_back(best);
  }
  return places;
}

}  // namespace treadmark::pictures
