// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/patch_spread.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::measured {

namespace {

/// What the rows say of one gap.
struct RowContact {
  double pressure = 0.0, area = 0.0, force = 0.0, middle = 0.0, approach = 0.0;
};

/// Mean over a row, its middle being `off` from a point, of the pressure sqrt(1 - (x / half)^2) over the distance to
/// the point, integrated along the row.
double influence(double off, double half, double width) {
  constexpr std::array<double, 4> kCosine{0.9807852804032304, 0.8314696123025452, 0.5555702330196022,
                                          0.19509032201612825};  // of pi / 16, 3 pi / 16 ...
  double sum = 0.0;
  for (const double cosine : kCosine) {
    const double x = half * std::sqrt(1.0 - cosine * cosine);
    const double near = std::fabs(off) > 3.0 * width
                            ? 1.0 / std::hypot(x, off)
                            : (std::asinh((off + 0.5 * width) / x) - std::asinh((off - 0.5 * width) / x)) / width;
    sum += cosine * cosine * near;
  }
  return half * sum * kPi / kCosine.size();
}

/// Of the force, or with a prescribed approach.
RowContact row_contact(const PatchRows& rows, double start, bool by_approach) {
  constexpr double kShare = 0.55;
  constexpr int kTurns = 5;
  const std::size_t n = rows.gap.size();
  std::size_t lowest = 0;
  for (std::size_t j = 0; j < n; ++j)
    if (rows.gap[j] < rows.gap[lowest] || std::isnan(rows.gap[lowest])) lowest = j;
  const double least = rows.gap[lowest];
  RowContact out;
  out.approach = start;
  for (int turn = 0; turn < kTurns; ++turn) {
    double squares = 0.0, halves = 0.0, moment = 0.0, most = 0.0, near = 0.0;
    const double penetration = by_approach ? start - least : out.approach;
    for (std::size_t j = 0; j < n; ++j) {
      const double depth = kShare * penetration - (rows.gap[j] - least);
      if (!(depth > 0.0)) continue;
      const double half = std::sqrt(2.0 * depth / rows.curvature_x);
      const double off = rows.width * (static_cast<double>(j) - static_cast<double>(lowest));
      squares += half * half * rows.width;
      halves += 2.0 * half * rows.width;
      moment += half * half * rows.width * static_cast<double>(j);
      most = std::max(most, half);
      near += half * influence(off, half, rows.width) * rows.width;
    }
    if (!(most > 0.0)) return {};
    const double per_force = 2.0 / (kPi * squares);                   // pressure / half length of a row
    const double approach = per_force * near / (kPi * rows.modulus);  // of a unit force
    out.force = by_approach ? penetration / approach : rows.force;
    out.pressure = out.force * per_force * most;
    out.area = halves * kPi / 4.0;
    out.middle = rows.width * moment / squares;
    if (by_approach) break;
    out.approach = std::cbrt(std::pow(rows.force * approach, 2) * out.approach);
  }
  return out;
}

}  // namespace

PatchSpread patch_spread(const PatchRows& rows, std::span<const std::vector<double>> errors) {
  PatchSpread out;
  if (errors.empty() || rows.gap.empty() || !(rows.force > 0.0) || !(rows.curvature_x > 0.0)) return out;
  constexpr double kStart = 30e-6;
  const RowContact base = row_contact(rows, kStart, false);
  if (!(base.pressure > 0.0)) return out;
  PatchRows moved = rows;
  const double least =
      *ranges::min_element(rows.gap, [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); });
  const RowContact held = row_contact(rows, base.approach + least, true);
  for (const std::vector<double>& error : errors) {
    for (std::size_t j = 0; j < rows.gap.size(); ++j) moved.gap[j] = rows.gap[j] + error[j];
    const RowContact one = row_contact(moved, base.approach, false);
    const RowContact stays = row_contact(moved, base.approach + least, true);
    out.pressure += std::pow(one.pressure / base.pressure - 1.0, 2);
    out.area += std::pow(one.area / base.area - 1.0, 2);
    out.shift += std::pow(one.middle - base.middle, 2);
    out.force += std::pow(stays.force / held.force - 1.0, 2);
  }
  const double count = static_cast<double>(errors.size());
  for (double* sum : {&out.pressure, &out.area, &out.shift, &out.force}) *sum = std::sqrt(*sum / count);
  return out;
}

}  // namespace treadmark::measured
