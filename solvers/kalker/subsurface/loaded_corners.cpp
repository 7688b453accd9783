// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/loaded_corners.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::kalker {

namespace {

constexpr double kLeastDistance = 1e-10;  // of an element's size

std::span<const double> field_of(const SurfaceTractions& tractions, SurfaceLoad load) {
  switch (load) {
    case SurfaceLoad::x:
      return tractions.traction_x;
    case SurfaceLoad::y:
      return tractions.traction_y;
    case SurfaceLoad::normal:
      break;
  }
  return tractions.pressure;
}

void check_field(std::span<const double> field, const Grid2& grid, const char* name, bool may_be_empty) {
  if (may_be_empty && field.empty()) return;
  if (field.size() != grid.size())
    throw Error(ErrorKind::configuration, std::string("stresses below the surface: ") + name + " has " +
                                              std::to_string(field.size()) + " values on a grid of " +
                                              std::to_string(grid.size()) + " elements");
  if (!std::all_of(field.begin(), field.end(), [](double value) { return std::isfinite(value); }))
    throw Error(ErrorKind::configuration,
                std::string("stresses below the surface: ") + name + " has values that are not finite");
}

/// Traction of element (ix, iy), 0 outside the grid.
double traction_at(const SurfaceTractions& tractions, SurfaceLoad load, int ix, int iy) {
  const Grid2& grid = tractions.grid;
  if (ix < 0 || iy < 0 || ix >= grid.nx || iy >= grid.ny) return 0.0;
  return traction(tractions, load, grid.index(ix, iy));
}

}  // namespace

SurfaceTractions surface_tractions(const Grid2& grid, const ContactSolution& solution) {
  return {grid, solution.pressure, solution.traction_x, solution.traction_y};
}

double traction(const SurfaceTractions& tractions, SurfaceLoad load, std::size_t i) {
  const std::span<const double> field = field_of(tractions, load);
  return field.empty() ? 0.0 : field[i];
}

void check_tractions(const SurfaceTractions& tractions) {
  const Grid2& grid = tractions.grid;
  if (grid.nx < 1 || grid.ny < 1 || !(grid.dx > 0.0) || !(grid.dy > 0.0))
    throw Error(ErrorKind::configuration, "stresses below the surface need a grid with elements of positive size");
  check_field(tractions.pressure, grid, "pressure", false);
  check_field(tractions.traction_x, grid, "traction_x", true);
  check_field(tractions.traction_y, grid, "traction_y", true);
}

double least_distance(const Grid2& grid) { return kLeastDistance * std::min(grid.dx, grid.dy); }

std::vector<LoadedCorner> loaded_corners(const SurfaceTractions& tractions) {
  const Grid2& grid = tractions.grid;
  std::vector<LoadedCorner> corners;
  for (int iy = 0; iy <= grid.ny; ++iy)
    for (int ix = 0; ix <= grid.nx; ++ix) {
      LoadedCorner corner{grid.x0 + (ix - 0.5) * grid.dx, grid.y0 + (iy - 0.5) * grid.dy, {}};
      for (std::size_t k = 0; k < kSurfaceLoads; ++k) {
        const auto at = [&](int jx, int jy) { return traction_at(tractions, static_cast<SurfaceLoad>(k), jx, jy); };
        corner.weight[k] = (at(ix, iy) - at(ix - 1, iy)) - (at(ix, iy - 1) - at(ix - 1, iy - 1));
      }
      if (corner.weight != std::array<double, kSurfaceLoads>{}) corners.push_back(corner);
    }
  return corners;
}

}  // namespace treadmark::kalker
