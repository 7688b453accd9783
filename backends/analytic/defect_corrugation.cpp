// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <numbers>

#include "treadmark/backends/analytic/defect_shapes.hpp"

namespace treadmark::analytic {

ShapePtr make_corrugation_shape(const Corrugation& c) {
  WaveSum waves{c.x_start, {}};
  for (const auto& w : c.waves) waves.waves.push_back({2.0 * std::numbers::pi / w.wavelength, w.amplitude, w.phase});
  const CosineWindow window{c.x_start, c.x_end, c.ramp};
  return product_shape(1.0, FunctionProduct<WaveSum, CosineWindow>{std::move(waves), window},
                       lateral_fading(c.y_center, c.width), faded_support(c.x_start, c.x_end, c.y_center, c.width));
}

}  // namespace treadmark::analytic
