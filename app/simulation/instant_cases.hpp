// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::app {

/// The wheels with full contact at the instant of a history that is nearest to a time [s], each as a case that stands
/// alone and has the same contact. Errors: Error(configuration) for a time beyond the history, a history of another
/// simulation, transient rolling (whose tractions come from the instants before), and a vehicle without such wheels.
io::CaseFile cases_at(const io::SimulationFile& file, const io::SimulationResult& history, double time);

}  // namespace treadmark::app
