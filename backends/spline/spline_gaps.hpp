// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "treadmark/model/shape/spline_surface.hpp"

namespace treadmark::spline {

/// Gaps between sides of surfaces, in sentences: those that are said to meet, and others whose ends lie within 1 mm of
/// each other, where they are more than 1 um apart; surfaces that meet none. Empty: nothing to say. Errors:
/// Error(input_data) that names both where sides that are said to meet are more than 0.1 mm apart; those of
/// GivenSpline. met, if not null, gets the sides of two surfaces that do meet within 0.1 mm, each of them once.
std::string spline_gaps(std::span<const SplineSurface> surfaces, std::span<const SplineInterface> interfaces,
                        std::vector<SplineInterface>* met = nullptr);

}  // namespace treadmark::spline
