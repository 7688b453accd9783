// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::displacement {

/// Normal and principal curvatures of the displaced surface at q [surface frame]; c = q moved back lies on the base,
/// which found `below` there. The directions of the base's curvatures are known if it is one profile; otherwise its
/// second derivatives are central differences of its slopes in its own tangent plane over +-1e-5 m. Those of the
/// offsets are exact.
void fill_shape(const Surface& base, Body body, const Vec3& q, const Vec3& c, const SurfacePoint& below,
                const OffsetJet& offset, SurfacePoint& point);

}  // namespace treadmark::displacement
