// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {

/// Where a rail's profile origin is at rest, by gauge and cant, in track axes [m]. Errors: as wheelrail::place.
Vec3 rail_marker_at_rest(const wheelrail::Geometry& geometry, const wheelrail::Problem& problem);

/// Contact of any wheel on any rail as wheelrail::Pair solves it at the positions and velocities of every instant.
/// Steady rolling forgets; transient rolling carries the tractions of the accepted instants on.
class FullContact : public ContactElement {
 public:
  /// problem: everything but motions and forces; its regime, steady or transient, is that of rolling.
  /// Errors: Error(configuration).
  FullContact(wheelrail::Geometry geometry, wheelrail::Problem problem);

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override;
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

  /// Of the evaluation before the last accept(), with all fields.
  const wheelrail::PairSolution& solution() const { return solution_; }
  /// Seconds spent in every evaluation since construction.
  const wheelrail::PhaseTimes& times() const { return times_; }
  const wheelrail::Problem& problem() const { return problem_; }

 private:
  wheelrail::Problem problem_;
  wheelrail::Pair pair_;
  std::shared_ptr<const wheelrail::Pair::State> accepted_;
  bool started_ = false;        ///< an instant has been accepted
  double accepted_x_ = 0.0;     ///< where [m]
  double tried_x_ = 0.0;
  wheelrail::PairSolution solution_;
  wheelrail::PhaseTimes times_;
};

}  // namespace treadmark::vehicle
