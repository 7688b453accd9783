// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/planform.hpp"

#include <limits>

namespace treadmark::app {
namespace {

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();

/// Number from 1 of the first rectangle that holds a point; 0: none.
std::size_t rectangle_at(const std::vector<double>& rectangles, double x, double y) {
  for (std::size_t k = 0; 4 * k + 3 < rectangles.size(); ++k)
    if (x >= rectangles[4 * k] && x <= rectangles[4 * k + 1] && y >= rectangles[4 * k + 2] &&
        y <= rectangles[4 * k + 3])
      return k + 1;
  return 0;
}

}  // namespace

void restrict_contact(const io::PlanformInput& input, const Grid2& grid, std::vector<double>& gap,
                      kalker::SubPatches& sub_patches) {
  using Kind = io::PlanformInput::Kind;
  if (input.kind == Kind::free) return;
  const std::vector<double>& c = input.coefficients;
  const bool parts = input.kind == Kind::sub_patches;
  if (parts) {
    sub_patches.count = static_cast<int>(c.size() / 4);
    sub_patches.part.assign(grid.size(), 0);
    sub_patches.coupling = input.coupling;
  }
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double x = grid.x(ix), y = grid.y(iy);
      const std::size_t i = grid.index(ix, iy);
      if (input.kind == Kind::quadratic) {
        if (c[0] * x * x + c[1] * x * y + c[2] * y * y + c[3] * x + c[4] * y + c[5] >= 0.0) gap[i] = kNever;
        continue;
      }
      const std::size_t part = rectangle_at(c, x, y);
      if (part == 0) gap[i] = kNever;
      if (parts) sub_patches.part[i] = static_cast<std::uint8_t>(part);
    }
}

}  // namespace treadmark::app
