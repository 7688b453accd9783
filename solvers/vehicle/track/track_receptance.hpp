// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark::vehicle {

/// Displacement of the left rail's top, in the middle of the rail, under a force of 1 N there in the same direction, y
/// or z, for each frequency [Hz] >= 0. Zero where it does not move. Errors: Error(numerical) where an undamped track
/// resonates.
std::vector<std::complex<double>> receptance(const TrackModel& track, Freedom direction,
                                             std::span<const double> frequency);

}  // namespace treadmark::vehicle
