// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::measures {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// A number that was measured, or why it was not.
struct Measure {
  double value = kUnknown;        ///< SI; NaN: not measured
  double uncertainty = kUnknown;  ///< half width that holds the true value in 95 of 100 cases, from the points' scatter
                                  ///< alone; NaN: unknown
  std::string reason;             ///< of a number that was not measured

  bool known() const { return value == value; }
};

/// One cross-section as a smooth curve through its points, in profile coordinates (y to the right, z down) [m], run
/// through with growing y on the whole: a rail from its gauge side, a wheel from its flange back. Immutable but for
/// moving; safe from any thread.
class Section {
 public:
  /// noise: standard deviation of the points across the curve, which runs through them [m]; negative: they are smoothed
  /// by their own noise (analysis/measured/smoothing.hpp).
  /// Errors: Error(input_data) for fewer than 8 points.
  explicit Section(const Profile& points, double noise = -1.0);

  Body body() const { return body_; }
  double noise() const { return noise_; }
  std::size_t size() const { return nodes_.size(); }
  const Vec2& point(std::size_t i) const { return nodes_[i].p; }
  double y_min() const { return y_min_; }
  double y_max() const { return y_max_; }
  double z_min() const { return z_min_; }
  double z_max() const { return z_max_; }

  /// A place on the curve.
  struct Place {
    std::size_t node = 0;          ///< of the interval's start
    double t = 0.0;                ///< 0 ... 1 in the interval
    Vec2 p = Vec2::Zero();         ///< [m]
    Vec2 tangent = Vec2::UnitX();  ///< unit, the way the curve runs
    double error = 0.0;            ///< standard deviation across the curve [m]

    double angle() const;  ///< of the tangent, atan2(dz, dy) [rad]
  };
  /// Where the curve crosses the line normal . p = offset (normal of unit length), in its order.
  std::vector<Place> crossings(const Vec2& normal, double offset) const;
  /// The first place with this y or the last one, if there is one.
  std::optional<Place> first_at_y(double y) const;
  /// z at the outermost place with this y: least of a rail, greatest of a wheel; NaN: none.
  double z_at(double y) const;
  /// The same at y = first, first + step ...; quicker than one by one.
  std::vector<double> z_over(double first, double step, std::size_t count) const;
  /// y at z = first, first + step ..., of several the one farthest out on a side (-1: least, +1: greatest) of y = 0;
  /// NaN: none there.
  std::vector<double> y_over(double first, double step, std::size_t count, int side) const;
  /// Where direction . p is greatest among nodes from ... to (inclusive), parabola through its neighbours.
  Place farthest(const Vec2& direction, std::size_t from, std::size_t to) const;
  /// The place at a node.
  Place at(std::size_t node) const { return at(node, 0.0); }

  /// Turned by turn (y towards z), then shifted.
  void move(double turn, const Vec2& shift);
  /// What is known of the error across the curve, instead of what the noise leaves [m]; NaN: nothing is. Places within
  /// some millimetres share it.
  void claim_error(double error);
  /// Standard deviation of what `count` nodes over a length [m] would be off by, each by itself, if their mean is known
  /// as well as it is: their noise, or more where they share a claimed error. NaN: unknown.
  double scatter(std::size_t count, double length) const;
  /// Turned over: y becomes -y and the order is reversed.
  Section mirrored() const;

 private:
  struct Node {
    Vec2 p, tangent;
    double error;
  };
  Place at(std::size_t node, double t) const;
  /// Coordinate 1 - axis where coordinate axis passes a grid; better(candidate, kept).
  template <class Better>
  std::vector<double> over(int axis, double first, double step, std::size_t count, const Better& better) const;
  void find_extent();

  Body body_ = Body::rail;
  double noise_ = 0.0;
  std::optional<double> claimed_;
  double y_min_ = 0.0, y_max_ = 0.0, z_min_ = 0.0, z_max_ = 0.0;
  std::vector<Node> nodes_;
};

/// The section of a surface at station u (x of a rail [m], theta of a wheel [rad]): seen from above and from both sides
/// at 60 degrees, so that flange and gauge face are whole. z = 0 of a wheel is at nominal_radius. step: between points
/// [m]. Errors: Error(input_data) where there is no surface.
Profile section_points(const Surface& surface, Body body, double nominal_radius, double u, double step);

}  // namespace treadmark::measures
