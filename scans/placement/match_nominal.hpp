// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/profile.hpp"
#include "treadmark/scans/placement/section.hpp"

namespace treadmark::scans {

/// How a measured section lies on a nominal one: (y, v) of the nominal = rotation by roll of (turned ? -y : y, v) +
/// shift.
struct SectionMatch {
  bool turned = false;        ///< the measured section runs the other way
  double roll = 0.0;          ///< rail only; about x, with y to the right and v up: a positive roll lowers +y [rad]
  Vec2 shift = Vec2::Zero();  ///< wheel: (dy, -radius), so that the v of the nominal section is the profile's z
  double residual = 0.0;      ///< robust standard deviation of the distances where both agree [m]
  double agreeing = 0.0;      ///< part of the measured section that does
  double beside = 0.0;        ///< part of the measured section that is nowhere near the nominal one
  double overlap = 0.0;       ///< part of the shorter one that the other covers
};

/// Robust fit of a measured section to a nominal one: all shifts are tried coarsely (rails: also rolls up to 60
/// degrees), then Gauss-Newton steps with Tukey's weights, so that worn and damaged parts do not pull. keep_way: the
/// way round is known. Errors: Error(input_data) if they agree nowhere.
SectionMatch match_nominal(const Section& measured, const Section& nominal, Body body, bool keep_way);

/// A point of the measured section's plane in the nominal's.
Vec2 to_nominal(const SectionMatch& match, const Vec2& point);

}  // namespace treadmark::scans
