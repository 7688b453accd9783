// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/undeformed_distance.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/detection/rail_sections.hpp"
#include "treadmark/detection/wheel_mesh.hpp"

namespace treadmark::detection {

UndeformedDistance undeformed_distance(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C) {
  std::vector<double> rail_n(grid_C.size()), wheel_n(grid_C.size());
  const bool on_sections = bodies.distance_mesh && bodies.distance_mesh->rail_sections &&
                           !bodies.rail->constant_profile() && section_heights(bodies, X_TC, grid_C, rail_n);
  if (!on_sections) bodies.rail->heights({bodies.X_TR.inverse() * X_TC, grid_C}, {rail_n, {}, {}});
  if (bodies.distance_mesh)
    mesh_heights(bodies, X_TC, grid_C, wheel_n);
  else
    bodies.wheel->heights({bodies.X_TW.inverse() * X_TC, grid_C}, {wheel_n, {}, {}});
  return undeformed_distance(std::move(rail_n), wheel_n);
}

UndeformedDistance undeformed_distance(std::vector<double> rail_n, std::span<const double> wheel_n) {
  UndeformedDistance result;
  result.distance = std::move(rail_n);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < wheel_n.size(); ++i) {
    result.distance[i] -= wheel_n[i];
    if (result.distance[i] < least) least = result.distance[i];
  }
  result.approach = -least;
  for (double& h : result.distance) h -= least;
  return result;
}

}  // namespace treadmark::detection
