// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/contact_patch.hpp"
#include "treadmark/detection/gap_field.hpp"

namespace treadmark::detection {

/// The tangent plane of a patch: frame C with origin on the rail at the contact reference, x as in T, s along the rail
/// profile, n into the rail; T rolled by the contact angle.
struct ContactFrame {
  Pose X_TC;
  double angle = 0.0;  ///< contact angle [rad]
};

/// Contact frame of a patch. Errors: Error(numerical) if the rail has no surface at the contact reference.
ContactFrame contact_frame(const BodyPair& bodies, const ContactPatch& patch);

/// Elements of a potential contact area.
struct PotentialContactSettings {
  double dx = 0.0, ds = 0.0;  ///< element sizes [m]
  int max_elements = 20000;   ///< above it dx and ds are doubled in turn; 0: they stay as they are
  /// Where the contact reference lies in the axes of the grid [m]: elements lie at whole multiples of dx, ds from
  /// another origin, so that the grids of a sequence in time line up.
  Vec2 reference = Vec2::Zero();
};

/// Potential contact area: elements at whole multiples of dx, ds from the contact reference that cover the
/// interpenetration with one extra element all round; lateral positions are arc lengths along the rail.
/// Errors: Error(configuration) for an absurd number of elements.
Grid2 potential_contact_grid(const BodyPair& bodies, const ContactPatch& patch, const ContactFrame& frame,
                             const PotentialContactSettings& settings);

}  // namespace treadmark::detection
