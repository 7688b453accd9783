// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::assembly {

/// Several surfaces of one frame as one body: over each point of a plane the outermost of them counts, the least height
/// of rails, the greatest of wheels; nothing where none of them is. Located points come from the part that wins, with
/// its parameters, but without arc length, since every part has a zero of its own; no data are told for the same
/// reason. Height bounds hold all parts, also hidden ones. backend() names the backends of the parts, joined by
/// "+". Never of constant profile: sections may have gaps. Thread-safe as every Surface. Errors: Error(configuration)
/// without parts, or if they do not all face the same way.
std::shared_ptr<const Surface> outermost_of(std::vector<std::shared_ptr<const Surface>> parts);

}  // namespace treadmark::assembly
