// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/even_sample.hpp"

#include <algorithm>

#include "treadmark/core/random.hpp"
#include "treadmark/scans/placement/voxels.hpp"

namespace treadmark::scans {

std::vector<Vec3> even_sample(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const Vec3& centre,
                              double cube, std::size_t most) {
  const Voxels voxels(points, centre, cube, keep);
  std::vector<std::size_t> counts(voxels.count());
  std::size_t kept = 0;
  for (std::size_t v = 0; v < voxels.count(); ++v) kept += counts[v] = voxels.points_of(v).size();
  // the cube in which the first quarter of the points ends: by points, for outliers have cubes of their own, and many
  // of them
  std::sort(counts.begin(), counts.end());
  std::size_t usual = 1, sum = 0;
  for (const std::size_t count : counts) {
    sum += usual = count;
    if (4 * sum >= kept) break;
  }
  constexpr std::size_t kLone = 8;  // cubes with less than this part of the usual count hold no surface
  const double share = static_cast<double>(most) / static_cast<double>(std::max<std::size_t>(kept, 1));
  std::vector<Vec3> out;
  for (std::size_t v = 0; v < voxels.count(); ++v) {
    const auto inside = voxels.points_of(v);
    if (kLone * inside.size() < usual) continue;
    const std::size_t stride = (inside.size() + usual - 1) / usual;
    for (std::size_t k = 0; k < inside.size(); k += stride)
      if (share >= 1.0 || Random(inside[k]).uniform() < share) out.push_back(points[inside[k]]);
  }
  return out;
}

}  // namespace treadmark::scans
