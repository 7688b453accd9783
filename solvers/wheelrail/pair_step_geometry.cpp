// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Where the patches of a step lie: contact frame, elements, undeformed distance, and the patches of the previous
// instant they continue.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/contact_program/wheel_mesh.hpp"
#include "treadmark/solvers/wheelrail/pair_step.hpp"

namespace treadmark::wheelrail {
namespace {

/// Signed arc length along the rail's section through a point seen from above: as the rail's own data have it, else
/// from y = 0 of the profile.
double profile_arc_length(const Surface& rail, const Pose& X_TR, const Vec3& point_T) {
  const Vec2 above(point_T.x(), point_T.y());
  SurfacePoint found;
  rail.locate(X_TR.inverse(), {&above, 1}, {&found, 1});
  if (!std::isnan(found.arc_length)) return found.arc_length;
  const Vec3 point_R = X_TR.apply_inverse(point_T);
  constexpr int kSteps = 400;
  const double step = std::abs(point_R.y()) / kSteps;
  if (step == 0.0) return 0.0;
  std::vector<double> z(kSteps + 1);
  rail.heights({Pose{}, {point_R.x(), std::min(0.0, point_R.y()), 1.0, step, 1, kSteps + 1}}, {z, {}, {}});
  double length = 0.0;
  for (std::size_t i = 1; i < z.size(); ++i) {
    const double dz = z[i] - z[i - 1];
    length += std::isnan(dz) ? step : std::hypot(step, dz);
  }
  return std::copysign(length, point_R.y());
}

Rectangle extent_of(const Grid2& g) { return {g.x0, g.x(g.nx - 1), g.y0, g.y(g.ny - 1)}; }

/// The normal of a steep plane can meet another part of a section before the one that touches: bodies then seem to lie
/// deeper in each other than they can. Such elements have no distance. Returns whether there are any.
bool leave_out_other_parts(double deepest, detection::UndeformedDistance& u) {
  if (!(u.approach > deepest)) return false;
  double least = kInfinity;
  for (double& h : u.distance) {
    if (u.approach - h > deepest)
      h = kNaN;
    else if (h < least)
      least = h;
  }
  for (double& h : u.distance) h -= least;
  u.approach -= least;
  return true;
}

bool inside(const Rectangle& r, double x, double y, double margin_x, double margin_y) {
  return x >= r.x_min - margin_x && x <= r.x_max + margin_x && y >= r.y_min - margin_y && y <= r.y_max + margin_y;
}

}  // namespace

void PairStep::link(const Rectangle& box, Patch& patch) const {
  patch.solution.came_from.clear();
  if (problem_.history == kalker::HistoryUse::start) return;
  // Steady grids have their origin at the contact reference, aligned ones at a place that stays.
  const double shift = problem_.regime == kalker::Regime::shift ? previous_.s : 0.0;
  Rectangle here = box;
  here.x_min -= shift, here.x_max -= shift;
  patch.before = overlapping(previous_, here);
  for (const PatchMemory* m : patch.before) patch.solution.came_from.push_back(m->id);
}

/// A patch that has parted leaves to each of its parts the tractions that are there.
void PairStep::take_over(const std::vector<Patch>& patches, Patch& patch) const {
  if (!aligned() || patch.before.empty()) return;
  const double shift = problem_.regime == kalker::Regime::shift ? previous_.s : 0.0;
  std::vector<kalker::ContactHistory> parts;
  for (const PatchMemory* m : patch.before) {
    std::vector<Rectangle> others;
    for (const Patch& other : patches)
      if (&other != &patch && ranges::find(other.before, m) != other.before.end()) others.push_back(other.box);
    parts.push_back(own_share(on_raster(m->history, shift, problem_.discretisation.dx, problem_.discretisation.ds),
                              patch.box, others));
  }
  patch.history = united(parts, problem_.friction.static_friction(), problem_.material.layer_yield);
}

void PairStep::locate(const detection::ContactPatch& region, const detection::BodyPair& bodies, Patch& patch) {
  PatchSolution& s = patch.solution;
  const Discretisation& d = problem_.discretisation;
  s.region = region;
  s.frame = detection::contact_frame(bodies, region);
  const Pose& X_TC = s.frame.X_TC;
  s.reference_s = profile_arc_length(*geometry_.rail, placement_.X_TS, X_TC.origin);
  const ElementSize size = elements_.of(region, s.frame.angle);
  detection::PotentialContactSettings settings{size.dx, size.ds, aligned() ? 0 : d.max_elements, Vec2::Zero()};
  if (aligned())
    settings.reference = {
        X_TC.origin.x() + (problem_.regime == kalker::Regime::shift ? problem_.state.position.x : 0.0), s.reference_s};
  s.reference_C = settings.reference;
  s.grid = detection::potential_contact_grid(bodies, region, s.frame, settings);
  patch.box = extent_of(s.grid);
  Rectangle from_wheelset = patch.box;
  if (!aligned()) {
    from_wheelset.x_min += X_TC.origin.x(), from_wheelset.x_max += X_TC.origin.x();
    from_wheelset.y_min += s.reference_s, from_wheelset.y_max += s.reference_s;
  }
  link(from_wheelset, patch);
}

std::vector<LaidPatch> PairStep::lay(double z, std::span<const PatchSolution> patches) {
  placement_ = start_;
  const double dz = z - start_z_;
  lower(dz), z_ = z;
  const detection::SearchResult found = search_->at(dz);
  const detection::BodyPair bodies = detection::moved(bodies_, dz);
  std::vector<char> taken(found.patches.size(), 0);
  std::vector<LaidPatch> out;
  for (const PatchSolution& patch : patches) {
    // the place that is nearest to where the patch was
    double nearest = kInfinity;
    std::size_t here = found.patches.size();
    for (std::size_t k = 0; k < found.patches.size(); ++k) {
      const double away = std::hypot(found.patches[k].x - patch.region.x, found.patches[k].y - patch.region.y);
      if (taken[k] == 0 && away < nearest) nearest = away, here = k;
    }
    if (here == found.patches.size()) return out;
    taken[here] = 1;
    LaidPatch& laid = out.emplace_back();
    laid.region = found.patches[here];
    laid.frame = detection::contact_frame(bodies, laid.region);
    laid.reference_s = profile_arc_length(*geometry_.rail, placement_.X_TS, laid.frame.X_TC.origin);
    const Pose X_CP{{-patch.reference_C.x(), -patch.reference_C.y(), 0.0}, Mat3::Identity()};
    detection::UndeformedDistance undeformed =
        detection::undeformed_distance(bodies, laid.frame.X_TC * X_CP, patch.grid);
    laid.gap = std::move(undeformed.distance);
    for (double& gap : laid.gap) gap -= undeformed.approach;
  }
  return out;
}

/// Of the elements, in T; where there is no rail on the reference surface. On a steep plane a place is far from the
/// foot of its element.
std::vector<Vec2> PairStep::places_on_rail(const detection::BodyPair& bodies, const Patch& patch) const {
  const PatchSolution& s = patch.solution;
  const Grid2& grid = s.grid;
  const Pose& X_TC = s.frame.X_TC;
  std::vector<double> rail = patch.surfaces.rail;
  const Pose X_CP{{-s.reference_C.x(), -s.reference_C.y(), 0.0}, Mat3::Identity()};
  if (rail.empty()) {
    rail.resize(grid.size());
    bodies.rail->heights({bodies.X_TR.inverse() * X_TC * X_CP, grid}, {rail, {}, {}});
  }
  std::vector<Vec2> places;
  for (int iy = 0; iy < grid.ny; ++iy) {
    const Pose X_TL = X_TC * (patch.reference ? patch.reference->X_CL(iy) : X_CP);
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double n = rail[grid.index(ix, iy)];
      const Vec3 p = X_TL.apply({grid.x(ix), patch.reference ? 0.0 : grid.y(iy), std::isnan(n) ? 0.0 : n});
      places.emplace_back(p.x(), p.y());
    }
  }
  return places;
}

