// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::app {

/// What [layout] and [irregularities] of a file mean, a line for each fact: length and end of the line, its curves with
/// what they do at the speed of the simulation, steps of curvature; ranges and standard deviations of irregularities.
/// Empty without them. Errors: those of the line.
std::vector<std::string> line_summary(const io::SimulationFile& file);

/// Simulations run on a straight, even track so far. Errors: Error(configuration) at [layout] or [irregularities].
void refuse_line(const io::SimulationFile& file);

}  // namespace treadmark::app
