// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/detection/undeformed_distance.hpp"

#include <limits>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"
#include "treadmark/detection/contact_program/wheel_mesh.hpp"

namespace treadmark::detection {

UndeformedDistance undeformed_distance(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid_C) {
  std::vector<double> rail_n(grid_C.size()), wheel_n(grid_C.size());
  rail_heights(bodies, X_TC, grid_C, rail_n);
  if (bodies.distance_mesh) {
    std::vector<double> rows_s(static_cast<std::size_t>(grid_C.ny));
    for (int iy = 0; iy < grid_C.ny; ++iy) rows_s[static_cast<std::size_t>(iy)] = grid_C.y(iy);
    mesh_heights(bodies, X_TC, grid_C, rows_s, rail_n, wheel_n);
  } else {
    bodies.wheel->heights({bodies.X_TW.inverse() * X_TC, grid_C}, {wheel_n, {}, {}});
  }
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

FacingSurfaces facing_surfaces(const BodyPair& bodies, const Pose& X_TC, const Grid2& grid,
                               const ReferenceRows& reference) {
  if (reference.rows.size() != static_cast<std::size_t>(grid.ny))
    throw Error(ErrorKind::configuration, "the reference surface has another number of rows than the grid of elements");
  FacingSurfaces surfaces{std::vector<double>(grid.size()), std::vector<double>(grid.size())};
  const auto width = static_cast<std::size_t>(grid.nx);
  const Pose X_RC = bodies.X_TR.inverse() * X_TC, X_WC = bodies.X_TW.inverse() * X_TC;
  const Grid2 row{grid.x0, 0.0, grid.dx, grid.dy, grid.nx, 1};
  for (int iy = 0; iy < grid.ny; ++iy) {
    const Pose X_CL = reference.X_CL(iy);
    const std::size_t first = grid.index(0, iy);
    bodies.rail->heights({X_RC * X_CL, row}, {{surfaces.rail.data() + first, width}, {}, {}});
    bodies.wheel->heights({X_WC * X_CL, row}, {{surfaces.wheel.data() + first, width}, {}, {}});
  }
  return surfaces;
}

UndeformedDistance undeformed_distance(const FacingSurfaces& surfaces) {
  return undeformed_distance(surfaces.rail, surfaces.wheel);
}

}  // namespace treadmark::detection
