// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/detection/undeformed_distance.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/wheelrail/kinematics.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// The rigid slip of the surfaces, relative to V: creepages and spin that fit it best, and what remains of it.
struct SurfaceSlip {
  ContactKinematics kinematics;          ///< creepages and spin about the contact reference, V, chi
  std::vector<double> extra_x, extra_y;  ///< per element [-] (shift: [m]), 0 where a surface is missing
  SlipHeights heights;                   ///< empty for a standing wheel
};

/// Rigid slip of every element from the velocities of the rail's and the wheel's material, each on its own undeformed
/// surface, in the local axes of the element's row (Vollebregt 2021). The depth of a row is taken where its surfaces
/// come closest: along x, as in theory of half-spaces, speeds do not change with the surfaces' heights. Creepages and
/// spin are fitted by least squares over the interpenetration, the spin as the solver will see it
/// (Rolling::spin_offset_factor), so that both together give back the slip of the element centres. at_reference:
/// creepages at the contact reference (contact_kinematics), whose chi is kept; V is the wheelset's travelling speed (a
/// roller's surface speed), and at_reference's where that stands still. A standing wheel has no slip.
/// Errors: Error(configuration) for rows or surfaces that do not belong to the grid. Thread-safe.
SurfaceSlip surface_slip(const Problem& right_hand_problem, const Placement& placement, const Pose& X_TC,
                         const Grid2& grid, const detection::ReferenceRows& reference,
                         const detection::FacingSurfaces& surfaces, const ContactKinematics& at_reference);

/// Rigid slip of the elements of a patch of several parts beyond its creepages and spin, per element [-] (shift: [m]).
struct PartSlip {
  std::vector<double> x, y;  ///< empty for a patch of one part
  SlipHeights heights;       ///< likewise
};

/// Every part creeps as about its own contact reference where it feels little of the others, and with the patch where
/// it feels all of them: patches that join or part do not change their slip at once. With one reference alone parts
/// that lie off its tangent plane would. rail: the surface placed by placement.X_TS. Thread-safe.
PartSlip part_slip(const Problem& right_hand_problem, const Placement& placement, const Surface& rail,
                   const PatchSolution& patch, const kalker::SubPatches& parts);

}  // namespace treadmark::wheelrail
