// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/vehicle/track_layout.hpp"

namespace treadmark::vehicle {

/// A function of the distance along the track and its derivatives by it.
struct Along {
  double value = 0.0, first = 0.0, second = 0.0;  ///< f, df/ds, d2f/ds2 [m] and powers of 1/m, or as said
};

/// The track frame T (core/README.md) at one place of a line, the path frame: origin on the track centre line in the
/// plane of the rail tops, x horizontal along the line in plan, y and z turned about x by the cant. L is the frame of
/// the whole line: that of its beginning without cant. Where elements meet, derivatives are those of the element behind
/// the joint.
struct PathPoint {
  double distance = 0.0;         ///< s, along the centre line in plan [m]
  Vec3 origin_L = Vec3::Zero();  ///< [m]
  double heading = 0.0;          ///< psi, about z; not wrapped [rad]
  Along curvature;               ///< dpsi/ds [1/m]
  Along cant;                    ///< height of the left rail over the right one [m]
  Along cant_angle;              ///< phi, about x [rad]
  Along height;                  ///< z of the origin, down [m]
  Along gauge;                   ///< [m]

  Pose X_LT() const;       ///< R = Rz(psi) Rx(phi)
  Vec3 tangent_L() const;  ///< d origin / ds
  /// How the frame turns over the distance, in its own axes: dR/ds = R [turn]x [rad/m].
  Vec3 turn() const;
  Vec3 turn_first() const;  ///< d turn / ds [rad/m2]
};

/// A point in the plane x = 0 of the path frame at a distance.
struct PathPlace {
  double distance = 0.0, y = 0.0, z = 0.0;  ///< [m]
};

/// The geometry of a line. Curvature, cant and gauge follow the shapes of its elements exactly; heading is their
/// integral in closed form; positions are closed forms on straights and circles, and Gauss-Legendre quadrature (error
/// below 1e-12 of the length) on transitions. Immutable; safe to use from several threads.
class TrackPath {
 public:
  /// Errors: those of check(layout).
  explicit TrackPath(TrackLayout layout);

  /// As given.
  const TrackLayout& layout() const { return layout_; }
  double length() const { return starts_.back().distance; }  ///< [m]

  /// Any distance; before the beginning and behind the end the line is straight or a circle.
  PathPoint at(double distance) const;
  /// The point in L of a place [m].
  Vec3 to_space(const PathPlace& place) const;

  /// Where a point of space is on the path: the place whose plane x = 0 contains it, next to `near`. Nothing where
  /// there is none: behind the centre of a curve, or further away than Newton's method reaches.
  std::optional<PathPlace> locate(const Vec3& point_L, double near) const;
  /// The same from the part of the line that is nearest.
  std::optional<PathPlace> locate(const Vec3& point_L) const;

  /// Largest step of the curvature where elements meet [1/m]; 0 for a line with transitions everywhere.
  double largest_curvature_step() const;

 private:
  struct Start {
    double distance = 0.0, x = 0.0, y = 0.0, heading = 0.0;
  };
  std::size_t element_at(double distance) const;

  TrackLayout layout_;
  std::vector<Start> starts_;  ///< of the elements, and the end of the line
};

}  // namespace treadmark::vehicle
