// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {

/// Limits depend on it.
enum class VehicleKind { locomotive, passenger, freight };
inline constexpr std::array<std::string_view, 3> kVehicleKinds{"locomotive", "passenger", "freight"};

/// Quasi-static forces are assessed in curves, comfort on curve transitions in transitions.
enum class SectionKind { straight, curve, transition };
inline constexpr std::array<std::string_view, 3> kSectionKinds{"straight", "curve", "transition"};

/// A limit of an assessed quantity, constant + by_load 2 Q0 + by_curvature / R, where its conditions hold. SI.
struct RunningLimit {
  std::string quantity;                     ///< key of a quantity, "Y_qst"
  std::optional<VehicleKind> vehicle = {};  ///< none: all
  std::optional<SectionKind> section = {};  ///< none: all
  double from_radius = 0.0;                 ///< [m]; that of a straight is infinite
  std::optional<double> to_radius = {};     ///< [m], smaller ones only; none: straights, too
  double above_speed = 0.0;                 ///< [m/s]
  double constant = 0.0;                    ///< [unit of the quantity]
  double by_load = 0.0;                     ///< [its unit / N]
  double by_curvature = 0.0;                ///< [its unit m]
  SourcePosition where = {};                ///< in its file
};

/// Limits of one origin.
struct RunningLimits {
  std::string edition;    ///< of the standard that they stand in, or where else they are from
  bool verified = false;  ///< somebody has compared them with its text
  std::vector<RunningLimit> limits;
};

/// Those that the literature quotes, which hold where nobody gives others. Thread-safe.
const RunningLimits& usual_limits();

/// What limits depend on; NaN: not known.
struct LimitInput {
  VehicleKind vehicle = VehicleKind::passenger;
  SectionKind section = SectionKind::straight;
  double radius = kInfinity;  ///< of the section [m]
  double speed = kNaN;        ///< mean of the section [m/s]
  double load = kNaN;         ///< of a wheelset on its two rails at rest, 2 Q0 [N]
};

/// The least of those whose conditions hold, which a radius or a speed that is not known does not; NaN without one, or
/// where one of them needs what is not known. Thread-safe.
double limit_of(const RunningLimits& limits, std::string_view quantity, const LimitInput& input);

}  // namespace treadmark
