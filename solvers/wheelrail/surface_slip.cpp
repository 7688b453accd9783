// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/wheelrail/surface_slip.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/wheelrail/kinematics.hpp"

namespace treadmark::wheelrail {

namespace {

constexpr double kStanding = 1e-9;

/// Least-squares fit of slip (xi - y phi, eta + x phi).
class CreepageFit {
 public:
  void add(const Vec2& place, const Vec2& slip) {
    count_ += 1.0;
    places_ += place;
    slips_ += slip;
    squares_ += place.squaredNorm();
    turning_ += cross(place, slip);
  }
  void solve(ContactKinematics& k) const {
    k.xi = k.eta = k.phi = 0.0;
    if (count_ == 0.0) return;
    const Vec2 place = places_ / count_, slip = slips_ / count_;
    const double inertia = squares_ - count_ * place.squaredNorm();
    constexpr double kOnePoint = 1e-12;
    if (inertia > kOnePoint * squares_) k.phi = (turning_ - count_ * cross(place, slip)) / inertia;
    k.xi = slip.x() + k.phi * place.y();
    k.eta = slip.y() - k.phi * place.x();
  }

 private:
  static double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

  double count_ = 0.0, squares_ = 0.0, turning_ = 0.0;
  Vec2 places_ = Vec2::Zero(), slips_ = Vec2::Zero();
};

double rolling_velocity(const Problem& p, double at_reference) {
  if (p.regime == kalker::Regime::shift) return 1.0;
  const double travel = std::abs(p.roller ? p.roller->nominal_radius * p.roller->pitch_rate : p.state.velocity.x);
  return travel >= kStanding ? travel : at_reference;
}

/// How far from an element's centre the solver takes the slip of spin.
Vec2 spin_offset(const Problem& p, const Grid2& grid, double chi) {
  const bool steady = p.regime == kalker::Regime::steady;
  if (!steady && p.regime != kalker::Regime::transient) return Vec2::Zero();
  const double step = steady ? grid.dx : p.discretisation.dq_relative * grid.dx;
  return kalker::Rolling{}.spin_offset_factor * step * Vec2(std::cos(chi), std::sin(chi));
}

/// Heights of rail and wheel where a row's surfaces come closest; none: a surface is missing all along it.
struct RowHeights {
  double rail = 0.0, wheel = 0.0;
};
std::optional<RowHeights> closest_in_row(const Grid2& grid, int iy, const detection::FacingSurfaces& surfaces) {
  std::optional<RowHeights> closest;
  for (int ix = 0; ix < grid.nx; ++ix) {
    const std::size_t i = grid.index(ix, iy);
    const double rail = surfaces.rail[i], wheel = surfaces.wheel[i];
    if (std::isnan(rail - wheel)) continue;
    if (!closest || rail - wheel < closest->rail - closest->wheel) closest = {rail, wheel};
  }
  return closest;
}

void require_same_grid(const Grid2& grid, const detection::ReferenceRows& reference,
                       const detection::FacingSurfaces& surfaces) {
  if (reference.rows.size() != static_cast<std::size_t>(grid.ny) || surfaces.rail.size() != grid.size() ||
      surfaces.wheel.size() != grid.size())
    throw Error(ErrorKind::configuration, "rows, surfaces and grid of the rigid slip do not belong together");
}

}  // namespace

SurfaceSlip surface_slip(const Problem& p, const Placement& placed, const Pose& X_TC, const Grid2& grid,
                         const detection::ReferenceRows& reference, const detection::FacingSurfaces& surfaces,
                         const ContactKinematics& at_reference) {
  require_same_grid(grid, reference, surfaces);
  SurfaceSlip result{at_reference, std::vector<double>(grid.size()), std::vector<double>(grid.size()), {}};
  ContactKinematics& k = result.kinematics;
  k.velocity = rolling_velocity(p, at_reference.velocity);
  if (k.velocity < kStanding) return result;

  const MaterialVelocity material = material_velocity(p, placed);
  result.heights = {std::vector<double>(grid.size()), std::vector<double>(grid.size())};
  const Vec2 offset = spin_offset(p, grid, k.chi);
  const auto place = [&](int ix, int iy) -> Vec2 {
    return Vec2(grid.x(ix), grid.y(iy)) - reference.reference_C + offset;
  };
  const auto missing = [&](std::size_t i) { return std::isnan(surfaces.rail[i] - surfaces.wheel[i]); };
  CreepageFit fit;
  for (int iy = 0; iy < grid.ny; ++iy) {
    const auto heights = closest_in_row(grid, iy, surfaces);
    if (!heights) continue;
    const Pose X_TL = X_TC * reference.X_CL(iy);
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      result.heights.rail[i] = heights->rail;
      result.heights.wheel[i] = heights->wheel;
      if (missing(i)) continue;
      const Vec3 v_rail = material.rail.at(X_TL.apply({grid.x(ix), 0.0, heights->rail}));
      const Vec3 v_wheel = material.wheel.at(X_TL.apply({grid.x(ix), 0.0, heights->wheel}));
      const Vec3 slip_L = X_TL.rotation.transpose() * (v_rail - v_wheel) / k.velocity;
      result.extra_x[i] = slip_L.x();
      result.extra_y[i] = slip_L.y();
      if (surfaces.rail[i] < surfaces.wheel[i]) fit.add(place(ix, iy), slip_L.head<2>());
    }
  }
  fit.solve(k);
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i = grid.index(ix, iy);
      if (missing(i)) continue;
      const Vec2 at = place(ix, iy);
      result.extra_x[i] -= k.xi - k.phi * at.y();
      result.extra_y[i] -= k.eta + k.phi * at.x();
    }
  return result;
}

