// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/detection/wheel_facets.hpp"

namespace treadmark::detection {

/// Both bodies as the search of the reference program (CONTACT) sees them. Only for agreement with its results.
struct SearchMesh {
  WheelFacets wheel;
  /// The rail's inclination at a lateral position is taken from its section here for all positions along x [m], frame
  /// T.
  double rail_section_x = 0.0;
};

}  // namespace treadmark::detection
