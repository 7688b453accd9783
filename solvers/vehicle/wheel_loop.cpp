// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/wheel_loop.hpp"

#include <exception>

#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::vehicle {

void for_each_wheel(const VehicleOnTrack& vehicle, const std::function<void(std::size_t)>& body) {
  const std::size_t count = vehicle.wheels.size();
  const auto costly = ranges::count_if(vehicle.wheels, [](const WheelOnRail& w) { return w.element->costly(); });
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
  constexpr int kMost = 40;
  std::vector<ContactReaction> reactions(vehicle.wheels.size());
  for (int i = 0; i < kMost; ++i) {
    for_each_wheel(
        vehicle, [&](std::size_t w) { reactions[w] = vehicle.wheels[w].element->evaluate(vehicle.motion(w, state)); });
    if (ranges::any_of(reactions, is_unsolved)) return reactions;
    bool settled = true;
    for (std::size_t w = 0; w < reactions.size(); ++w)
      settled = vehicle.wheels[w].element->settle(reactions[w]) && settled;
    if (settled) return reactions;
  }
  for (ContactReaction& r : reactions) {
    r.status = Status::not_converged;
    r.message = "the forces of wheels on one rail did not converge with each other";
  }
  return reactions;
}

}  // namespace treadmark::vehicle
