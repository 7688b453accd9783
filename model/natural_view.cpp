// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/natural_view.hpp"

#include <cmath>
#include <vector>

namespace treadmark {

Pose natural_plane(Body body, double u) {
  Pose X;
  if (body == Body::rail) {
    X.origin.x() = u;
    return X;
  }
  const double s = std::sin(u), c = std::cos(u);
  X.rotation.col(0) = Vec3(c, 0.0, -s);
  X.rotation.col(1) = Vec3::UnitY();
  X.rotation.col(2) = Vec3(s, 0.0, c);
  return X;
}

void section_heights(const Surface& surface, Body body, double u, std::span<const double> y, const HeightsOut& out) {
  std::vector<Vec2> points(y.size());
  for (std::size_t i = 0; i < y.size(); ++i) points[i] = {0.0, y[i]};
  surface.heights_at(natural_plane(body, u), points, out);
}

}  // namespace treadmark
