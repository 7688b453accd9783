// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/train.hpp"

#include <algorithm>
#include <utility>

namespace treadmark {

std::string vehicle_prefix(int number) { return number == 0 ? "" : 'v' + std::to_string(number + 1) + '_'; }

int vehicle_count(const VehicleModel& train) {
  int count = 0;
  for (const BodySpec& body : train.bodies) count = std::max(count, body.vehicle + 1);
  return count;
}

void append_vehicle(VehicleModel& train, VehicleModel vehicle, double ahead) {
  const int number = vehicle_count(train);
  const std::string prefix = vehicle_prefix(number);
  const auto rename = [&](std::string& name) {
    if (!name.empty() && name != kGround) name = prefix + name;
  };
  for (BodySpec& body : vehicle.bodies) {
    rename(body.name);
    body.position.x() += ahead;
    body.vehicle = number;
    train.bodies.push_back(std::move(body));
  }
  const auto take = [&](auto& parts, auto& all) {
    for (auto& part : parts) {
      for (std::string* name : {&part.name, &part.body_a, &part.body_b}) rename(*name);
      part.position.x() += ahead;
      all.push_back(std::move(part));
    }
  };
  for (DryFrictionSpec& friction : vehicle.frictions) rename(friction.load_of);
  take(vehicle.springs, train.springs);
  take(vehicle.bump_stops, train.bump_stops);
  take(vehicle.damper_curves, train.damper_curves);
  take(vehicle.frictions, train.frictions);
  take(vehicle.air_springs, train.air_springs);
  for (WheelsetSpec& wheelset : vehicle.wheelsets) {
    rename(wheelset.body);
    train.wheelsets.push_back(std::move(wheelset));
  }
}

}  // namespace treadmark
