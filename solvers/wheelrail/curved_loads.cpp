// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/curved_loads.hpp"

#include "treadmark/core/error.hpp"

namespace treadmark::wheelrail {
namespace {

void require_rows(const detection::ReferenceRows& reference, const Grid2& grid) {
  if (reference.rows.size() != static_cast<std::size_t>(grid.ny))
    throw Error(ErrorKind::configuration, "the reference surface has another number of rows than the grid of elements");
}

}  // namespace

Wrench resultant_on(const detection::ReferenceRows& reference, const Grid2& grid, const kalker::ContactSolution& c) {
  require_rows(reference, grid);
  const bool tangential = !c.traction_x.empty();
  Wrench sum;
  for (int iy = 0; iy < grid.ny; ++iy) {
    const Pose X_CL = reference.X_CL(iy);
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      if (c.pressure[i] == 0.0) continue;
      const Vec3 traction_L(tangential ? c.traction_x[i] : 0.0, tangential ? c.traction_y[i] : 0.0, c.pressure[i]);
      const Vec3 force = X_CL.rotation * traction_L * grid.cell_area();
      sum.force += force;
      sum.moment += X_CL.apply({grid.x(ix), 0.0, 0.0}).cross(force);
    }
  }
  return sum;
}

kalker::InfluenceSettings influence_on(const detection::ReferenceRows& reference, const Grid2& grid,
                                       kalker::InfluenceSettings given) {
  if (given.kind != kalker::InfluenceSettings::Kind::angle_corrected) return given;
  require_rows(reference, grid);
  given.inclination = reference.angles();
  given.position.clear();
  for (int iy = 0; iy < grid.ny; ++iy) given.position.push_back(grid.y(iy));
  return given;
}

std::vector<FrictionLaw> friction_on(const detection::ReferenceRows& reference, double contact_angle,
                                     const Problem& p) {
  std::vector<FrictionLaw> laws;
  if (p.friction_laws.empty()) return laws;
  for (const detection::ReferenceRow& row : reference.rows)
    laws.push_back(friction_at(p.friction_inclination, p.friction_laws, contact_angle + row.angle, p.friction));
  return laws;
}

}  // namespace treadmark::wheelrail
