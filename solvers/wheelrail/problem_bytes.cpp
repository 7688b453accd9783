// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/problem_bytes.hpp"

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace treadmark::wheelrail {
namespace {

// Structures are taken apart by name: a new member does not compile until it is written, too. Only Discretisation,
// which has a base, cannot be: its own members are named one by one.

template <class... T>
void put_all(ByteWriter& out, const T&... values);

template <class T>
requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void put_one(ByteWriter& out, const T& value) { out.put(value); }
template <class T>
void put_one(ByteWriter& out, const std::optional<T>& value);
template <class T>
void put_one(ByteWriter& out, const std::vector<T>& values);

void put_one(ByteWriter& out, const std::string& text) { out.put(text); }
void put_one(ByteWriter& out, const Track& track) {
  const auto& [by_gauge, innermost, gauge_height, gauge_width, y0, z0, cant, curvature, dy, dz, roll, vy, vz, vroll] =
      track;
  put_all(out, by_gauge, innermost, gauge_height, gauge_width, y0, z0, cant, curvature, dy, dz, roll, vy, vz, vroll);
}
void put_one(ByteWriter& out, const WheelsetDimensions& wheelset) {
  const auto& [distance, position, radius, tape_line] = wheelset;
  put_all(out, distance, position, radius, tape_line);
}
void put_one(ByteWriter& out, const SixMotion& motion) {
  const auto& [x, y, z, roll, yaw, pitch] = motion;
  put_all(out, x, y, z, roll, yaw, pitch);
}
void put_one(ByteWriter& out, const WheelsetState& state) {
  const auto& [position, velocity, offset, offset_velocity] = state;
  put_all(out, position, velocity, offset, offset_velocity);
}
void put_one(ByteWriter& out, const Roller& roller) {
  const auto& [radius, rate] = roller;
  put_all(out, radius, rate);
}
void put_one(ByteWriter& out, const RailSprings& springs) {
  const auto& [y, z, force_y, force_z, first_step] = springs;
  put_all(out, y, z, force_y, force_z, first_step);
}
void put_one(ByteWriter& out, const ElementGrid& grid) {
  const auto& [dx, ds, choose_dx, choose_ds, dq, angle, separation, combination, turning, near_miss, most, linear] =
      grid;
  put_all(out, dx, ds, choose_dx, choose_ds, dq, angle, separation, combination, turning, near_miss, most, linear);
}
void put_one(ByteWriter& out, const Discretisation& d) {
  put_one(out, static_cast<const ElementGrid&>(d));
  put_all(out, d.reference_at_deepest, d.search, d.search_method, d.detector, d.usual_dq_relative);
}
void put_one(ByteWriter& out, const Material& material) {
  const auto& [g1, g2, nu1, nu2, layer, layer_yield, hardening, sheet, creep1, creep2, time1, time2] = material;
  put_all(out, g1, g2, nu1, nu2, layer, layer_yield, hardening, sheet, creep1, creep2, time1, time2);
}
void put_one(ByteWriter& out, const FrictionLaw& law) {
  const auto& [kind, kinetic, amp1, amp2, half1, half2, memory, velocity, temperature, change, range] = law;
  put_all(out, kind, kinetic, amp1, amp2, half1, half2, memory, velocity, temperature, change, range);
}
void put_one(ByteWriter& out, const kalker::SolverSettings& settings) {
  const auto& [eps, iterations, outer, force, coupling, method, first_slip, conventions] = settings;
  put_all(out, eps, iterations, outer, force, coupling, method, first_slip, conventions);
}
void put_one(ByteWriter& out, const kalker::FastsimSettings& settings) {
  const auto& [k0, alpha, beta, flexibility, first_step] = settings;
  put_all(out, k0, alpha, beta, flexibility, first_step);
}
void put_one(ByteWriter& out, const kalker::InfluenceSettings& influence) {
  const auto& [kind, position, inclination, variant, linear, table] = influence;
  put_all(out, kind, position, inclination, variant, linear, table != nullptr);
}
void put_one(ByteWriter& out, const ThermalProperties& body) {
  const auto& [temperature, capacity, conductivity, density] = body;
  put_all(out, temperature, capacity, conductivity, density);
}
void put_one(ByteWriter& out, const Thermal& thermal) {
  const auto& [body_1, body_2, fraction, conventions] = thermal;
  put_all(out, body_1, body_2, fraction, conventions);
}
void put_one(ByteWriter& out, const Damping& damping) {
  const auto& [normal, tangential, rate_normal, rate_tangential] = damping;
  put_all(out, normal, tangential, rate_normal, rate_tangential);
}

template <class T>
void put_one(ByteWriter& out, const std::optional<T>& value) {
  out.put(value.has_value());
  if (value) put_one(out, *value);
}
template <class T>
void put_one(ByteWriter& out, const std::vector<T>& values) {
  out.put(values.size());
  for (const T& value : values) put_one(out, value);
}
template <class... T>
void put_all(ByteWriter& out, const T&... values) {
  (put_one(out, values), ...);
}

}  // namespace

void write(const Problem& p, ByteWriter& out) {
  const auto& [side, track, wheelset, state, roller, vertical, longitudinal, springs, regime, history, step_rule,
               reference, discretisation, material, friction, solver, iterations, normal, tangential, fastsim,
               influence, thermal, damping, sensitivities, refinement, surface, inclination, laws] = p;
  put_all(out, side, track, wheelset, state, roller, vertical, longitudinal, springs, regime, history, step_rule,
          reference, discretisation, material, friction, solver, iterations, normal, tangential, fastsim, influence,
          thermal, damping, sensitivities, refinement, surface, inclination, laws);
}

}  // namespace treadmark::wheelrail
