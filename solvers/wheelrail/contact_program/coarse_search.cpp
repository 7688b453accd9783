// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/contact_program/coarse_search.hpp"

#include <cmath>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"

namespace treadmark::wheelrail {

Grid2 reference_grid(const Geometry& geometry, const Problem& p, const Placement& placed, const LateralRange& rail,
                     detection::WheelFacets& facets) {
  const Discretisation& d = p.discretisation;
  const double radius = p.wheelset.nominal_radius;
  const bool steep = d.search == Discretisation::SearchGrid::reference_steep;
  Grid2 grid;
  if (geometry.round_wheel) {
    constexpr double kSmallWheel = 30.5e-3;
    facets.kind = detection::WheelFacets::Sections::planes;
    facets.half_range = (steep || radius < kSmallWheel) ? 0.242 * radius : radius / 8.0;
    facets.sections = odd(checked_count(std::round(2.0 * facets.half_range / (1.5 * d.dx) + 2.0)));
  } else {
    facets.half_range = kHalfAngle;
    facets.sections = odd(checked_count(std::round(2.0 * kHalfAngle * radius / (4.0 * d.dx) + 2.0)));
  }
  facets.lines = detection::mesh_lines(*geometry.wheel, detection::lowest_angle(placed.X_TA));
  const detection::LongitudinalRange range = detection::facet_range(*geometry.wheel, placed.X_TA, facets);
  grid.nx = facets.sections;
  grid.dx = (range.x_max - range.x_min) / (grid.nx - 1);
  grid.x0 = range.x_min;
  grid.dy = (steep ? 0.3 : 0.75) * d.ds;
  grid.ny = checked_count(std::floor((rail.y_max - rail.y_min) / grid.dy)) + 1;
  grid.y0 = 0.5 * (rail.y_min + rail.y_max) - 0.5 * (grid.ny - 1) * grid.dy;
  return grid;
}

std::optional<detection::LocusRows> locus_rows(const Problem& p, const LateralRange& rail) {
  constexpr double kMostRows = 1e5;
  const double step = 0.3 * p.discretisation.ds, rows = std::ceil((rail.y_max - rail.y_min) / step) + 1.0;
  if (!(rows < kMostRows)) return std::nullopt;
  return detection::LocusRows{rail.y_min, step, to_whole<int>(rows), p.wheelset.nominal_radius,
                              p.roller ? p.roller->nominal_radius : 0.0};
}

std::optional<detection::DistanceMesh> distance_mesh(const Problem& p) {
  if (p.solver.conventions != Conventions::contact) return std::nullopt;
  return detection::DistanceMesh{p.wheelset.nominal_radius, !p.roller};
}

}  // namespace treadmark::wheelrail
