// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/vehicle/rail_on_seats.hpp"

namespace treadmark::vehicle {

/// A rail of a flexible track in time, below vertical forces that move along it at one constant speed. The part of the
/// rail that is looked at moves on with the forces, from bay to bay; what it leaves behind and takes up in front lies
/// at rest. Before its first seat and behind its last one the track goes on with equal ones. Integrated by the scheme
/// of Hilber, Hughes and Taylor (1977). Not thread-safe; const functions are among each other.
class MovingRail {
 public:
  /// Of the part that is looked at, beside the distance of the forces [m].
  static constexpr double kUsualLength = 30.0;
  /// More of FlexibleTrack::bay_elements are not used.
  static constexpr int kMostBayElements = 8;

  /// A number for each force.
  using Forces = Eigen::VectorXd;

  /// speed [m/s]; > 0. start: places of the forces at time 0, from the middle of the bay in the middle of the track
  /// [m]; no two of them on one element. spectral_radius: of the scheme for fast vibrations, 0.5 to 1. length: of the
  /// part that is looked at, beside the distance of the forces [m], made longer where that is less than 20 sleepers.
  /// Errors: Error(configuration).
  MovingRail(const FlexibleTrack& track, double speed, const std::vector<double>& start, double spectral_radius,
             double length = kUsualLength);

  Eigen::Index forces() const { return static_cast<Eigen::Index>(start_.size()); }

  /// How the places under the forces answer them at some time: deflections = free + compliance forces. Dips of joints
  /// are part of free.
  struct Answer {
    Forces free;                 ///< [m]
    Eigen::MatrixXd compliance;  ///< [m/N]
  };
  /// The rail at time 0, under forces that have come slowly: at rest but for dampers [m/N].
  const Eigen::MatrixXd& compliance_at_rest() const { return compliance_at_rest_; }
  /// Dips of joints below the forces then [m].
  Forces dips_at_rest() const;
  /// After a step to this time, from what was accepted last.
  const Answer& after(double time);

  // What forces at that time, of which after was asked last, mean.
  const Answer& deflections() const { return trial_->deflection; }
  /// Rates of the deflections under the forces, which move: free [m/s], compliance [m/(s N)].
  const Answer& rates() const { return trial_->rate; }
  /// Horizontal force on what presses on the rail there, over the force: mean of the step.
  double slope(Eigen::Index place, const Forces& forces) const;
  struct Moved {
    double energy = 0.0;  ///< kinetic and elastic energy at the step's end [J]
    double power = 0.0;   ///< of all dampers, >= 0: mean of the step [W]
  };
  Moved moved(const Forces& forces) const;
  /// At time 0, under these forces.
  Moved moved_at_rest(const Forces& forces) const;

  /// Makes the state at rest under these forces that of time 0.
  void begin(const Forces& forces);
  /// Makes the state after the step that of moved(forces).
  void accept(const Forces& forces);
  double time() const { return time_; }

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data).
  void restore(ByteReader& in);

 private:
  using Column = BandedSymmetric<double>::Column;
  using Columns = Eigen::MatrixXd;
  /// A step to some time, as far as it does not depend on the forces at its end.
  struct Trial {
    double time = 0.0, length = 0.0;  ///< length: of the step
    std::vector<RailOnSeats::Place> place, before;
    Column known_q, known_v, free;  ///< free: accelerations without the forces
    Columns unit;                   ///< accelerations by a unit of each
    double of_q = 0.0, of_v = 0.0;  ///< of displacements and rates by accelerations
    Answer deflection, rate;        ///< at the places under the forces
  };

  double place_at(double start, double time) const { return start + speed_ * time; }
  std::vector<RailOnSeats::Place> places_at(double time) const;
  double dip(double x) const;
  double dip_slope(double x) const;
  RailSeat seat(std::int64_t index) const;
  void look_from(std::int64_t first_seat);
  void spread(const RailOnSeats::Place& place, double force, Column& f) const;
  void factorise(double length);
  const Column& by_unit(int coordinate);
  void move_on();

  FlexibleTrack track_;
  double speed_, alpha_, beta_, gamma_;
  std::vector<double> start_;  ///< place at time 0 [m]
  double last_start_ = 0.0;    ///< of the hindmost force [m]
  /// Of the part that is looked at, and how many of them are about the hindmost force.
  std::int64_t seats_ = 0, seats_about_ = 0;
  Column calm_;              ///< factors on what stays in it as it moves
  double next_place_ = 0.0;  ///< of the hindmost force, where the part moves on [m]
  // At time 0, under a force of 1 N at each place.
  Columns unit_q_, unit_v_;
  Eigen::MatrixXd compliance_at_rest_;
  Forces own_at_rest_;                       ///< of it what the coordinates do not follow
  std::unique_ptr<const RailOnSeats> rail_;  ///< the part

  double time_ = 0.0;
  Forces force_;
  std::int64_t first_seat_ = 0;  ///< of the part; 0 is the first one of the track
  Column q_, v_, a_;
  std::optional<Trial> trial_;
  double factors_of_ = -1.0;  ///< length of a step
  BandedSymmetric<double> factors_;
  std::map<int, Column> by_unit_;  ///< accelerations by unit forces at coordinates
};

}  // namespace treadmark::vehicle
