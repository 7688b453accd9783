// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/sub_patches.hpp"

#include <cmath>

namespace treadmark::wheelrail {

kalker::SubPatches sub_patches(const Discretisation& discretisation, const detection::ContactPatch& region,
                               const detection::ContactFrame& frame, const Vec2& reference_C, const Grid2& grid) {
  kalker::SubPatches sub;
  const auto& parts = region.parts;
  if (parts.size() < 2) return sub;
  detection::PatchRules rules;
  rules.separation = discretisation.separation;
  rules.combination = discretisation.combination;
  constexpr double kEnlargement = 0.4;
  const double margin = kEnlargement * rules.combination;
  const Vec3& reference = frame.X_TC.origin;
  const double stretch = 1.0 / std::cos(frame.angle);
  const std::size_t n = parts.size();
  sub.count = static_cast<int>(n);
  sub.part.assign(grid.size(), 0);
  sub.coupling.assign(n * n, 1.0);
  for (std::size_t k = 0; k < n; ++k) {
    const Rectangle& box = parts[k].box;
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        const double x = grid.x(ix) - reference_C.x(), s = grid.y(iy) - reference_C.y();
        const std::size_t i = grid.index(ix, iy);
        if (sub.part[i] == 0 && x >= box.x_min - reference.x() - margin && x <= box.x_max - reference.x() + margin &&
            s >= (box.y_min - reference.y()) * stretch - margin && s <= (box.y_max - reference.y()) * stretch + margin)
          sub.part[i] = static_cast<std::uint8_t>(k + 1);
      }
    for (std::size_t j = 0; j < k; ++j)
      sub.coupling[k * n + j] = sub.coupling[j * n + k] =
          detection::sub_patch_coupling(detection::patch_distance(parts[k], parts[j]), rules);
  }
  return sub;
}

}  // namespace treadmark::wheelrail
