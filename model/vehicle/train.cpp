// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/vehicle/train.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

/// Names that another vehicle's parts get may be those of the leading one already.
template <class Part>
void refuse_clash(const std::vector<Part>& train, const std::vector<Part>& vehicle, int number) {
  const std::string prefix = vehicle_prefix(number);
  for (const Part& taken : train) {
    if (!taken.name.starts_with(prefix)) continue;
    const std::string own = taken.name.substr(prefix.size());
    if (ranges::find(vehicle, own, &Part::name) != vehicle.end())
      throw Error(ErrorKind::configuration,
                  fmt::format("'{}' of the leading vehicle has the name that '{}' of vehicle {} gets in a train",
                              taken.name, own, number + 1),
                  taken.where, "call it otherwise: names of following vehicles begin with v2_, v3_ and so on");
  }
}

}  // namespace

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
  refuse_clash(train.bodies, vehicle.bodies, number);
  for (BodySpec& body : vehicle.bodies) {
    rename(body.name);
    body.position.x() += ahead;
    body.vehicle = number;
    train.bodies.push_back(std::move(body));
  }
  const auto take = [&](auto& parts, auto& all) {
    refuse_clash(all, parts, number);
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

bool runs_free(const VehicleModel& train) {
  std::set<std::string> moving;
  for (const BodySpec& body : train.bodies)
    if (body.free.front()) moving.insert(body.name);
  const auto holds = [&](const std::string& one, const std::string& other) {
    return moving.contains(one) != moving.contains(other);
  };
  const auto hold = [&](const auto& parts, auto&& along) {
    return ranges::any_of(parts, [&](const auto& part) { return along(part) && holds(part.body_a, part.body_b); });
  };
  const auto by_direction = [](const auto& part) { return part.direction == Freedom::x; };
  return !moving.empty() &&
         !hold(train.springs, [](const SpringSpec& s) { return s.stiffness[0] > 0.0 || s.damping[0] > 0.0; }) &&
         !hold(train.bump_stops, by_direction) && !hold(train.damper_curves, by_direction) &&
         !hold(train.frictions, [](const DryFrictionSpec& f) { return f.directions[0]; }) &&
         ranges::none_of(train.couplers, [&](const CouplerSpec& c) { return holds(c.rear, c.front); });
}

}  // namespace treadmark
