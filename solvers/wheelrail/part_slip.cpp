// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/part_slip.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::wheelrail {
namespace {

/// Rigid penetration of the elements of one part; those of no part that touches have none.
double approach_of(const PatchSolution& patch, const kalker::SubPatches& parts, std::size_t k) {
  double approach = 0.0;
  for (std::size_t i = 0; i < parts.part.size(); ++i)
    if (parts.part[i] == k + 1) approach = std::max(approach, patch.approach - patch.distance[i]);
  return approach;
}

/// How much of the nearest other part a part feels.
double coupling_of(const kalker::SubPatches& parts, std::size_t k) {
  const auto count = static_cast<std::size_t>(parts.count);
  double most = 0.0;
  for (std::size_t j = 0; j < count; ++j)
    if (j != k) most = std::max(most, parts.coupling[k * count + j]);
  return most;
}

}  // namespace

PartSlip part_slip(const Problem& p, const Placement& placed, const Surface& rail, const PatchSolution& patch,
                   const kalker::SubPatches& parts) {
  PartSlip slip;
  if (parts.count < 2) return slip;
  const Grid2& g = patch.grid;
  slip.x.assign(g.size(), 0.0);
  slip.y.assign(g.size(), 0.0);
  const ContactKinematics& whole = patch.kinematics;
  for (std::size_t k = 0; k < static_cast<std::size_t>(parts.count); ++k) {
    const detection::PatchExtent& extent = patch.region.parts[k];
    const double z = height_at(rail, placed.X_TS.inverse(), {extent.x, extent.y}),
                 own_share = 1.0 - coupling_of(parts, k);
    if (std::isnan(z) || !(own_share > 0.0)) continue;
    const Pose X_TP{{extent.x, extent.y, z}, patch.frame.X_TC.rotation};
    const ContactKinematics own = contact_kinematics(p, placed, X_TP, approach_of(patch, parts, k));
    const Vec3 reference = patch.frame.X_TC.apply_inverse(X_TP.origin);
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const std::size_t i = g.index(ix, iy);
        if (parts.part[i] != k + 1) continue;
        const double x = g.x(ix) - patch.reference_C.x(), y = g.y(iy) - patch.reference_C.y();
        slip.x[i] = own_share * (own.xi - whole.xi - own.phi * (y - reference.y()) + whole.phi * y);
        slip.y[i] = own_share * (own.eta - whole.eta + own.phi * (x - reference.x()) - whole.phi * x);
      }
  }
  return slip;
}

}  // namespace treadmark::wheelrail
