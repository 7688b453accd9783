// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>

#include "treadmark/model/shape/profile.hpp"
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

  /// Wheel: what the section would be turned by besides, were the axis free, and to which standard error, were what it
  /// differs by errors of some 20 mm length.
  struct Turn {
    double angle = 0.0, error = 0.0;  ///< as roll [rad]
    Vec2 datum = Vec2::Zero();        ///< where the nominal section's (0, 0) lies then, in the measured one
  };
  std::optional<Turn> turn;

  /// Rail whose way was free: mean distance from the nominal section in this reading and with the rail turned round,
  /// wear of the gauge side apart [m]; how far the section is from its own mirror image, where both are (rms) [m].
  struct Ways {
    double here = 0.0, turned = 0.0, asymmetry = 0.0;
    bool clear = false;  ///< one of them is clearly nearer
  };
  std::optional<Ways> ways;
};

/// Robust fit of a measured section to a nominal one: all shifts are tried coarsely (rails: also rolls up to 60
/// degrees), then Gauss-Newton steps with Tukey's weights, so that worn and damaged parts do not pull. keep_way: the
/// way round is known. Else that of a wheel follows from its flange. A rail may be worn at its gauge side (y < 0); it
/// is turned round where its points (in the plane of the measured section, flanks too that are too steep for it; none:
/// the section's own) lie clearly nearer the nominal one then, or where only its other side was measured down to where
/// gauges are. Errors: Error(input_data) if they agree nowhere.
SectionMatch match_nominal(const Section& measured, const Section& nominal, Body body, bool keep_way,
                           std::span<const Vec2> points = {});

/// Covariance of (shift in y, shift in v, roll) of such a match, in the nominal section's axes: parts of some 15 mm of
/// the measured section are left out in turn (delete-group jackknife; Shao and Wu 1989), so that wear of one part,
/// which pulls, counts as much as scatter.
Mat3 match_covariance(const Section& measured, const Section& nominal, Body body, const SectionMatch& match);

/// A point of the measured section's plane in the nominal's.
Vec2 to_nominal(const SectionMatch& match, const Vec2& point);

}  // namespace treadmark::scans
