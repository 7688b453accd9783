// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/shape/moving_section.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::analytic {

/// Offset of a moving section at x, from its origin.
struct SectionOffset {
  double y = 0.0, z = 0.0;
};
SectionOffset section_offset(const MovingSection& motion, double x);

/// The rail as slices. Their stations are the joints of the motion's polynomials, so that cubic splines through them
/// follow the motion to rounding. Errors: Error(configuration) for a wheel's profile, numbers that are not finite, a
/// rounding that is not positive or not shorter than both lines, slopes beyond 1:1.
SliceSet moving_section_slices(const Profile& section, const MovingSection& motion);

}  // namespace treadmark::analytic
