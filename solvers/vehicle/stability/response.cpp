// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/stability/response.hpp"

#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/wheel_loop.hpp"

namespace treadmark::vehicle {
namespace {

using Complex = std::complex<double>;
using ComplexVector = Eigen::VectorXcd;

/// Coordinates of a pair (PairVector) that irregularities move.
constexpr int kYaw = 5, kRailY = 6, kRailZ = 7, kRailRoll = 8;

}  // namespace

LinearVehicle::LinearVehicle(const VehicleOnTrack& vehicle, const SystemState& state, double base)
    : system_(linearised_system(vehicle, state)), mass_(vehicle.system.mass), speed_(vehicle.speed), base_(base) {
  const auto place = [&](const WheelOnRail& wheel) {
    const Multibody::Wheelset& set = vehicle.system.wheelsets[static_cast<std::size_t>(wheel.wheelset)];
    return vehicle.system.bodies[static_cast<std::size_t>(set.body)].position.x();
  };
  const std::vector<ContactReaction> reactions = evaluate_wheels(vehicle, state);
  wheels_.reserve(vehicle.wheels.size());
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const WheelOnRail& wheel = vehicle.wheels[i];
    if (reactions[i].status != Status::ok)
      throw Error(ErrorKind::numerical, wheel.name + " does not touch its rail in steady running");
    wheels_.push_back({linearised(vehicle, i, state, 1.0, true),
                       pair_map(vehicle.system, wheel.wheelset, wheel.side, wheel.rail_marker),
                       place(wheel) - place(vehicle.wheels.front()), reactions[i].contact_y, vehicle.radius(i),
                       wheel.side == wheelrail::Side::left});
  }
}

/// What an irregularity or roughness moves the coordinates of a pair by, and their rates.
ComplexVector LinearVehicle::shaken(const Wheel& wheel, const ResponseInput& input, double omega,
                                    ComplexVector& rates) const {
  ComplexVector by = ComplexVector::Zero(kPairCoordinates);
  rates = by;
  using Kind = ResponseInput::Kind;
  const Complex here = std::exp(Complex(0.0, omega * wheel.ahead / speed_));
  const double half = wheel.left ? -0.5 : 0.5;
  const Wheel* const on = input.kind == Kind::irregularity ? nullptr : &wheels_.at(input.wheel);
  if (input.kind == Kind::wheel_roughness && on == &wheel) by[kRailZ] = 1.0;
  if (input.kind == Kind::rail_roughness && on->left == wheel.left) by[kRailZ] = here;
  if (input.kind == Kind::irregularity) switch (input.which) {
      case Irregularity::longitudinal_level:
        by[kRailZ] = here;
        break;
      case Irregularity::cross_level:
        by[kRailZ] = half * here;
        by[kRailRoll] = here / base_;
        break;
      case Irregularity::alignment:
        by[kRailY] = here;
        break;
      case Irregularity::gauge:
        by[kRailY] = half * here;
        break;
    }
  rates = Complex(0.0, omega) * by;
  // Yaw counts from the direction of the rail.
  by[kYaw] = -Complex(0.0, omega / speed_) * by[kRailY];
  return by;
}

std::vector<FrequencyResponse> LinearVehicle::at(double frequency, std::span<const ResponseInput> inputs) const {
  const double omega = 2.0 * std::numbers::pi * frequency;
  const Complex i_omega(0.0, omega);
  Eigen::MatrixXcd dynamic = system_.stiffness.cast<Complex>() + i_omega * system_.damping.cast<Complex>();
  dynamic.diagonal() -= (omega * omega * mass_).cast<Complex>();
  const Eigen::PartialPivLU<Eigen::MatrixXcd> solver(dynamic);
  std::vector<FrequencyResponse> out;
  out.reserve(inputs.size());
  for (const ResponseInput& input : inputs) {
    ComplexVector force = ComplexVector::Zero(mass_.size());
    std::vector<ComplexVector> of_pair;
    of_pair.reserve(wheels_.size());
    for (std::size_t w = 0; w < wheels_.size(); ++w) {
      const Wheel& wheel = wheels_[w];
      ComplexVector rates;
      const ComplexVector by = shaken(wheel, input, omega, rates);
      of_pair.emplace_back(-(wheel.tangent.stiffness * by + wheel.tangent.damping * rates));
      force += wheel.map.transpose() * of_pair.back();
      using Kind = ResponseInput::Kind;
      if (input.wheel != w || (input.kind != Kind::vertical_force && input.kind != Kind::lateral_force)) continue;
      PairVector push = PairVector::Zero();
      if (input.kind == Kind::vertical_force) {
        push[2] = 1.0;
        push[3] = wheel.contact_y;
      } else {
        push[1] = 1.0;
        push[3] = -wheel.contact_z;
      }
      force += wheel.map.transpose() * push;
    }
    FrequencyResponse r;
    r.coordinate = solver.solve(force);
    for (std::size_t w = 0; w < wheels_.size(); ++w) {
      const Wheel& wheel = wheels_[w];
      const ComplexVector moved = wheel.map * r.coordinate;
      const ComplexVector pair =
          of_pair[w] - wheel.tangent.stiffness * moved - i_omega * (wheel.tangent.damping * moved);
      r.lateral.push_back(pair[kRailY]);
      r.vertical.push_back(pair[kRailZ]);
    }
    out.push_back(std::move(r));
  }
  return out;
}

}  // namespace treadmark::vehicle
