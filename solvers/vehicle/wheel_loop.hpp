// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "treadmark/solvers/vehicle/vehicle_on_track.hpp"

namespace treadmark::vehicle {

/// Calls body(i) once for every wheel, on several threads where several elements are costly. A body must only use the
/// element of its own wheel and write its own results. Of several exceptions that of the first wheel is rethrown.
void for_each_wheel(const VehicleOnTrack& vehicle, const std::function<void(std::size_t)>& body);

/// What the elements of all wheels evaluate to in a state.
std::vector<ContactReaction> evaluate_wheels(const VehicleOnTrack& vehicle, const SystemState& state);

}  // namespace treadmark::vehicle
