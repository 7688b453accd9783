// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/core/profile.hpp"
#include "treadmark/core/slices.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::spline {

/// A rail of constant cross-section or, for a wheel profile, a round wheel with r = nominal_radius [m] + z.
/// nominal_radius is not used for a rail. Errors: those of fit_profile, and a radius that is not positive.
std::shared_ptr<const Surface> make_profile_surface(const Profile& profile, double nominal_radius);

/// A rail or wheel from slices; nominal_radius [m] as above. Errors: those of fit_slices, and a radius that is not positive.
std::shared_ptr<const Surface> make_slice_surface(const SliceSet& slices, double nominal_radius);

}  // namespace treadmark::spline
