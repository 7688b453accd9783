// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

#include "treadmark/backends/analytic/graph_curve.hpp"
#include "treadmark/model/surface_spec.hpp"

namespace treadmark::analytic {

/// Wheel profile S1002 (EN 13715, UIC 510-2): tape circle at y = 0, field side y > 0, flange back at y = -70 mm,
/// z down. The zones are joined as published: steps up to 0.12 um, slopes within 3e-5.
GraphCurve s1002_curve();

/// Head of the rail profile 60E1 (EN 13674-1), symmetric, crown at the origin: R300, R80, R13 and the 1:20 sides down
/// to where the fillet to the lower head begins, about 35 mm below the crown.
ArcChain rail_60e1_chain();

/// Body a standard profile belongs to. Errors: Error(configuration) for an unknown name, listing the known ones.
Body standard_profile_body(std::string_view name);

}  // namespace treadmark::analytic
