// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/profiles/read_profile.hpp"

namespace treadmark::io {

/// A warning about a profile.
struct ProfileRemark {
  std::string name;  ///< "flange_back", "nominal_radius", "unit", "exchanged", "gap", "gauge_side", "noise", "columns"
                     ///< and those of measured::Doubt
  std::string text;  ///< what is seen, where, and what to set
  /// From where to where in y, of a fault that matters only to contact there [m].
  std::optional<std::pair<double, double>> place = {};
};

/// What was understood of a profile.
struct ProfileJudgement {
  std::vector<std::pair<std::string, std::string>> facts;  ///< names and values with their units
  std::vector<ProfileRemark> remarks;
  std::vector<std::string> notes;  ///< of the reader: repairs, keys that were not used
};

/// What the case says about a wheel or rail; nothing: it is not known.
struct ExpectedProfile {
  std::optional<double> flange_back;     ///< y in the profile's coordinates [m]
  std::optional<double> nominal_radius;  ///< [m]
  bool by_gauge = true;                  ///< whether a rail is placed by the gauge
  std::optional<double> cant = {};       ///< by which a rail will be inclined [rad]
};

/// Facts and warnings about a profile that has been read. Never throws; thread-safe.
ProfileJudgement judge_profile(const SourcedProfile& profile, const ExpectedProfile& expected = {});

}  // namespace treadmark::io
