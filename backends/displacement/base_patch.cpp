// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/base_patch.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::displacement {

namespace {
/// [m] of all that is left out; a kink between the points shows in the differences by less than it does, hence kSafety.
constexpr double kError = 4e-13, kSafety = 8.0;
/// Of slopes, where they are wanted.
constexpr double kSlopeError = 1e-8;

constexpr int kMost = 64;  ///< columns at once
double greater_height(double a, double b) { return a > b ? a : b; }
}  // namespace

bool BasePatch::look(int begin, int end, int first, int last) {
  constexpr int kLeast = 6;  // points of a fifth difference
  begin_ = begin, end_ = end, first_ = first, last_ = last;
  width_ = static_cast<std::size_t>(end - begin) + 6;
  if (g_.nx + 2 < kLeast || g_.ny + 2 < kLeast) return false;
  along_.resize(width_ * static_cast<std::size_t>(last - first + 4));
  across_.resize(width_ * static_cast<std::size_t>(last - first + 3));
  // First columns of differences; beside the last column of the grid there is none but the one before.
  const int from = std::min(std::max(begin - 3, -1), g_.nx - 5), to = std::max(from, std::min(end - 2, g_.nx - 5));
  double one[kMost + 8];
  for (int iy = std::max(first - 2, -1); iy <= std::min(last + 1, g_.ny); ++iy) {
    const double* z = base_.row(iy);
    const double* const six[6] = {z + from, z + from + 1, z + from + 2, z + from + 3, z + from + 4, z + from + 5};
    kernel_.fifth(static_cast<std::size_t>(to - from + 1), six, one);
    double* most = along(iy);
    for (int ix = begin; ix < end; ++ix)
      most[ix - begin] =
          greater_height(one[std::clamp(ix - 3, from, to) - from], one[std::clamp(ix - 2, from, to) - from]);
  }
  const int left = std::max(begin - 2, -1), right = std::min(end + 1, g_.nx);
  for (int iy = std::max(first - 3, -1); iy <= std::min(last - 2, g_.ny - 5); ++iy) {
    const double* six[6];
    for (int k = 0; k < 6; ++k) six[k] = base_.row(iy + k) + left;
    kernel_.fifth(static_cast<std::size_t>(right - left + 1), six, across(iy) + (left - begin + 2));
  }
  return true;
}

void BasePatch::row(int iy, const double* sx, const double* sy, double* h, double* hx, double* hy, bool* good) {
  std::fill(good, good + (end_ - begin_), false);
  if (iy < 1 || iy > g_.ny - 2) return;
  const int from = std::max(begin_, 1), to = std::min(end_, g_.nx - 1);
  if (from >= to) return;
  const auto n = static_cast<std::size_t>(to - from);
  const int k0 = from - begin_;
  const double* rows[5];
  for (int k = 0; k < 5; ++k) rows[k] = base_.row(iy + k - 2) + from;
  kernel_.interpolate(n, rows, sx + k0, sy + k0, h + k0, hx + k0, hy + k0);
  const double* x_differences[5];
  for (int k = 0; k < 5; ++k) x_differences[k] = along(iy + k - 2) + k0;
  const double* const y_differences[2] = {across(std::max(iy - 3, -1)) + k0, across(std::min(iy - 2, g_.ny - 5)) + k0};
  double missing[kMost], missing_x[kMost], missing_y[kMost];
  kernel_.missing(n, x_differences, y_differences, sx + k0, sy + k0, missing, missing_x, missing_y);
  const double per_dx = 1.0 / g_.dx, per_dy = 1.0 / g_.dy;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = i + static_cast<std::size_t>(k0);
    hx[k] *= per_dx;
    hy[k] *= per_dy;
    good[k] = (std::fabs(sx[k]) <= kFarthest) & (std::fabs(sy[k]) <= kFarthest) & (kSafety * missing[i] <= kError) &
              (!slopes_ | (kSafety * (missing_x[i] * per_dx + missing_y[i] * per_dy) <= kSlopeError));
  }
}

}  // namespace treadmark::displacement
