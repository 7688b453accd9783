// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/contact/friction.hpp"
#include "treadmark/model/contact/material.hpp"
#include "treadmark/model/contact/wheel_on_rail.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::wheelrail {

/// One wheel on one rail: what is given, in SI units.

using treadmark::Damping;
using treadmark::Discretisation;
using treadmark::RailSprings;
using treadmark::ReferenceSurface;
using treadmark::Roller;
using treadmark::Side;
using treadmark::SixMotion;
using treadmark::Track;
using treadmark::WheelsetDimensions;
using treadmark::WheelsetState;

/// The two bodies.
struct Geometry {
  std::shared_ptr<const Surface> rail, wheel;
  bool prismatic_rail = true;  ///< one profile along the track; false: a variable rail, or a roller
  bool round_wheel = true;     ///< one profile all round
  /// Whether the search may look along circles of the wheel.
  bool constant_profiles() const { return prismatic_rail && round_wheel; }
};

/// One instant: positions and velocities, or the forces instead of some of them, and what is asked of the contact.
struct Problem {
  Side side = Side::right;
  Track track;
  WheelsetDimensions wheelset;
  WheelsetState state;
  std::optional<Roller> roller;
  /// Vertical force on the rail [N], track axes: state.position.z is then sought. Otherwise z is prescribed.
  std::optional<double> vertical_force;
  /// Longitudinal force on the rail [N], wheelset axes: state.velocity.pitch is then sought. Otherwise the rate is
  /// prescribed.
  std::optional<double> longitudinal_force;
  std::optional<RailSprings> rail_springs;  ///< the rail's deflection is then sought
  /// A shift reads rates as displacements of the step. Transient rolling and shifts go on from the last solution as
  /// history says.
  kalker::Regime regime = kalker::Regime::steady;
  kalker::HistoryUse history = kalker::HistoryUse::start;
  /// Steps of transient rolling longer than dt = 2 dx / V: refused, else a remark.
  bool enforce_step_rule = true;
  ReferenceSurface reference_surface = ReferenceSurface::plane;
  Discretisation discretisation;
  Material material;
  FrictionLaw friction;
  kalker::SolverSettings solver;
  int max_force_iterations = 30;                                 ///< on prescribed forces
  kalker::NormalModel normal_model = kalker::NormalModel::full;  ///< full, kpec or analyn
  kalker::TangentialModel tangential_model = kalker::TangentialModel::full;
  kalker::FastsimSettings fastsim;
  kalker::InfluenceSettings influence;  ///< of angle-corrected ones the inclinations are the curved reference's
  std::optional<Thermal> thermal;
  std::optional<Damping> damping;
  bool sensitivities = false;
  bool refinement = false;     ///< what smaller elements would change is estimated
  bool surface_loads = false;  ///< PatchSolution::surface_loads is wanted
  /// Friction at inclinations of the rail's surface [rad], increasing; between them every number of the law is
  /// interpolated, beyond them it stays. Empty: friction is the same everywhere.
  std::vector<double> friction_inclination;
  std::vector<FrictionLaw> friction_laws;
  friend bool operator==(const Problem&, const Problem&) = default;
};

}  // namespace treadmark::wheelrail
