// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/solvers/vehicle/implicit_step.hpp"

namespace treadmark::vehicle {

/// How far and how exactly to integrate.
struct SimulationSettings {
  double duration = 0.0;                                       ///< [s]
  double position_tolerance = 1e-8;                            ///< what a step may add to the error of a position [m]
  double max_step = 1e-3, min_step = 1e-9, first_step = 1e-6;  ///< [s]
  double max_travel = 1e-3;                                    ///< of the vehicle per step [m]
  double event_tolerance = 1e-9;                               ///< of the time of an event [s]
  StepSettings step;
};
/// Errors: Error(configuration) for settings that make no sense.
void check(const SimulationSettings& settings);

/// A wheel that loses contact or regains it.
struct ContactEvent {
  double time = 0.0;      ///< [s]
  std::size_t wheel = 0;  ///< index in VehicleOnTrack::wheels
  bool regained = false;
};

/// Energy since the start [J]. Mechanical + dampers = start + work of the contacts + work of the line + numerical.
struct EnergyBalance {
  double mechanical = 0.0;    ///< kinetic, of springs, of bump stops, of sticking friction, of weights
  double dampers = 0.0;       ///< dissipated, by dry friction of the vehicle too
  double contact_work = 0.0;  ///< of the contact forces on the motion about the reference configuration
  double drive = 0.0;         ///< work of the reference configuration, as it travels, on the contacts
  double line = 0.0;          ///< on the vehicle, as it bends and turns; of torques on axles. 0 without a line
  double friction = 0.0;      ///< dissipated in the contacts, as they say
  double elastic = 0.0;       ///< stored in the contacts, as they say
  double turnover = 0.0;      ///< sum of |work| of all contacts and dampers: what errors are compared with
  /// What the integration lost or gained.
  double integration_error(const EnergyBalance& start) const {
    return mechanical - start.mechanical + dampers - contact_work - line;
  }
  /// What is missing between the work put into the contacts and what they store and dissipate.
  double contact_error(const EnergyBalance& start) const {
    return drive - contact_work - friction - (elastic - start.elastic);
  }
};

/// Integrates a vehicle on a track in time. Steps are as long as the error estimate, the travel per step and the
/// duration allow; they end where a wheel loses or regains contact, and at points of torques, forces, motions and
/// speeds that are nearer to each other than a step. A step that is repeated starts from the same state, contact
/// history included. Results do not depend on the number of threads. Not thread-safe.
class Simulation {
 public:
  /// start: from find_equilibrium, or any other state; the wheels of the vehicle must be connected. Accepts the
  /// contacts at the start. Errors: Error(configuration) for settings that make no sense, Error(numerical) if a contact
  /// cannot be solved at the start.
  Simulation(VehicleOnTrack vehicle, const SystemState& start, const SimulationSettings& settings);

  /// Whether the duration is over, or the vehicle derailed.
  bool finished() const { return !derailed_.empty() || motion_.state.time >= settings_.duration * (1.0 - 1e-12); }
  /// Which wheel has parted from its rail and where, just behind the last step; empty: none.
  const std::string& derailed() const { return derailed_; }
  /// One step. Errors: Error(numerical) where the step becomes too short, with the reason; the simulation stays at the
  /// last good state. Cancelled (core/cancellation.hpp) leaves everything as it was before the step.
  void advance();

  /// The vehicle as it was given.
  const VehicleOnTrack& vehicle() const { return *vehicle_; }
  /// After the last step.
  const SystemState& state() const { return motion_.state; }
  /// Of all coordinates after the last step, of the scheme.
  const Vector& acceleration() const { return motion_.a; }
  /// Of the columns of Multibody::elements after the last step [N].
  const Vector& element_force() const { return motion_.element_force; }
  /// By which a column of Multibody::elements is displaced after the last step [m].
  double element_stretch(int column) const;
  /// What the elements remember after the last step (ForceElements::fresh_memory).
  const Vector& element_memory() const { return motion_.element_memory; }
  /// Of all wheels after the last step, in the order of VehicleOnTrack::wheels.
  const std::vector<ContactReaction>& reactions() const { return reactions_; }
  /// Since the start, in the order of time.
  const std::vector<ContactEvent>& events() const { return events_; }
  /// After the last step.
  const EnergyBalance& energy() const { return energy_; }
  /// What errors of energy are taken against.
  const EnergyBalance& energy_at_start() const { return energy_at_start_; }
  /// Work since the start.
  struct Counts {
    long steps = 0, rejected = 0, evaluations = 0;  ///< steps accepted and repeated; iterations in all of them
  };
  /// Work since the start.
  const Counts& counts() const { return counts_; }

  /// Everything on which the following steps depend, contact elements included, to the last bit.
  void save(ByteWriter& out) const;
  /// Into a simulation of the same vehicle and settings. Errors: Error(input_data).
  void restore(ByteReader& in);

 private:
  void take_step();
  Step attempt(double length);
  Step locate_event(const Step& step, double length);
  bool changes_contact(const Step& step) const;
  void accept(Step step);
  double longest_step() const;

  std::unique_ptr<VehicleOnTrack> vehicle_;
  SimulationSettings settings_;
  ImplicitStep scheme_;
  Motion motion_;
  double next_step_ = 0.0;
  std::vector<ContactReaction> reactions_;
  std::vector<ContactEvent> events_;
  EnergyBalance energy_, energy_at_start_;
  std::optional<LineState> line_;  ///< after the last step
  Counts counts_;
  std::string derailed_;
};

}  // namespace treadmark::vehicle
