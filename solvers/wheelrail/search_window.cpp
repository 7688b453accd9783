// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/search_window.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/contact_program/rail_sections.hpp"
#include "treadmark/solvers/wheelrail/element_choice.hpp"

namespace treadmark::wheelrail {
namespace {

int odd(int n) { return n % 2 == 0 ? n + 1 : n; }

int checked_count(double n) {
  if (!(n < 1e6))
    throw Error(ErrorKind::configuration, "the element sizes dx, ds are too small for the contact search", {},
                "use elements of the order of a tenth of a millimetre or larger");
  return static_cast<int>(n);
}

// The wheel circle is followed over +-0.2 rad: further out no wheel can touch a rail or roller.
constexpr double kHalfAngle = 0.2;

// One grid whose steps follow dx, ds, and the wheel on facets between sections.
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
  facets.lines = detection::mesh_lines(*geometry.wheel, detection::lowest_angle(placed.X_TA), facets.lateral_step);
  const detection::LongitudinalRange range = detection::facet_range(*geometry.wheel, placed.X_TA, facets);
  grid.nx = facets.sections;
  grid.dx = (range.x_max - range.x_min) / (grid.nx - 1);
  grid.x0 = range.x_min;
  grid.dy = (steep ? 0.3 : 0.75) * d.ds;
  grid.ny = checked_count(std::floor((rail.y_max - rail.y_min) / grid.dy)) + 1;
  grid.y0 = 0.5 * (rail.y_min + rail.y_max) - 0.5 * (grid.ny - 1) * grid.dy;
  return grid;
}

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

/// Rows of the reference program's locus; none for elements so small that Treadmark's own locus, whose rows follow the
/// contact, has to do.
std::optional<detection::LocusRows> locus_rows(const Problem& p, const LateralRange& rail) {
  constexpr double kMostRows = 1e5;
  const double step = 0.3 * p.discretisation.ds, rows = std::ceil((rail.y_max - rail.y_min) / step) + 1.0;
  if (!(rows < kMostRows)) return std::nullopt;
  return detection::LocusRows{rail.y_min, step, to_whole<int>(rows), p.wheelset.nominal_radius,
                              p.roller ? p.roller->nominal_radius : 0.0};
}

}  // namespace

std::optional<detection::DistanceMesh> distance_mesh(const Problem& p) {
  if (!p.discretisation.distance_on_mesh) return std::nullopt;
  return detection::DistanceMesh{p.wheelset.nominal_radius, !p.roller};
}

detection::SearchSettings search_settings(const Geometry& geometry, const Problem& p, const Placement& placed) {
  const Discretisation& d = p.discretisation;
  if (!(d.dx > 0.0) || !(d.ds > 0.0)) throw Error(ErrorKind::configuration, "element sizes dx, ds must be positive");
  if (!(p.wheelset.nominal_radius > 0.0))
    throw Error(ErrorKind::configuration, "the nominal wheel radius must be positive");
  const LateralRange rail = visible_range(*geometry.rail, placed.X_TS.inverse(), placed.X_TA.origin.x());

  detection::SearchSettings s;
  s.method = d.search_method;
  const bool locus = d.search == Discretisation::SearchGrid::reference_locus;
  s.refine = locus || d.search == Discretisation::SearchGrid::refined;
  s.grid_T =
      s.refine ? coarse_grid(p, placed, rail) : reference_grid(geometry, p, placed, rail, s.mesh.emplace().wheel);
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
