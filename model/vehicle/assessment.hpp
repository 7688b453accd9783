// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/error.hpp"

namespace treadmark {

/// What is to be read out of a run. Plain data in SI units.

/// Limits depend on it.
enum class VehicleKind { locomotive, passenger, freight };
inline constexpr std::array<std::string_view, 3> kVehicleKinds{"locomotive", "passenger", "freight"};

/// Quasi-static forces are assessed in curves.
enum class SectionKind { straight, curve, transition };
inline constexpr std::array<std::string_view, 3> kSectionKinds{"straight", "curve", "transition"};

/// Where a point of a body is, which decides how its accelerations are filtered.
enum class PointKind { car_body, bogie_frame, axle_box };
inline constexpr std::array<std::string_view, 3> kPointKinds{"car_body", "bogie_frame", "axle_box"};

/// A part of a run.
struct AssessmentSection {
  std::string name;
  double from = 0.0, to = 0.0;  ///< distance travelled [m]
  SectionKind kind = SectionKind::straight;
};

/// What is to be read out of a run.
struct AssessmentRequest {
  VehicleKind vehicle = VehicleKind::passenger;
  std::vector<AssessmentSection> sections;  ///< none: the whole run from `from` on
  double from = 0.0;                        ///< [m]
  std::vector<std::string> spectra;         ///< channels whose spectra are wanted, * for any letters
  std::vector<std::string> laws;  ///< names of laws (model/damage/named_laws.hpp) that are asked of the wheels
};

}  // namespace treadmark
