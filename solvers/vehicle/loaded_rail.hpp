// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

#include "treadmark/solvers/vehicle/moving_rail.hpp"

namespace treadmark::vehicle {

/// A rail that bends below wheels, which feel each other through it, and the forces that they press with. Each wheel
/// counts on forces of the others that are predicted, until all have said theirs; settle then says what to count on if
/// they try again. Between wheels further apart than a wave runs in a step that changes nothing to speak of.
/// Thread-safe for calls of different wheels up to settle and accept, for one time.
class LoadedRail {
 public:
  /// loads: of the wheels at rest [N], one for each force of the rail. Errors: Error(configuration).
  LoadedRail(MovingRail rail, const std::vector<double>& loads);

  std::size_t wheels() const { return pressed_.size(); }
  /// Whether an instant has been accepted; until then the rail is at rest under forces that have come slowly.
  bool started() const { return started_; }
  double load(std::size_t wheel) const { return load_[index(wheel)]; }

  /// At a wheel by its own force; what forces of the others add as they are counted on is part of free.
  struct Answer {
    double free = 0.0, compliance = 0.0;     ///< deflection [m], [m/N]
    double rate = 0.0, rate_by_force = 0.0;  ///< of it under the wheel, which moves [m/s], [m/(s N)]
    Eigen::VectorXd counted_on;              ///< forces of the others, 0 at the wheel [N]
    double deflection(double force) const { return free + compliance * force; }
    double rate_under(double force) const { return rate + rate_by_force * force; }
  };
  Answer at_rest(std::size_t wheel) const;
  Answer after(std::size_t wheel, double time);
  /// Force of a wheel as others count on it at a time [N].
  double counted_on(std::size_t wheel, double time) const { return counted_on(time)[index(wheel)]; }
  /// Horizontal force on a wheel, over its force: mean of the step.
  double slope(std::size_t wheel, double force, const Answer& answer) const;

  /// What a wheel found at a time, and how its force changes with a deflection that others make [N/m].
  void press(std::size_t wheel, double force, double stiffness) { pressed_[wheel] = {force, stiffness}; }
  /// What the forces pressed deflect a wheel's place by beyond what it counted on for the others [m].
  double missed(std::size_t wheel, const Answer& answer) const;
  /// The rail under the forces pressed.
  MovingRail::Moved moved() const { return started_ ? rail_.moved(pressed()) : rail_.moved_at_rest(pressed()); }
  /// All have pressed: what to count on at the same time from now on.
  void settle(double time);
  /// Under the forces pressed.
  void accept(double time);

  void save(ByteWriter& out) const;
  /// Errors: Error(input_data).
  void restore(ByteReader& in);

 private:
  struct Pressed {
    double force = 0.0, stiffness = 0.0;
  };
  struct Instant {
    double time = 0.0;
    Eigen::VectorXd force;
  };
  static Eigen::Index index(std::size_t wheel) { return static_cast<Eigen::Index>(wheel); }
  Eigen::VectorXd pressed() const;
  Eigen::VectorXd counted_on(double time) const;
  const Eigen::MatrixXd& compliance() const;

  MovingRail rail_;
  std::mutex solving_;
  Eigen::VectorXd load_;
  std::vector<Pressed> pressed_;
  bool started_ = false;
  Instant last_, before_;         ///< accepted
  std::optional<Instant> trial_;  ///< settled
};

}  // namespace treadmark::vehicle
