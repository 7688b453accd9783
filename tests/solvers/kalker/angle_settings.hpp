// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "treadmark/model/contact/contact_settings.hpp"
#include "treadmark/solvers/kalker/halfspace/angle_corrected_kernel.hpp"

namespace treadmark::kalker::testing {

inline constexpr std::array kCorrections{AngleCorrection::rotated_loads, AngleCorrection::rotated_loads_but_xn,
                                         AngleCorrection::rotated_displacements, AngleCorrection::half_and_half};

/// Surfaces of given inclinations [rad] at positions across [m].
inline InfluenceSettings settings_of(std::vector<double> position, std::vector<double> inclination, int variant) {
  InfluenceSettings settings;
  settings.kind = InfluenceSettings::Kind::angle_corrected;
  settings.position = std::move(position);
  settings.inclination = std::move(inclination);
  settings.variant = variant;
  return settings;
}

}  // namespace treadmark::kalker::testing
