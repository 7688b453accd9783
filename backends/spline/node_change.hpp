// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

/// The points of a profile as parameters of its surface: its z at a break is one. Between the breaks z changes as the
/// natural cubic spline through 1 at that break and 0 at all others, over the arc length that the profile has; y stays.

/// point_0, point_1 ... [m], in the order of the breaks.
std::vector<ShapeParameter> node_parameters(const ProfileSpline& profile);

/// How the profile changes with its z at a break: y = 0, z [-].
ProfileSpline node_change(const ProfileSpline& profile, std::size_t node);

/// Adds to by, of its z at all breaks, what weights of its z at places v along it come to.
void pull_back_to_nodes(const ProfileSpline& profile, std::span<const double> v, std::span<const double> weights,
                        std::span<double> by);

/// The profile with its z at a break more by an amount [m].
ProfileSpline with_node(const ProfileSpline& profile, std::size_t node, double amount);

}  // namespace treadmark::spline
