// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/model/contact/material.hpp"

namespace treadmark::wheelrail {

/// A patch that was solved, and errors that the gap in it may have.
struct UncertainPatch {
  Grid2 grid;                               ///< elements, contact axes [m]
  std::span<const double> gap;              ///< undeformed distance h, NaN = no surface [m]
  double approach = 0.0;                    ///< [m]
  double normal_force = 0.0;                ///< sum of its pressures [N]
  double vertical_force = 0.0;              ///< what it carries of the wheel's load [N]
  double lowering = 1.0;                    ///< of the approach, as the wheel comes down: cosine of the contact angle
  std::vector<std::vector<double>> errors;  ///< draws: by how much the gap of each row of elements would be larger [m]
};

/// What errors leave uncertain of a patch: standard deviations.
struct ErrorSpread {
  double pressure = 0.0, area = 0.0, force = 0.0;  ///< largest pressure, contact area, normal force, over their values
  double approach = 0.0;                           ///< from where the undeformed bodies would touch [m]
  double place = 0.0;                              ///< of the middle of pressures across the rolling direction [m]
};

/// Solves the normal problem of the patches of one pair again, without errors and with each draw of them: of one number
/// for all patches, and draws of the same number belong together. The wheel stays where it is, or, with a vertical
/// force that is given, comes to where its patches carry together what they carried; contact planes and what tractions
/// add to that force stay. Pressures are exact (half-spaces) whatever those of the patches were, on as many elements as
/// tell their changes. Costs a normal problem for each draw and patch, some three of them where several patches share a
/// given force. Nothing for a patch that so has no force near its own. Thread-safe, deterministic; Cancelled as core/.
std::vector<std::optional<ErrorSpread>> error_spread(std::span<const UncertainPatch> patches, const Material& material,
                                                     bool force_given);

}  // namespace treadmark::wheelrail
