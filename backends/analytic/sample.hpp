// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::analytic {

/// Points of a profile at arc-length steps of at most `step` [m], with every joint among them; made for fitting the
/// same shape with another backend. Rail points run with increasing y, wheel points with decreasing y. Errors:
/// Error(configuration) for an unknown name, a bad chain, or a step that is not positive.
Profile sample_profile(const StandardProfile& profile, double step);
Profile sample_profile(const ArcChain& chain, Body body, double step);

/// Slices round a wheel with flats: the profile sampled as above at angles `step`/R apart across the flats and at
/// most `coarse_angle` [rad] apart elsewhere, from -pi to pi.
/// Errors: Error(configuration) as above, for a radius that is not positive, or for flats that make no sense.
SliceSet sample_wheel(const Profile& profile, double nominal_radius, const std::vector<WheelFlat>& flats, double step,
                      double coarse_angle = 0.02);

}  // namespace treadmark::analytic
