// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <numbers>

namespace treadmark {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Factors of readers: a number in mm times kMillimetre is in m.
inline constexpr double kMillimetre = 1e-3;

/// Factors of writers: m to mm, rad to mrad, s to ms; m to um, m^2 to mm^2; Pa to MPa or N/mm^2.
inline constexpr double kMilli = 1e3;
inline constexpr double kMicro = 1e6;
inline constexpr double kMega = 1e-6;

/// Robust statistics: Tukey's biweight of 95 % efficiency, and the standard deviation over the median absolute
/// deviation of normal errors (Huber 1981).
inline constexpr double kTukey = 4.685;
inline constexpr double kMad = 1.4826;

}  // namespace treadmark
