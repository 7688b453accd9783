// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/damage.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr double kStep = 1e-3;         // of the grid that is looked at [m]
constexpr std::size_t kSmallest = 12;  // cells

}  // namespace

std::vector<Damage> find_damage(const Band& band, const SplineField& field, double s_min, double s_max,
                                double threshold) {
  const auto rows = to_whole<std::size_t>(std::max(1.0, std::round(band.length() / kStep)));
  const auto columns = to_whole<std::size_t>(std::max(1.0, std::round((s_max - s_min) / kStep)));
  const double da = band.length() / static_cast<double>(rows), ds = (s_max - s_min) / static_cast<double>(columns);
  std::vector<float> depth(rows * columns);
  parallel_for(rows, [&](std::size_t r) {
    for (std::size_t c = 0; c < columns; ++c)
      depth[r * columns + c] = static_cast<float>(
          -field.value(da * (static_cast<double>(r) + 0.5), s_min + ds * (static_cast<double>(c) + 0.5)));
  });
  std::vector<std::uint8_t> seen(depth.size(), 0);
  std::vector<Damage> out;
  struct Cell {
    std::ptrdiff_t r, c;  // rows are counted on round a closed band, so that a part across the seam has one middle
  };
  std::vector<Cell> stack;
  const auto n_rows = static_cast<std::ptrdiff_t>(rows), n_columns = static_cast<std::ptrdiff_t>(columns);
  const auto place = [&](const Cell& x) {
    return static_cast<std::size_t>(((x.r % n_rows) + n_rows) % n_rows * n_columns + x.c);
  };
  for (std::ptrdiff_t r0 = 0; r0 < n_rows; ++r0)
    for (std::ptrdiff_t c0 = 0; c0 < n_columns; ++c0) {
      const Cell start{r0, c0};
      if (seen[place(start)] != 0 || std::fabs(depth[place(start)]) <= threshold) continue;
      const bool below = depth[place(start)] > 0.0f;
      Damage part;
      std::size_t cells = 0;
      double weight = 0.0, sum_a = 0.0, sum_s = 0.0;
      std::ptrdiff_t r_min = r0, r_max = r0, c_min = c0, c_max = c0;
      stack.assign(1, start);
      seen[place(start)] = 1;
      while (!stack.empty()) {
        const Cell x = stack.back();
        stack.pop_back();
        const double d = depth[place(x)];
        ++cells;
        weight += std::fabs(d);
        sum_a += std::fabs(d) * (static_cast<double>(x.r) + 0.5);
        sum_s += std::fabs(d) * (static_cast<double>(x.c) + 0.5);
        part.volume += d * da * ds;
        if (std::fabs(d) > std::fabs(part.depth)) part.depth = d;
        r_min = std::min(r_min, x.r), r_max = std::max(r_max, x.r), c_min = std::min(c_min, x.c),
        c_max = std::max(c_max, x.c);
        for (const Cell& step : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}}) {
          const Cell next{x.r + step.r, x.c + step.c};
          if (next.c < 0 || next.c >= n_columns || (!band.closed && (next.r < 0 || next.r >= n_rows))) continue;
          const float at = depth[place(next)];
          if (seen[place(next)] != 0 || std::fabs(at) <= threshold || (at > 0.0f) != below) continue;
          seen[place(next)] = 1;
          stack.push_back(next);
        }
      }
      if (cells < kSmallest) continue;
      part.a = da * sum_a / weight;
      part.s = s_min + ds * sum_s / weight;
      part.length = da * static_cast<double>(r_max - r_min + 1);
      part.width = ds * static_cast<double>(c_max - c_min + 1);
      out.push_back(part);
    }
  std::stable_sort(out.begin(), out.end(),
                   [](const Damage& x, const Damage& y) { return std::fabs(x.volume) > std::fabs(y.volume); });
  return out;
}

}  // namespace treadmark::scans
