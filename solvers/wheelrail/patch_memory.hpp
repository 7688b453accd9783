// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"

namespace treadmark::wheelrail {

/// Sequences in time: all grids of a sequence are parts of one raster (Vollebregt's super-grid). Its axes in the
/// contact plane are x along the track, from the wheelset (transient rolling) or from a fixed place of the track
/// (shift), and arc length s along the rail from y = 0 of its profile. Patches of two instants are the same where their
/// rectangles overlap.

/// What one patch leaves to the next instant; lengths in x from the wheelset's place along the track and s.
struct PatchMemory {
  std::uint64_t id = 0;
  Rectangle box;  ///< where the undeformed bodies interpenetrated [m]
  kalker::ContactHistory history;
  Vec3 force_C = Vec3::Zero();  ///< contact force on the rail without damping, contact axes [N]
  std::shared_ptr<const kalker::ContactSolver::State> solver;
};

/// Change of a patch's force by its tangential problem, over its normal force.
struct TangentialShare {
  Rectangle box;              ///< where the patch was, in T [m]
  double normal_force = 0.0;  ///< [N]
  Vec3 share = Vec3::Zero();  ///< in contact axes
};

/// One instant of a pair.
struct Instant {
  std::vector<PatchMemory> patches;
  double s = 0.0;  ///< of the wheelset along the track [m]
  std::vector<TangentialShare> shares;
  double stiffness = 0.0;  ///< vertical force / penetration^1.5 [N/m^1.5]; 0 = unknown
  double end_slope = 0.0;  ///< as in Balance
  std::uint64_t next_id = 1;
};

/// Patches whose rectangle overlaps the given one.
std::vector<const PatchMemory*> overlapping(const Instant& instant, const Rectangle& box);

/// Displaced along x [m] and moved to the nearest raster lines of steps dx, ds.
/// Errors: Error(configuration) for elements of another size.
kalker::ContactHistory on_raster(const kalker::ContactHistory& history, double shift_x, double dx, double ds);

/// What of a history on a raster lies nearer to box than to any of the others; tractions elsewhere are theirs, zero
/// here. Rectangles in the axes of the raster.
kalker::ContactHistory own_share(kalker::ContactHistory history, const Rectangle& box,
                                 const std::vector<Rectangle>& others);

/// Several histories on one raster as one: tractions are added up, friction and yield stress are those of the patch
/// that presses most.
kalker::ContactHistory united(const std::vector<kalker::ContactHistory>& histories, double static_friction,
                              double first_yield_stress);

/// The grid with as many further rows and columns as it takes to hold all elements under pressure.
Grid2 extended(const Grid2& grid, const kalker::ContactHistory& history);

}  // namespace treadmark::wheelrail