namespace {

/// Rigid penetration of the elements of one part; those of no part that touches have none.
double approach_of(const PatchSolution& patch, const kalker::SubPatches& parts, std::size_t k) {
  double approach = 0.0;
  for (std::size_t i = 0; i < parts.part.size(); ++i)
    if (parts.part[i] == k + 1) approach = std::max(approach, patch.approach - patch.distance[i]);
  return approach;
}

/// How much of the nearest other part a part feels.
double coupling_of(const kalker::SubPatches& parts, std::size_t k) {
  const auto count = static_cast<std::size_t>(parts.count);
  double most = 0.0;
  for (std::size_t j = 0; j < count; ++j)
    if (j != k) most = std::max(most, parts.coupling[k * count + j]);
  return most;
}

}  // namespace

PartSlip part_slip(const Problem& p, const Placement& placed, const Surface& rail, const PatchSolution& patch,
                   const kalker::SubPatches& parts) {
  PartSlip slip;
  if (parts.count < 2) return slip;
  const Grid2& g = patch.grid;
  slip.x.assign(g.size(), 0.0);
  slip.y.assign(g.size(), 0.0);
  slip.heights = {std::vector<double>(g.size(), 0.0), std::vector<double>(g.size(), patch.approach)};
  const ContactKinematics& whole = patch.kinematics;
  for (std::size_t k = 0; k < static_cast<std::size_t>(parts.count); ++k) {
    const detection::PatchExtent& extent = patch.region.parts[k];
    const double z = height_at(rail, placed.X_TS.inverse(), {extent.x, extent.y}),
                 own_share = 1.0 - coupling_of(parts, k);
    if (std::isnan(z) || !(own_share > 0.0)) continue;
    const Pose X_TP{{extent.x, extent.y, z}, patch.frame.X_TC.rotation};
    const double approach = approach_of(patch, parts, k);
    const ContactKinematics own = contact_kinematics(p, placed, X_TP, approach);
    const Vec3 reference = patch.frame.X_TC.apply_inverse(X_TP.origin);
    for (int iy = 0; iy < g.ny; ++iy)
      for (int ix = 0; ix < g.nx; ++ix) {
        const std::size_t i = g.index(ix, iy);
        if (parts.part[i] != k + 1) continue;
        const double x = g.x(ix) - patch.reference_C.x(), y = g.y(iy) - patch.reference_C.y();
        slip.x[i] = own_share * (own.xi - whole.xi - own.phi * (y - reference.y()) + whole.phi * y);
        slip.y[i] = own_share * (own.eta - whole.eta + own.phi * (x - reference.x()) - whole.phi * x);
        slip.heights.rail[i] = own_share * reference.z();
        slip.heights.wheel[i] += own_share * (reference.z() + approach - patch.approach);
      }
  }
  return slip;
}

}  // namespace treadmark::wheelrail
