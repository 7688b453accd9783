// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Largest magnitudes that problems are solved for, files and calls alike. No use is known that comes near them; beyond
/// them products of what is given leave the range of numbers, or its digits.
inline constexpr double kMostFriction = 1e6;   ///< coefficient of friction, each of its terms
inline constexpr double kMostCreepage = 1e12;  ///< [-]; spin [rad/m]; a shift [m], [rad]
inline constexpr double kMostSpeed = 1e9;      ///< [m/s], [rad/s]; as displacements of a shift [m], [rad]
inline constexpr double kMostStep = 1e9;       ///< way or time of a step [m], [s], or over the size of an element

/// Nominal radii of wheels, from models to the largest that was ever built, with room on both sides [m].
inline constexpr double kLeastWheelRadius = 0.01, kMostWheelRadius = 2.0;
inline constexpr double kLeastGauge = 0.05, kMostGauge = 5.0;  ///< the same of tracks [m]

}  // namespace treadmark
