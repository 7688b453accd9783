// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/vehicle/track/rail_on_seats.hpp"

namespace treadmark::vehicle {

/// Scheme of Hilber, Hughes and Taylor (1977).
struct RailScheme {
  double alpha = 0.0, beta = 0.25, gamma = 0.5;
  /// spectral_radius: for fast vibrations, 0.5 to 1.
  static RailScheme of(double spectral_radius);
};

/// Motion of a part of a rail in one plane, in steps, under forces on its top at places that move along. Vectors hold
/// for each place one number for each motion of the top. Not thread-safe; const functions are among each other.
class RailInTime {
 public:
  using Column = BandedSymmetric<double>::Column;
  using Columns = Eigen::MatrixXd;

  RailInTime(RailPlane plane, const RailScheme& scheme) : plane_(plane), scheme_(scheme) {}

  RailPlane plane() const { return plane_; }
  const RailOnSeats& rail() const { return *rail_; }
  /// Makes this the part that is looked at; its motion stays what it was.
  void look_at(const FlexibleTrack& part);

  /// At rest and without load at time 0, for forces at these places that have come slowly at this speed [m/s].
  void rest(const std::vector<double>& places, double speed);
  /// What unit forces move the places by at rest, and the rates of the rail there, over which the forces move.
  const Columns& compliance_at_rest() const { return compliance_at_rest_; }
  const Columns& rates_at_rest() const { return rates_at_rest_; }

  /// How the tops at the places answer the forces at the end of a step: motions = free + compliance forces.
  struct Answer {
    Column free;
    Columns compliance;
  };
  /// A step of this length [s] from forces that were accepted at the places before. speeds: of the
  /// places at its end [m/s].
  void step(double length, const std::vector<double>& before, const std::vector<double>& now,
            const std::vector<double>& speeds);
  const Answer& motions() const { return trial_.motion; }
  /// Of the rail itself where the places are.
  const Answer& rates() const { return trial_.rate; }
  /// How much further a place is moved at its end than at its beginning, along the rail by its mean of the step.
  double rise(Eigen::Index place, Eigen::Index motion, const Column& forces) const;

  struct Moved {
    double energy = 0.0;      ///< at the end [J]
    double dissipated = 0.0;  ///< [J]
  };
  Moved moved(const Column& forces);
  /// At rest, as which power is dissipated [W].
  Moved moved_at_rest(const Column& forces) const;
  void begin(const Column& forces);
  void accept(const Column& forces);
  /// The part has moved on by a bay of so many elements: what it leaves is forgotten, what comes rests.
  void move_on(int bay_elements);

  void save(ByteWriter& out) const;
  /// False: of another part.
  bool restore(ByteReader& in);

 private:
  /// A step, as far as it does not depend on the forces at its end.
  struct Trial {
    double length = 0.0;
    std::vector<RailOnSeats::Place> place, before;
    std::vector<std::vector<const Column*>> unit;  ///< accelerations by unit forces at the places' coordinates
    Column known_q, known_v, free;                 ///< free: accelerations without the forces
    double of_q = 0.0, of_v = 0.0;                 ///< of displacements and rates by accelerations
    /// Forces that what lies between nodes follows: a share of those at the end and what is known.
    double follows = 0.0;
    Column known_followed;
    Answer motion, rate;
  };
  /// Where a step ends.
  struct End {
    Column forces, q, v, a;
  };
  Eigen::Index motions_of_top() const { return top_motions(plane_); }
  std::vector<RailOnSeats::Place> at(const std::vector<double>& places) const;
  void factorise(double length);
  const Column& by_unit(int coordinate);
  const End& end(const Column& forces);
  Column followed(const Column& forces) const { return trial_.follows * forces + trial_.known_followed; }

  RailPlane plane_;
  RailScheme scheme_;
  std::unique_ptr<const RailOnSeats> rail_;
  // At rest, under unit forces.
  Columns unit_q_, unit_v_, compliance_at_rest_, rates_at_rest_;
  std::vector<RailOnSeats::Place> place_at_rest_;

  Column force_, q_, v_, a_;
  Column followed_;             ///< forces that what lies between nodes has followed so far
  Column followed_before_;      ///< a step earlier
  double length_before_ = 0.0;  ///< of that step [s]; 0: none
  Trial trial_;
  End end_;
  double factors_of_ = -1.0;  ///< length of a step
  BandedSymmetric<double> factors_;
  std::map<int, Column> by_unit_;  ///< accelerations by unit forces at coordinates, for that length
};

}  // namespace treadmark::vehicle
