// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <string_view>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// Cases of a case file that follow each other in time (case.steps).

/// The rolling step that case.time_step_s means.
void settle_rolling_step(Case& c);

/// Moves rail and wheelset of a case from where they are in the case before it, by its velocities; a shift by its
/// displacements. given: whether the file gives the position with this key itself, which then stays. Basic cases have
/// no position. Errors: Error(configuration) if neither a velocity nor a time step tells how far.
void move_on(Case& next, const Case& previous, const std::function<bool(std::string_view)>& given);

}  // namespace treadmark::io
