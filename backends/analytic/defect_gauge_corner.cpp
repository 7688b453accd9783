// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defect_shapes.hpp"

namespace treadmark::analytic {

ShapePtr make_gauge_corner_shape(const GaugeCornerCollapse& g) {
  const CosineBump along{g.x_center, 0.5 * g.length};
  const CosineStep across{g.y_start, g.gauge_side * g.width};
  return product_shape(g.depth, along, across,
                       {along.begin(), along.end(), g.gauge_side < 0 ? -kEverywhere : g.y_start,
                        g.gauge_side < 0 ? g.y_start : kEverywhere});
}

}  // namespace treadmark::analytic
