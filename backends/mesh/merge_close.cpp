// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <cstdint>

#include "treadmark/backends/mesh/prepare.hpp"

namespace treadmark::mesh {

namespace {

using Cell = std::array<std::int64_t, 3>;

std::size_t hash(const Cell& cell) {
  std::uint64_t h = 0;
  for (const std::int64_t k : cell) {
    h = (h ^ static_cast<std::uint64_t>(k)) * 0x9e3779b97f4a7c15ull;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

}  // namespace

std::vector<std::uint32_t> merge_close(const std::vector<Vec3>& points, double tolerance) {
  // cells far larger than the tolerance, so that a point seldom lies near the border of its cell
  tolerance = std::max(tolerance, 1e-300);
  const double per_cell = 1.0 / (16.0 * tolerance);
  std::size_t size = 16;
  while (size < 2 * points.size()) size *= 2;
  std::vector<std::uint32_t> first(size, kNone), next(points.size(), kNone), same(points.size());
  const Vec3 origin = points.empty() ? Vec3(Vec3::Zero()) : points.front();
  constexpr double kFar = 4e18;  // cells beyond are one; distances are compared anyway
  const auto cell_of = [&](const Vec3& p, double shift) {
    Cell cell;
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(
          std::fmax(-kFar, std::fmin(kFar, std::floor((p[k] - origin[k] + shift) * per_cell))));
    return cell;
  };
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3& p = points[i];
    same[i] = i;
    const Cell low = cell_of(p, -tolerance), high = cell_of(p, tolerance);
    for (int corner = 0; corner < 8; ++corner) {
      Cell cell = low;
      bool repeated = false;
      for (std::size_t k = 0; k < 3; ++k)
        if (corner >> k & 1) {
          repeated = repeated || high[k] == low[k];
          cell[k] = high[k];
        }
      if (repeated) continue;
      for (std::uint32_t j = first[hash(cell) & (size - 1)]; j != kNone; j = next[j])
        if ((points[j] - p).squaredNorm() <= tolerance * tolerance) same[i] = std::min(same[i], j);
    }
    if (same[i] != i) continue;
    const std::size_t slot = hash(cell_of(p, 0.0)) & (size - 1);
    next[i] = first[slot];
    first[slot] = i;
  }
  return same;
}

}  // namespace treadmark::mesh
