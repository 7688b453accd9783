// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/contact_span.hpp"

#include <algorithm>

namespace treadmark::kalker {
namespace {

/// Elements in contact in a line, from the one of the largest pressure on.
struct Run {
  int count = 1;
  double squares = 1.0;  ///< of the pressures over the largest one

  /// The squares of the pressures of an ellipse add up to two thirds of their number.
  double length(double step) const {
    constexpr double kOfSquares = 1.5;
    const double n = count;
    return step * std::clamp(kOfSquares * squares, std::max(n - 1.5, 0.5 * n), n);
  }
};

Run run_of(std::span<const double> pressure, std::size_t at, std::size_t step, int before, int after) {
  Run run;
  const auto follow = [&](int most, bool forward) {
    for (int k = 1; k <= most; ++k) {
      const std::size_t offset = static_cast<std::size_t>(k) * step;
      const double p = pressure[forward ? at + offset : at - offset];
      if (!(p > 0.0)) return;
      ++run.count;
      run.squares += (p / pressure[at]) * (p / pressure[at]);
    }
  };
  follow(before, false);
  follow(after, true);
  return run;
}

}  // namespace

std::size_t largest_pressure(std::span<const double> pressure) {
  std::size_t at = 0;
  for (std::size_t i = 1; i < pressure.size(); ++i)
    if (pressure[i] > pressure[at]) at = i;
  return at;
}

PeakSharpness peak_sharpness(const Grid2& g, std::span<const double> pressure) {
  const std::size_t at = largest_pressure(pressure), row = static_cast<std::size_t>(g.nx);
  const int ix = static_cast<int>(at % row), iy = static_cast<int>(at / row);
  const auto sharpness = [&](std::size_t step, int before, int after) {
    if (before + after == 0 || !(pressure[at] > 0.0)) return 0.0;
    const double lower = before > 0 ? pressure[at - step] : 0.0, upper = after > 0 ? pressure[at + step] : 0.0;
    return 2.0 - (lower + upper) / pressure[at];
  };
  return {sharpness(1, ix, g.nx - 1 - ix), sharpness(row, iy, g.ny - 1 - iy)};
}

ContactSpan contact_span(const Grid2& g, std::span<const double> pressure) {
  const std::size_t at = largest_pressure(pressure), row = static_cast<std::size_t>(g.nx);
  const int ix = static_cast<int>(at % row), iy = static_cast<int>(at / row);
  const Run along = run_of(pressure, at, 1, ix, g.nx - 1 - ix), across = run_of(pressure, at, row, iy, g.ny - 1 - iy);
  return {along.count, across.count, along.length(g.dx), across.length(g.dy)};
}

}  // namespace treadmark::kalker
