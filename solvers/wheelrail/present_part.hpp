// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/core/surface.hpp"

namespace treadmark::wheelrail {

/// Where a part of a wheel, such as a scanned sector, is not at the material angle that is lowest [rad]: what to say of
/// it, with the angles that it has (those that hold together about its widest piece, to a degree). Empty for a wheel
/// that is there.
std::string missing_part(const Surface& wheel, double lowest);

}  // namespace treadmark::wheelrail
