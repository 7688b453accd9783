// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace treadmark {

/// Of the pieces between places that do not decrease, two at least, the one in which x lies: from places[k] to
/// places[k + 1]. Before all places the first one, behind them the last one. Thread-safe.
inline std::size_t piece_at(std::span<const double> places, double x) {
  return static_cast<std::size_t>(std::upper_bound(places.begin() + 1, places.end() - 1, x) - places.begin()) - 1;
}

/// A broken line through points whose places x do not decrease, two at least; it jumps where two places are the same.
/// Holds no copy of the points. Thread-safe.
class BrokenLine {
 public:
  BrokenLine(std::span<const double> x, std::span<const double> y) : x_(x), y_(y) {}

  std::size_t piece(double x) const { return piece_at(x_, x); }

  /// On a piece; 0 on one without length.
  double slope(std::size_t piece) const {
    const double length = x_[piece + 1] - x_[piece];
    return length > 0.0 ? (y_[piece + 1] - y_[piece]) / length : 0.0;
  }

  /// The first and the last piece go on straight.
  double at(double x) const {
    const std::size_t k = piece(x);
    return y_[k] + (x - x_[k]) / (x_[k + 1] - x_[k]) * (y_[k + 1] - y_[k]);
  }

  /// The first and the last value go on; one point is enough.
  double held_at(double x) const {
    if (x <= x_.front()) return y_.front();
    return x >= x_.back() ? y_.back() : at(x);
  }

  /// The integral of held_at over a stretch; places that increase. 0 for to <= from.
  double held_integral(double from, double to) const {
    double sum = 0.0;
    auto next = std::upper_bound(x_.begin(), x_.end(), from);
    for (double low = from, high = to; low < to; low = high) {
      high = next == x_.end() ? to : std::min(*next++, to);
      sum += 0.5 * (high - low) * (held_at(low) + held_at(high));
    }
    return sum;
  }

  /// The integral over a piece from its begin to x.
  double integral(std::size_t piece, double x) const {
    const double t = x - x_[piece];
    return t * (y_[piece] + 0.5 * slope(piece) * t);
  }

 private:
  std::span<const double> x_, y_;
};

}  // namespace treadmark
