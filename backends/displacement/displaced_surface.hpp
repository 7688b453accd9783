// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>

#include "treadmark/backends/displacement/offset_field.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::displacement {

/// A base surface with offsets added: z of a rail, radius of a wheel. Exact up to rounding for the given field: a line
/// along the plane normal meets the displaced surface where the base is met by the line moved back by the offset.
/// Lateral parameters, arc length and data are those of the base at the place moved back.
/// backend: what Surface::backend() of the result says.
/// Thread-safe as every Surface. Errors: Error(configuration) for a missing base or field, or a body that does not
/// match the base's facing.
std::shared_ptr<const Surface> make_displaced_surface(std::shared_ptr<const Surface> base,
                                                      std::shared_ptr<const OffsetField> field, Body body,
                                                      std::string backend);

}  // namespace treadmark::displacement
