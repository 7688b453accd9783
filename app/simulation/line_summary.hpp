// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/solvers/vehicle/line_effects.hpp"

namespace treadmark::app {

/// What [layout] and [irregularities] of a file mean, a line for each fact: length and end of the line, its curves with
/// what they do at the speed of the simulation, steps of curvature; ranges and standard deviations of irregularities.
/// Empty without them. Errors: those of the line.
std::vector<std::string> line_summary(const io::SimulationFile& file);

/// Whether a vehicle runs otherwise than along a straight, even track at constant speed.
bool has_line(const io::SimulationFile& file);

/// Length over which simulations round the kinks of a line, to either side [m].
inline constexpr double kRounding = 1.0;

/// What the line does to a vehicle; null without one. Irregularities are only made if wanted, which takes a second or
/// two for long lines. Errors: those of LineEffects.
std::shared_ptr<const vehicle::LineEffects> build_line(const io::SimulationFile& file, const vehicle::Multibody& system,
                                                       bool irregularities);

}  // namespace treadmark::app
