// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/solvers/vehicle/contact_element.hpp"
#include "treadmark/solvers/vehicle/contacts/friction_along.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {

/// Where a rail's profile origin is at rest, by gauge and cant, in track axes [m]. Errors: as wheelrail::place.
Vec3 rail_marker_at_rest(const wheelrail::Geometry& geometry, const wheelrail::Problem& problem);

/// Contact of any wheel on any rail as wheelrail::Pair solves it at the positions and velocities of every instant.
/// Steady rolling forgets; transient rolling carries the tractions of the accepted instants on.
class FullContact : public ContactElement {
 public:
  /// problem: everything but motions and forces; its regime, steady or transient, is that of rolling. rail_x: place of
  /// the axle along the rail where it has travelled nothing [m]. usual_travel: of most steps of transient rolling [m],
  /// 0: not known; it makes them cheaper. friction: that varies, in place of the problem's; steps are short against it.
  /// Errors: Error(configuration).
  FullContact(const wheelrail::Geometry& geometry, wheelrail::Problem problem, double rail_x = 0.0,
              double usual_travel = 0.0, FrictionAlong friction = {});

  ContactReaction evaluate(const PairMotion& motion) override;
  void accept() override;
  bool costly() const override { return true; }
  /// As if no instant had been accepted: the next one rolls steadily.
  void forget();
  void save(ByteWriter& out) const override;
  void restore(ByteReader& in) override;

  /// What an evaluation goes on from.
  struct Past {
    std::shared_ptr<const wheelrail::Pair::State> state;
    bool started = false;  ///< there was an instant
    double x = 0.0;        ///< distance travelled then [m]
  };
  /// An instant as it can be solved again, with all fields and the same bits.
  struct Instant {
    Past before;
    PairMotion motion;
  };
  /// The one accepted last.
  const Instant& accepted() const { return accepted_; }
  /// Whether the instant at this time has been accepted, and none later.
  bool holds(double time) const { return past_.started && accepted_.motion.time == time; }
  /// Solves an instant again; what the next evaluations go on from stays as it is.
  wheelrail::PairSolution repeat(const Instant& instant);
  static void write(const Instant& instant, ByteWriter& out);
  static Instant read(ByteReader& in);

  /// Time spent in all evaluations since construction.
  const wheelrail::PhaseTimes& times() const { return times_; }

 private:
  bool goes_on(const Past& past, const PairMotion& motion) const;
  wheelrail::PairSolution solve(const Past& past, const PairMotion& motion);

  wheelrail::Problem problem_;  ///< with the friction where it was solved last
  double rail_x_;
  FrictionAlong friction_;
  wheelrail::Pair pair_;
  Past past_;
  bool at_past_ = false;  ///< the pair is as the past left it
  PairMotion tried_;
  Instant accepted_;
  wheelrail::PhaseTimes times_;
};

}  // namespace treadmark::vehicle
