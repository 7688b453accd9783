// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "treadmark/backends/analytic/graph_curve.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::analytic {

/// Wheel profile S1002 (EN 13715, UIC 510-2): tape circle at y = 0, field side y > 0, flange back at y = -70 mm,
/// z down. The zones are joined as published: steps up to 0.12 um, slopes within 3e-5.
GraphCurve s1002_curve();
/// Its polynomials, coefficients of powers of y in mm: -35 ... -26 mm and -26 ... 32.15796 mm.
std::span<const double> s1002_throat_powers();
std::span<const double> s1002_tread_powers();

/// Head of the rail profile 60E1 (EN 13674-1), symmetric, crown at the origin: R300, R80, R13 and the 1:20 sides down
/// to where the fillet to the lower head begins, about 35 mm below the crown.
ArcChain rail_60e1_chain();
/// The older UIC 60: the same radii, joints at half widths of 10.5 and 25.988 mm.
ArcChain rail_uic60_chain();

/// A profile by its name: a rail's chain or a wheel's curve. Errors: Error(configuration) for an unknown name, saying
/// where the known ones are listed, and for dimensions that the profile does not come in.
std::variant<ArcChain, GraphCurve> standard_curve(std::string_view name);

/// Body a standard profile belongs to. Errors: as above.
Body standard_profile_body(std::string_view name);

}  // namespace treadmark::analytic
