// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// Extent of a part of a patch in the common frame T.
struct PatchExtent {
  Rectangle box;                              ///< [m]
  double z_at_y_min = 0.0, z_at_y_max = 0.0;  ///< rail heights at the lateral ends [m]
  double x = 0.0, y = 0.0;                    ///< weighted contact reference [m]
};

/// One prospective contact patch: where the undeformed bodies interpenetrate, in the common frame T.
struct ContactPatch {
  PatchExtent extent;        ///< of the interpenetration
  double x = 0.0, y = 0.0;   ///< weighted contact reference [m]
  double inclination = 0.0;  ///< weighted contact angle [rad]
  double weight = 0.0;       ///< integral of the weight of the penetration: what it counts where patches become one
  double least_gap = 0.0;    ///< [m], negative
  Vec3 deepest_T = Vec3::Zero();  ///< point of least gap, on the rail
  /// Sub-patches that are solved together but influence each other less with growing distance; one = the patch itself.
  std::vector<PatchExtent> parts;
};

/// How the contact reference of a patch follows from the heights of both bodies along z of T, the points of the search
/// staying inside of each other or apart.
struct ReferenceChange {
  /// Where a height counts, and how.
  struct Place {
    Vec2 at_T;  ///< (x, y) [m]
    std::array<double, 3> by =
        {};  ///< of the reference's x, y [m/m] and of the inclination [rad/m], by the height there
  };
  std::vector<Place> rail;   ///< by heights of the rail [m]
  std::vector<Place> wheel;  ///< by heights of the wheel [m]
};

/// How neighbouring interpenetration regions become contact patches.
struct PatchRules {
  double angle_separation = 3.141592653589793;  ///< A_SEP [rad]
  double separation = 8e-3;                     ///< D_SEP [m]
  double combination = 4e-3;                    ///< D_COMB [m], <= D_SEP
  double turning = 12e-3;                       ///< D_TURN [m]; <= D_SEP: off
  double near_miss = -1e-3;  ///< G_MISS [m]; near misses with a smaller gap extend patches; negative = off
};

/// Combines, turns and sorts (field side first, then by x). Regions closer than D_COMB with similar angles become one
/// patch; those closer than D_SEP become one patch with several parts; of patches that stay apart but closer than
/// D_TURN the angles are turned towards each other, so that a merge is no jump. near_misses extend the patches near
/// them.
std::vector<ContactPatch> combine_patches(std::vector<ContactPatch> patches,
                                          const std::vector<ContactPatch>& near_misses, const PatchRules& rules);

/// Distance between two extents, height difference of the facing ends included [m].
double patch_distance(const PatchExtent& a, const PatchExtent& b);

/// Share of the elastic influence that two sub-patches at a distance have on each other: 1 up to D_COMB, 0 from D_SEP
/// on.
double sub_patch_coupling(double distance, const PatchRules& rules);

}  // namespace treadmark::detection
