// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/model/vehicle/running_limits.hpp"

namespace treadmark {

/// What is to be read out of a run. Plain data in SI units.

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
  std::vector<std::string> laws;        ///< names of laws (model/damage/named_laws.hpp) that are asked of the wheels
  std::optional<RunningLimits> limits;  ///< none: usual_limits()
};

}  // namespace treadmark
