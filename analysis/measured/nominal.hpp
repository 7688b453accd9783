// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measured {

/// Of depths over which the sides of rails are looked up [m].
inline constexpr double kHalfStep = 1e-3;

/// A nominal section for looking up: the outer side of its outline, z down over y at equal steps [m]; NaN beside it.
struct NominalOutline {
  std::string name;  ///< "S1002"
  double first = 0.0, step = 0.0;
  std::vector<double> z;
  std::vector<double> half;  ///< of a rail: how far its head reaches aside at z = 0, kHalfStep, ... 40 mm [m]
};
/// outline: points (y, z) in their order [m].
NominalOutline nominal_outline(std::string name, Body body, std::span<const Vec2> outline);

/// How a section is rolled against the nominal one that fits it best.
struct Lean {
  std::string name;       ///< of the nominal section
  double roll = 0.0;      ///< of the measured section, y towards z [rad]
  double shift_y = 0.0;   ///< that lays the measured section upon it, after rolling it back [m]
  double residual = 0.0;  ///< rms of the better six tenths of the points, rolled back so [m]
  double flange = 0.0;    ///< rms of the better half of the points on the flange of a wheel, rolled back so [m]
  double upright = 0.0;   ///< the least such rms that any nominal section reaches within kLevel [m]
  /// Metal that is missing on the flanks of a rail, 4 to 13 mm below its top, on the side of small and of great y: mean
  /// across the nominal section [m].
  double lost_low = 0.0, lost_high = 0.0;
};

/// A wheel that is rolled by less stands upright; the flange height of one that is not changes by 0.5 mm [rad].
inline constexpr double kLevel = 7e-3;

/// Least trimmed squares (Rousseeuw 1984) of the section upon each nominal one, by shift and roll: worn parts are
/// among what is left out. Of a rail with a groove that is like no nominal one the head alone. Nothing where fewer than
/// 20 mm of the section can be compared. Thread-safe.
std::optional<Lean> lean_of(const Profile& profile, std::span<const NominalOutline> nominals);

/// How near a tread is to the nominal section that is most like it, as it lies but for its height and 30 mrad.
struct TreadFit {
  std::string name;  ///< of the nominal section
  double rms = 0.0;  ///< [m]; infinite where none is there
  bool mirror_y = false, mirror_z = false;
};
/// Of a tread as it is, with y mirrored, with z mirrored, and with both. Thread-safe.
std::array<TreadFit, 4> tread_fits(const Profile& profile, std::span<const NominalOutline> nominals);

}  // namespace treadmark::measured
