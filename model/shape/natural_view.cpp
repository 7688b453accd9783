// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/natural_view.hpp"

#include <vector>

#include "treadmark/core/parametric.hpp"

namespace treadmark {

Pose natural_plane(Body body, double u) { return station_plane(body == Body::rail ? Facing::up : Facing::down, u); }

void section_heights(const Surface& surface, Body body, double u, std::span<const double> y, const HeightsOut& out) {
  std::vector<Vec2> points(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) points[i] = {0.0, y[i]};
  surface.heights_at(natural_plane(body, u), points, out);
}

}  // namespace treadmark
