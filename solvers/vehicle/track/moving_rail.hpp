// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <vector>

#include "treadmark/model/vehicle/driving.hpp"
#include "treadmark/solvers/vehicle/track/rail_in_time.hpp"

namespace treadmark::vehicle {

/// A rail of a flexible track in time, below forces that move along it, nearly together. The part of the rail that is
/// looked at moves on with the forces, from bay to bay; what it leaves behind and takes up in front lies at rest.
/// Before its first seat and behind its last one the track goes on with equal ones. Integrated by the scheme of Hilber,
/// Hughes and Taylor (1977). Not thread-safe; const functions are among each other.
class MovingRail {
 public:
  /// Of the part that is looked at, beside the distance of the forces [m].
  static constexpr double kUsualLength = 30.0;
  /// More of FlexibleTrack::bay_elements are not used.
  static constexpr int kMostBayElements = 8;

  /// At each place three numbers for the motions y, z and roll of the rail's top, or forces on them [N], [N m]: y and
  /// roll stay 0 on rails that bend vertically only.
  using Forces = Eigen::VectorXd;
  static constexpr Eigen::Index kMotions = 3;

  /// speed: along the rail. start: places of the forces at time 0, from the middle of the bay in the middle of the
  /// track [m]; no two of them on one element. spectral_radius: of the scheme for fast vibrations, 0.5 to 1. length: of
  /// the part that is looked at, beside the distance of the forces [m], made longer where that is less than 20
  /// sleepers. Errors: Error(configuration).
  MovingRail(const FlexibleTrack& track, const SpeedProfile& speed, const std::vector<double>& start,
             double spectral_radius, double length = kUsualLength);

  /// Places.
  Eigen::Index places() const { return static_cast<Eigen::Index>(start_.size()); }

  /// How the places answer the forces at some time: motions = free + compliance forces. Dips of joints are part of
  /// free.
  using Answer = RailInTime::Answer;
  /// The rail at time 0, under forces that have come slowly: at rest but for dampers.
  const Answer& motions_at_rest() const { return motion_at_rest_; }
  /// Rates of the rail itself then where the places are, over which they move.
  const Answer& rates_at_rest() const { return rate_at_rest_; }
  /// After a step to this time, from what was accepted last.
  const Answer& after(double time);

  // What forces at that time, of which after was asked last, mean.
  const Answer& motions() const { return motion_; }
  /// Rates of the rail itself where the places are, over which they move.
  const Answer& rates() const { return rate_; }
  /// Slopes of the motions along the rail at a place: mean of the step.
  Eigen::Vector3d slope(Eigen::Index place, const Forces& forces) const;
  struct Moved {
    double energy = 0.0;  ///< kinetic and elastic energy at the step's end [J]
    double power = 0.0;   ///< of all dampers, >= 0: mean of the step [W]
  };
  Moved moved(const Forces& forces);
  /// At time 0, under these forces.
  Moved moved_at_rest(const Forces& forces) const;

  /// Makes the state at rest under these forces that of time 0.
  void begin(const Forces& forces);
  /// Makes the state after the step that of moved(forces). ahead: how much further each force has got since time 0 than
  /// the speed says, so that it goes on from there; none: not at all [m].
  void accept(const Forces& forces, const std::vector<double>& ahead = {});
  double time() const { return time_; }
  /// What the speed says [m].
  double travelled(double time) const { return travel_at(speed_, time).distance; }

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data).
  void restore(ByteReader& in);

 private:
  void find_places(double time);
  double dip(double x) const;
  RailSeat seat(std::int64_t index) const;
  void look_from(std::int64_t first_seat);

  FlexibleTrack track_;
  SpeedProfile speed_;
  std::vector<double> start_;  ///< place at time 0 [m]
  /// Of the part that is looked at, and how many of them are about the hindmost force.
  std::int64_t seats_ = 0, seats_about_ = 0;
  double next_place_ = 0.0;  ///< of the hindmost force, where the part moves on [m]
  Answer motion_at_rest_, rate_at_rest_;
  std::vector<RailInTime> planes_;

  /// Of each force: where the last step ended; beyond what the speed says, and its rate.
  struct Run {
    double place = 0.0, ahead = 0.0, rate = 0.0;  ///< [m], [m/s]
  };
  double time_ = 0.0;
  std::vector<Run> run_;
  std::int64_t first_seat_ = 0;  ///< of the part; 0 is the first one of the track
  // A step that was asked for.
  double trial_time_ = -1.0, trial_length_ = 0.0;  ///< [s]; < 0: none
  std::vector<double> before_, now_, speeds_;      ///< places, and speeds at the end
  Answer motion_, rate_;
};

}  // namespace treadmark::vehicle
