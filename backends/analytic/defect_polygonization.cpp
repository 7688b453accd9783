// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defect_shapes.hpp"

namespace treadmark::analytic {

ShapePtr make_polygonization_shape(const Polygonization& p) {
  // whole orders: the sum has the period of theta by itself
  WaveSum waves;
  for (const auto& h : p.harmonics) waves.waves.push_back({static_cast<double>(h.order), h.amplitude, h.phase});
  return product_shape(1.0, std::move(waves), lateral_fading(p.y_center, p.width),
                       faded_support(-kEverywhere, kEverywhere, p.y_center, p.width));
}

}  // namespace treadmark::analytic
