// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/rail_sections.hpp"

#include <vector>

#include "treadmark/detection/lateral_nodes.hpp"
#include "treadmark/detection/natural_curve.hpp"

namespace treadmark::detection {

bool section_heights(const BodyPair& bodies, const Pose& X_TC, const Grid2& g, std::span<double> rail_n) {
  constexpr double kMargin = 6e-3;  // a dozen data: what lies further off does not bend the curve over the grid
  constexpr std::size_t kFewest = 4;
  const Pose X_RC = bodies.X_TR.inverse() * X_TC;
  const LateralInterval range{g.y(0) - kMargin, g.y(g.ny - 1) + kMargin};
  for (int ix = 0; ix < g.nx; ++ix) {
    std::vector<Vec2> nodes;
    for (const double y : lateral_nodes(*bodies.rail, X_RC, g.x(ix), range)) nodes.emplace_back(g.x(ix), y);
    std::vector<double> n(nodes.size());
    if (!nodes.empty()) bodies.rail->heights_at(X_RC, nodes, {n, {}, {}});
    for (std::size_t j = 0; j < nodes.size(); ++j) nodes[j] = {nodes[j].y(), n[j]};
    if (nodes.size() < kFewest) return false;
    const NaturalCurve curve(std::move(nodes));
    for (int iy = 0; iy < g.ny; ++iy) rail_n[g.index(ix, iy)] = curve.least_over(g.y(iy));
  }
  return true;
}

}  // namespace treadmark::detection
