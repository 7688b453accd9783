// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/core/surface.hpp"

namespace treadmark::assembly {

/// A surface whose own frame B has pose X_SB in the frame S of the result; it faces the same way and keeps its
/// parameters and data. Arc length changes its sign where y does.
/// Thread-safe as every Surface. Errors: Error(configuration) without a surface.
std::shared_ptr<const Surface> place_surface(std::shared_ptr<const Surface> surface, const Pose& X_SB);

/// A roller in the frame of a rail: a wheel, whose axle is laid at z = radius [m] of the rail frame and which is turned
/// by half a turn about x, so that it faces up: p_rail = (x, -y, radius - z). Or, the same way, the wheel that belongs
/// to a roller. A roller is not prismatic: constant_profile() of the result is false. Parameters u of located points
/// stay those of the wheel: theta = 0 at the top, growing towards +x. Errors: as above.
std::shared_ptr<const Surface> turn_over(std::shared_ptr<const Surface> surface, double radius);

}  // namespace treadmark::assembly
