// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/chart_axis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/io/results/svg_text.hpp"

namespace treadmark::io {
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
  const int exponent = static_cast<int>(std::floor(std::log10(value)));
  double best = scaled(5.0, exponent - 1);
  for (const double mantissa : {1.0, 2.0, 5.0})
    if (scaled(mantissa, exponent) <= value) best = scaled(mantissa, exponent);
  return best;
}

double round_up(double value) {
  const int exponent = static_cast<int>(std::floor(std::log10(value)));
  for (const double mantissa : {1.0, 2.0, 5.0})
    if (scaled(mantissa, exponent) >= value) return scaled(mantissa, exponent);
  return scaled(1.0, exponent + 1);
}

std::string power_label(int mantissa, int exponent) {
  return std::abs(exponent) <= 4 ? fmt::format("{:.6g}", scaled(mantissa, exponent))
                                 : fmt::format("{}e{}", mantissa, exponent);
}

}  // namespace

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

std::vector<AxisTick> ChartAxis::ticks() const { return scale_ == AxisScale::log ? log_ticks() : linear_ticks(); }

std::vector<AxisTick> ChartAxis::linear_ticks() const {
  std::vector<AxisTick> out;
  const double step = tick_step(high_ - low_);
  const double first = std::ceil(low_ / step - kRounding), last = std::floor(high_ / step + kRounding);
  for (double i = first; i <= last && out.size() < 20; ++i)
    if (const auto at = part(i * step)) out.push_back({*at, fmt::format("{:.6g}", i * step + 0.0)});
  return out;
}

std::vector<AxisTick> ChartAxis::log_ticks() const {
  const int first = static_cast<int>(std::floor(std::log10(low_) + kRounding));
  const int last = static_cast<int>(std::floor(std::log10(high_) + kRounding));
  const double decades = std::log10(high_) - std::log10(low_);
  const int every = 1 + static_cast<int>(decades) / kMostDecades;
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

}  // namespace treadmark::io
