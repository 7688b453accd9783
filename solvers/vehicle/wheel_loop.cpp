// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/wheel_loop.hpp"

#include <algorithm>
#include <exception>

#include "treadmark/core/parallel.hpp"

namespace treadmark::vehicle {

void for_each_wheel(const VehicleOnTrack& vehicle, const std::function<void(std::size_t)>& body) {
  const std::size_t count = vehicle.wheels.size();
  const auto costly = std::ranges::count_if(vehicle.wheels, [](const WheelOnRail& w) { return w.element->costly(); });
  if (costly < 2) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  std::vector<std::exception_ptr> failures(count);
  parallel_for(count, [&](std::size_t i) {
    try {
      body(i);
    } catch (...) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

std::vector<ContactReaction> evaluate_wheels(const VehicleOnTrack& vehicle, const SystemState& state) {
  std::vector<ContactReaction> reactions(vehicle.wheels.size());
  for_each_wheel(vehicle,
                 [&](std::size_t i) { reactions[i] = vehicle.wheels[i].element->evaluate(vehicle.motion(i, state)); });
  return reactions;
}

}  // namespace treadmark::vehicle