/// Undeformed distance on the grid, of a tangent plane or a curve, and the part of it that may touch.
void PairStep::measure_distance(const detection::BodyPair& bodies, Patch& patch) const {
  PatchSolution& s = patch.solution;
  if (patch.history) s.grid = extended(s.grid, *patch.history);
  const Discretisation& d = problem_.discretisation;
  const Pose& X_TC = s.frame.X_TC;
  detection::UndeformedDistance undeformed;
  if (problem_.reference_surface == ReferenceSurface::plane) {
    const Pose X_TP = X_TC * Pose{{-s.reference_C.x(), -s.reference_C.y(), 0.0}, Mat3::Identity()};
    undeformed = detection::undeformed_distance(bodies, X_TP, s.grid);
  } else {
    const bool curved = problem_.reference_surface == ReferenceSurface::curved;
    patch.reference = curved ? detection::curved_reference(bodies, s.frame, s.grid, s.reference_C)
                             : detection::plane_reference(s.grid, s.reference_C);
    patch.surfaces = detection::facing_surfaces(bodies, X_TC, s.grid, *patch.reference);
    if (curved && bodies.distance_mesh) {
      undeformed = detection::projected_distance(bodies, X_TC, s.grid, *patch.reference);
      for (std::size_t i = 0; i < s.grid.size(); ++i)
        patch.surfaces.wheel[i] = patch.surfaces.rail[i] - undeformed.distance[i] + undeformed.approach;
    } else {
      undeformed = detection::undeformed_distance(patch.surfaces);
    }
    if (curved) s.row_angle = patch.reference->angles();
  }
  patch.parts = {};
  if (s.region.parts.size() > 1) patch.parts = sub_patches(d, s.region, places_on_rail(bodies, patch));
  patch.part_hidden = leave_out_other_parts(deepest(), undeformed);
  s.distance = std::move(undeformed.distance);
  s.approach = undeformed.approach;
  patch.gap = s.distance;
  if (!patch.history) return;
  // What the grid was extended by holds tractions of the previous instant, but contact of this one belongs to another
  // patch.
  double least = std::numeric_limits<double>::infinity();
  const double margin = 0.25;
  for (int iy = 0; iy < s.grid.ny; ++iy)
    for (int ix = 0; ix < s.grid.nx; ++ix) {
      const std::size_t i = s.grid.index(ix, iy);
      if (!inside(patch.box, s.grid.x(ix), s.grid.y(iy), margin * d.dx, margin * d.ds))
        patch.gap[i] = std::numeric_limits<double>::quiet_NaN();
      else if (patch.gap[i] < least)
        least = patch.gap[i];
    }
  s.approach -= least;
  for (auto* field : {&s.distance, &patch.gap})
    for (double& h : *field) h -= least;
}

}  // namespace treadmark::wheelrail
