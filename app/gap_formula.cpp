// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/gap_formula.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"

namespace treadmark::app {
namespace {

double quadratic(const std::vector<double>& b, double x, double y) {
  return b[0] * x * x + b[1] * x * y + b[2] * y * y + b[3] * x + b[4] * y + b[5];
}

double circular(const std::vector<double>& b, double x, double y) {
  constexpr std::size_t kFirstHeight = 4;
  const double x_middle = b[0], radius = b[1], y_first = b[2], step = b[3];
  const std::size_t count = b.size() - kFirstHeight;
  double height = b[kFirstHeight];
  if (count > 1) {
    const double position = (y - y_first) / step;
    const auto k = static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(count - 2)));
    const double fraction = position - static_cast<double>(k);
    height = (1.0 - fraction) * b[kFirstHeight + k] + fraction * b[kFirstHeight + k + 1];
  }
  return height + (x - x_middle) * (x - x_middle) / (2.0 * radius);
}

double sinusoidal(const std::vector<double>& b, double x, double y) {
  return b[0] * std::sin(b[1] * (x - b[2])) - b[3] * std::sin(b[4] * (x - b[5])) + x * x / b[6] + y * y / b[7];
}

}  // namespace

std::vector<double> gap_of_formula(const io::GapInput& input, const Grid2& grid) {
  using Kind = io::GapInput::Kind;
  const std::vector<double>& b = input.coefficients;
  const bool fits = input.kind == Kind::quadratic    ? b.size() == 6
                    : input.kind == Kind::circular   ? b.size() >= 5
                    : input.kind == Kind::sinusoidal ? b.size() == 8
                                                     : b.size() == grid.size();
  if (!fits)
    throw Error(ErrorKind::configuration, "the undeformed distance has " + std::to_string(b.size()) + " coefficients");
  if (input.kind == Kind::per_element) return b;
  std::vector<double> gap;
  gap.reserve(grid.size());
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix), y = grid.y(iy);
      gap.push_back(input.kind == Kind::quadratic  ? quadratic(b, x, y)
                    : input.kind == Kind::circular ? circular(b, x, y)
                                                   : sinusoidal(b, x, y));
    }
  return gap;
}

}  // namespace treadmark::app
