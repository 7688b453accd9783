// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/surface.hpp"

namespace treadmark::scans::scanner {

/// Whether the surface lies between a scanner that stands outside of it and one of its points. Errors:
/// Error(configuration) where it lies behind the scanner, too, in the direction of the beam.
bool in_shadow(const Surface& surface, const Vec3& stand_S, const Vec3& point_S);

}  // namespace treadmark::scans::scanner
