// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/solvers/vehicle/track/moving_rail.hpp"

namespace treadmark::vehicle {

/// A rail that bends below wheels, which feel each other through it, and the forces that they press with. Each wheel
/// counts on forces of the others that are predicted, until all have said theirs; settle then says what to count on if
/// they try again. Between wheels further apart than a wave runs in a step that changes nothing to speak of.
/// Thread-safe for calls of different wheels up to settle and accept, for one time.
class LoadedRail {
 public:
  /// loads: vertical ones of the wheels at rest [N], one for each place of the rail. Errors: Error(configuration).
  LoadedRail(MovingRail rail, const std::vector<double>& loads);

  std::size_t wheels() const { return pressed_.size(); }
  /// Whether an instant has been accepted; until then the rail is at rest under forces that have come slowly.
  bool started() const { return started_; }
  double load(std::size_t wheel) const { return load_[index(wheel) + 1]; }

  /// Of a wheel's place, y, z and roll of the rail's top, by the wheel's own forces on these; what forces of the others
  /// add as they are counted on is part of free.
  struct Answer {
    Vec3 free;                   ///< [m], [rad]
    Mat3 compliance;             ///< of them by forces
    Vec3 rate;                   ///< of the rail there [m/s], [rad/s]
    Mat3 rate_by_force;          ///< of these
    Eigen::VectorXd counted_on;  ///< forces of the others, 0 at the wheel
    Vec3 motion(const Vec3& force) const { return free + compliance * force; }
    Vec3 rate_under(const Vec3& force) const { return rate + rate_by_force * force; }
  };
  Answer at_rest(std::size_t wheel) const;
  Answer after(std::size_t wheel, double time);
  /// Forces of a wheel as others count on them at a time.
  Vec3 counted_on(std::size_t wheel, double time) const { return counted_on(time).segment<3>(index(wheel)); }
  /// Slopes of the rail along it below a wheel: mean of the step.
  Vec3 slope(std::size_t wheel, const Vec3& force, const Answer& answer) const;

  /// What a wheel found at a time, how its forces fall with motions of the rail that others make, and how far it has
  /// got since time 0 [m].
  void press(std::size_t wheel, const Vec3& force, const Mat3& stiffness, double travelled) {
    pressed_[wheel] = {force, stiffness, travelled};
  }
  /// What the forces pressed move a wheel's place by beyond what it counted on for the others.
  Vec3 missed(std::size_t wheel, const Answer& answer) const;
  /// The rail under the forces pressed.
  MovingRail::Moved moved() { return started_ ? rail_.moved(pressed()) : rail_.moved_at_rest(pressed()); }
  /// All have pressed: what to count on at the same time from now on.
  void settle(double time);
  /// Under the forces pressed.
  void accept(double time);

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data).
  void restore(ByteReader& in);

 private:
  struct Pressed {
    Vec3 force = Vec3::Zero();
    Mat3 stiffness = Mat3::Zero();
    double travelled = 0.0;
  };
  struct Instant {
    double time = 0.0;
    Eigen::VectorXd force;
  };
  /// Of a wheel's first number.
  static Eigen::Index index(std::size_t wheel) { return MovingRail::kMotions * static_cast<Eigen::Index>(wheel); }
  Answer answer(std::size_t wheel, const Eigen::VectorXd& counted_on, const MovingRail::Answer& motions,
                const MovingRail::Answer& rates) const;
  static Eigen::VectorXd held_down(Eigen::VectorXd forces);
  Eigen::VectorXd pressed() const;
  Eigen::VectorXd counted_on(double time) const;
  const Eigen::MatrixXd& compliance() const;

  MovingRail rail_;
  std::mutex solving_;
  Eigen::VectorXd load_;
  std::vector<Pressed> pressed_;
  std::vector<double> first_;  ///< travelled, at time 0
  bool started_ = false;
  Instant last_, before_;         ///< accepted
  std::optional<Instant> trial_;  ///< settled
};

}  // namespace treadmark::vehicle
