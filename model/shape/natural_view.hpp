// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// The plane whose heights are the natural ones at station u: z of a rail over (x - u, y), the radius of a wheel over y
/// at theta = u (x along the circumference).
Pose natural_plane(Body body, double u);

/// Heights z or radii r at lateral positions y of one station, NaN where there is no surface; slopes may be empty.
void section_heights(const Surface& surface, Body body, double u, std::span<const double> y, const HeightsOut& out);

}  // namespace treadmark
