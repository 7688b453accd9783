// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/model/vehicle/vehicle_model.hpp"

namespace treadmark {

/// Vehicles of the longest train that is read from files.
inline constexpr int kLongestTrain = 100;

/// What stands before the names of a following vehicle's parts: "v2_"; number from 0, of the leading one: nothing.
std::string vehicle_prefix(int number);

/// Hangs a vehicle behind a train. ahead: place of its x = 0 in the coordinates of the train [m], negative. Its bodies,
/// springs and so on get its prefix; couplers are added by whoever knows them. Errors: Error(configuration) where a
/// part of the leading vehicle is already called as one of them.
void append_vehicle(VehicleModel& train, VehicleModel vehicle, double ahead);

/// How many vehicles a train has.
int vehicle_count(const VehicleModel& train);

/// Whether nothing holds the vehicles of a train, or a single one, to the speed of their frames: no spring, damper,
/// stop, friction or coupler along x connects a body that moves along x with one that does not, or with the ground.
/// Then their speed is what acts on them makes of it.
bool runs_free(const VehicleModel& train);

}  // namespace treadmark
