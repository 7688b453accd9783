// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

#include "treadmark/model/profile.hpp"
#include "treadmark/scans/placement/section_fit.hpp"

namespace treadmark::scans {

struct RefinedAxis {
  Pose X_CS;  ///< the surface frame in the cloud's; the origin along y (rail: the whole origin but its direction) as
              ///< before
  SectionFit fit;                ///< section about the refined axis
  double undamaged = 0.0;        ///< part of the points that followed the section and fixed the axis
  double position_error = 0.0;   ///< standard errors of the axis from the points' scatter, and how far it may still be
                                 ///< on its way: wheel only [m]
  double direction_error = 0.0;  ///< [rad]
  int iterations = 0;
};

/// Turns and shifts the axis of a wheel, or turns the direction of a rail, until most of the points lie on one section:
/// robust Gauss-Newton steps in which the section follows (its strips are eliminated from the normal equations). Damage
/// and outliers lose their weight (Tukey's biweight). points: [m] in the cloud's frame; a few 10^5 are enough. Errors:
/// Error(input_data) if no section is found.
RefinedAxis refine_axis(std::span<const Vec3> points, Body body, const Pose& X_CS);

}  // namespace treadmark::scans
