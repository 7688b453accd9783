// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/search_window.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/wheelrail/contact_program/coarse_search.hpp"
#include "treadmark/solvers/wheelrail/element_choice.hpp"
#include "treadmark/solvers/wheelrail/rail_memory.hpp"

namespace treadmark::wheelrail {

int checked_count(double n) {
  if (!(n < 1e6))
    throw Error(ErrorKind::configuration, "the element sizes dx, ds are too small for the contact search", {},
                "use elements of the order of a tenth of a millimetre or larger");
  return to_whole<int>(n);
}

namespace {

Grid2 coarse_grid(const Problem& p, const Placement& placed, const LateralRange& rail) {
  const Discretisation& d = p.discretisation;
  constexpr double kStepX = 1e-3, kStepY = 0.25e-3;
  const double half = p.wheelset.nominal_radius * std::sin(kHalfAngle);
  // Small bodies (a ball in a groove) need steps that follow their size.
  const double step_x = std::min(std::max(kStepX, 1.5 * d.dx), half / 50.0);
  const double step_y = std::min(std::max(kStepY, 0.75 * d.ds), (rail.y_max - rail.y_min) / 50.0);
  Grid2 grid;
  grid.nx = odd(checked_count(std::ceil(2.0 * half / step_x)));
  grid.dx = 2.0 * half / (grid.nx - 1);
  grid.x0 = placed.X_TA.origin.x() - half;
  grid.ny = checked_count(std::ceil((rail.y_max - rail.y_min) / step_y)) + 1;
  grid.dy = (rail.y_max - rail.y_min) / (grid.ny - 1);
  grid.y0 = rail.y_min;
  return grid;
}

}  // namespace

detection::SearchSettings search_settings(const Geometry& geometry, const Problem& p, const Placement& placed,
                                          RailMemory* memory) {
  const Discretisation& d = p.discretisation;
  if (!(d.dx > 0.0) || !(d.ds > 0.0)) throw Error(ErrorKind::configuration, "element sizes dx, ds must be positive");
  if (!(p.wheelset.nominal_radius > 0.0))
    throw Error(ErrorKind::configuration, "the nominal wheel radius must be positive");
  RailMemory own(*geometry.rail);
  const LateralRange rail = (memory ? *memory : own).visible(placed.X_TS, placed.X_TA.origin.x());

  detection::SearchSettings s;
  s.method = d.search_method;
  const bool locus = d.search == Discretisation::SearchGrid::reference_locus;
  s.refine = locus || d.search == Discretisation::SearchGrid::refined;
  s.grid_T = s.refine ? coarse_grid(p, placed, rail) : reference_grid(geometry, p, placed, rail, s.facets.emplace());
  if (locus) s.locus_rows = locus_rows(p, rail);
  const bool chosen = chooses_elements(p);
  s.refined_dx = 0.3 * (chosen && d.choose_dx ? kShortestElement : d.dx);
  s.refined_dy = 0.3 * (chosen && d.choose_ds ? kShortestElement : d.ds);
  s.refined_points = geometry.constant_profiles() ? 64 : 120;
  s.weight = d.linear_weight ? detection::PenetrationWeight::linear : detection::PenetrationWeight::squared;
  s.reference_at_deepest = d.reference_at_deepest;
  s.rules.angle_separation = d.angle_separation;
  s.rules.separation = d.separation;
  s.rules.combination = d.combination;
  s.rules.turning = d.turning.value_or(2.0 * d.separation - d.combination);
  s.rules.near_miss = d.near_miss;
  return s;
}

}  // namespace treadmark::wheelrail
