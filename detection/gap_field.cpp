// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/gap_field.hpp"

#include <cmath>

namespace treadmark::detection {

GapField gap_field(const BodyPair& bodies, const Grid2& grid_T, bool with_inclination,
                   const std::optional<WheelFacets>& facets) {
  GapField field;
  field.grid = grid_T;
  const std::size_t n = grid_T.size();
  field.rail_z.resize(n);
  field.gap.resize(n);
  if (with_inclination) field.inclination.resize(n);

  bodies.rail->heights({bodies.X_TR.inverse(), grid_T}, {field.rail_z, {}, field.inclination});
  if (facets) {
    field.wheel_z = facet_heights(*bodies.wheel, bodies.X_TW, *facets, grid_T);
  } else {
    field.wheel_z.resize(n);
    bodies.wheel->heights({bodies.X_TW.inverse(), grid_T}, {field.wheel_z, {}, {}});
  }
  for (std::size_t i = 0; i < n; ++i) field.gap[i] = field.rail_z[i] - field.wheel_z[i];
  for (double& slope : field.inclination) slope = std::atan(slope);
  return field;
}

}  // namespace treadmark::detection
