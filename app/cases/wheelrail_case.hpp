// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// The solver's view of a wheel-rail case. round_wheel: one profile all round.
wheelrail::Problem to_problem(const io::WheelRailCase& input, bool round_wheel);

/// Radius of a surface of revolution where its profile has z = 0 [m]: wheel, roller (negative: ring); 0 for a rail.
double profile_radius(const io::WheelRailCase& input, Body body);

/// Friction of a patch whose contact plane has this inclination in track axes [rad].
FrictionLaw friction_of(const io::WheelRailCase& input, double contact_angle);

/// The first case of a wheel on a rail in a file; null if there is none.
const io::WheelRailCase* first_wheelrail_case(const io::CaseFile& file);

/// Errors: Error(configuration) for backends and detectors of wheels on rails that are not registered, which readers do
/// not know.
void require_registered(const io::CaseFile& file);
/// io::read_any_case with require_registered. Errors: theirs.
io::CaseFile read_registered_case(const std::string& file, const std::vector<std::string>& overrides);

}  // namespace treadmark::app
