// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/profiles/read_profile.hpp"

namespace treadmark::io {

/// A doubt about a profile.
struct ProfileRemark {
  std::string name;  ///< "flange_back", "nominal_radius", "unit", "exchanged", "gap", "gauge_side", and those of
                     ///< measured::Doubt
  std::string text;  ///< what is seen, where, and what to set
};

/// What was understood of a profile.
struct ProfileJudgement {
  std::vector<std::pair<std::string, std::string>> facts;  ///< names and values with their units
  std::vector<ProfileRemark> remarks;
  std::vector<std::string> notes;  ///< of the reader: repairs, keys that were not used
};

/// What the case says about the wheel; nothing: it is not known.
struct ExpectedWheel {
  std::optional<double> flange_back;     ///< y in the profile's coordinates [m]
  std::optional<double> nominal_radius;  ///< [m]
};

/// A known profile to compare with: points (y, z), y increasing [m].
struct StandardOutline {
  std::string name;          ///< "S1002"
  std::vector<double> y, z;  ///< [m]
};

/// Facts and doubts about a profile that has been read. standards: of the same body. Never throws; thread-safe.
ProfileJudgement judge_profile(const SourcedProfile& profile, const ExpectedWheel& expected = {},
                               const std::vector<StandardOutline>& standards = {});

/// How far a profile lies from a standard where both run level (within 25 mm of the middle of the head or tread) once
/// it has been shifted and rolled upon it.
struct StandardDeparture {
  double usual = 0.0;    ///< median of the vertical distance [m]
  double largest = 0.0;  ///< [m]
  double shift_y = 0.0;  ///< of the profile to lie on the standard [m]
  double roll = 0.0;     ///< likewise [rad]
};
/// Nothing where they have less than 20 mm in common.
std::optional<StandardDeparture> departure_from(const Profile& profile, const StandardOutline& standard);

}  // namespace treadmark::io
