// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// Angle in the wheel's own frame [rad] of the line of a round wheel that is lowest in T, yaw and roll being small:
/// pitch taken back.
double lowest_angle(const Pose& X_TW);

/// Lateral positions in the wheel's frame, increasing, at which the reference program (CONTACT) puts the corners of its
/// meshes [m]: where the data of the wheel's surface lie if it tells, in equal steps not longer than step otherwise.
/// angle: of the section that tells y over v [rad].
std::vector<double> mesh_lines(const Surface& wheel, double angle, double step);

/// Radius over lateral positions of the section at an angle [m]; NaN where the wheel is missing.
std::vector<double> section_radius(const Surface& wheel, double angle, std::span<const double> y);

}  // namespace treadmark::detection
