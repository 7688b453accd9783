// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/vehicle/rail_on_seats.hpp"

namespace treadmark::vehicle {

/// A rail of a flexible track in time, below one vertical force that moves along it at constant speed. The part of the
/// rail that is looked at moves on with the force, from bay to bay; what it leaves behind and takes up in front lies at
/// rest. Before its first seat and behind its last one the track goes on with equal ones. Integrated by the scheme of
/// Hilber, Hughes and Taylor (1977). Not thread-safe.
class MovingRail {
 public:
  /// Of the part that is looked at [m].
  static constexpr double kUsualLength = 30.0;
  /// More of FlexibleTrack::bay_elements are not used.
  static constexpr int kMostBayElements = 8;

  /// speed [m/s]; > 0. start: place of the force at time 0, from the middle of the bay in the middle of the track [m].
  /// spectral_radius: of the scheme for fast vibrations, 0.5 to 1. length: of the part that is looked at [m], made
  /// longer where that is less than 20 sleepers. Errors: Error(configuration).
  MovingRail(const FlexibleTrack& track, double speed, double start, double spectral_radius,
             double length = kUsualLength);

  /// How the place under the force answers a force at some time: deflection = free + compliance * force.
  struct Answer {
    double free = 0.0;        ///< [m]
    double compliance = 0.0;  ///< [m/N]
  };
  /// The rail at time 0, under a force that has come slowly: at rest but for dampers.
  Answer at_rest() const { return {0.0, compliance_at_rest_}; }
  /// After a step to this time, from what was accepted last.
  Answer after(double time);

  /// What a force at that time, of which after was asked last, means.
  /// Rate of the deflection under the force, which moves [m/s].
  double rate(double force) const;
  struct Moved {
    double slope = 0.0;   ///< horizontal force on what presses on the rail, over the force: mean of the step
    double energy = 0.0;  ///< kinetic and elastic energy at its end [J]
    double power = 0.0;   ///< of all dampers, >= 0: mean of the step [W]
  };
  Moved moved(double force) const;
  /// At time 0, under this force.
  Moved moved_at_rest(double force) const {
    return {0.0, energy_at_rest_ * force * force, power_at_rest_ * force * force};
  }

  /// Makes the state of at_rest under this force, that of time 0.
  void begin(double force);
  /// Makes the state after the step that of moved(force).
  void accept(double force);
  double time() const { return time_; }

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data).
  void restore(ByteReader& in);

 private:
  using Column = BandedSymmetric<double>::Column;
  /// A step to some time, as far as it does not depend on the force at its end.
  struct Trial {
    double time = 0.0, length = 0.0;  ///< length: of the step
    RailOnSeats::Place place, before;
    Column known_q, known_v, free, unit;  ///< accelerations without the force, and by a unit of it
    double of_q = 0.0, of_v = 0.0;        ///< of displacements and rates by accelerations
    // At the place under the force, without it and by a unit of it.
    Answer deflection, rate;
  };

  double place_at(double time) const { return start_ + speed_ * time; }
  RailSeat seat(std::int64_t index) const;
  void look_from(std::int64_t first_seat);
  Column spread(const RailOnSeats::Place& place) const;
  static double along(const RailOnSeats::Place& place, const BeamVector& by, const Column& q);
  void factorise(double length);
  const Column& by_unit(int coordinate);
  void move_on();

  FlexibleTrack track_;
  double speed_, start_, alpha_, beta_, gamma_;
  std::int64_t seats_ = 0;   ///< of the part that is looked at
  Column calm_;              ///< factors on what stays in it as it moves
  double next_place_ = 0.0;  ///< of the force, where the part moves on [m]
  // At time 0, under a force of 1 N.
  Column unit_q_, unit_v_;
  double compliance_at_rest_ = 0.0, energy_at_rest_ = 0.0, power_at_rest_ = 0.0;
  std::unique_ptr<const RailOnSeats> rail_;  ///< the part

  double time_ = 0.0, force_ = 0.0;
  std::int64_t first_seat_ = 0;  ///< of the part; 0 is the first one of the track
  Column q_, v_, a_;
  std::optional<Trial> trial_;
  double factors_of_ = -1.0;  ///< length of a step
  BandedSymmetric<double> factors_;
  std::map<int, Column> by_unit_;  ///< accelerations by unit forces at coordinates
};

}  // namespace treadmark::vehicle
