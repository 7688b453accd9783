// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace treadmark {

/// A track whose rails bend, as plain data in SI units: one rail on the seats of its sleepers, the other one is equal.
/// Axes: x forward along the rail, y to the right, z down; roll takes y towards z.

/// A rail as a beam of Timoshenko's theory.
struct RailBeam {
  double bending_stiffness = 0.0;  ///< E I [N m2]; > 0
  double shear_stiffness = 0.0;    ///< kappa G A [N]; > 0
  double mass = 0.0;               ///< of a unit of length [kg/m]; > 0
  double rotary_inertia = 0.0;     ///< rho I [kg m]; >= 0
  double damping_time = 0.0;       ///< damping over stiffness: loss factor over angular frequency [s]; >= 0
};

/// How a rail bends sideways and twists, beside RailBeam. Bending moves its shear centre, about which it rolls; heights
/// are above its foot.
struct RailSideways {
  double bending_stiffness = 0.0;             ///< E I about the vertical axis [N m2]; > 0
  double shear_stiffness = 0.0;               ///< kappa G A sideways [N]; > 0
  double rotary_inertia = 0.0;                ///< rho I about the vertical axis [kg m]; >= 0
  double torsional_stiffness = 0.0;           ///< G J of St Venant's torsion [N m2]; > 0
  double polar_inertia = 0.0;                 ///< rho (Iy + Iz) about the centroid [kg m]; > 0
  double height = 0.0;                        ///< of the top [m]; > 0
  double centroid = 0.0, shear_centre = 0.0;  ///< heights [m]; 0 to that of the top
  /// Of the top about the shear centre [m].
  double lever() const { return height - shear_centre; }
};

/// Where a sleeper carries a rail: pad, its half of the sleeper, ballast below that on rigid ground. What is lateral
/// counts with RailSideways only; sleepers do not roll.
struct RailSeat {
  double x = 0.0;              ///< [m]
  double pad_stiffness = 0.0;  ///< [N/m]; >= 0
  double pad_damping = 0.0;    ///< [N s/m]; >= 0
  double sleeper_mass = 0.0;   ///< half of it [kg]; > 0
  double bed_stiffness = 0.0;  ///< [N/m]; >= 0, 0: the sleeper hangs
  double bed_damping = 0.0;    ///< [N s/m]; >= 0

  double lateral_pad_stiffness = 0.0;  ///< at the foot [N/m]; >= 0
  double lateral_pad_damping = 0.0;    ///< [N s/m]; >= 0
  double roll_stiffness = 0.0;         ///< against rolling of the rail [N m/rad]; >= 0
  double roll_damping = 0.0;           ///< [N m s/rad]; >= 0
  double lateral_bed_stiffness = 0.0;  ///< [N/m]; >= 0
  double lateral_bed_damping = 0.0;    ///< [N s/m]; >= 0
};

/// Where two rails meet: fishplates carry shear, and moments by the angle that they open by.
struct RailJoint {
  double x = 0.0;                ///< on the coordinate of the seats [m]
  double hinge_stiffness = 0.0;  ///< moment over angle, vertically [N m/rad]; >= 0, 0: a hinge
  double dip_depth = 0.0;        ///< by which the unloaded rails' tops lie lower at the joint [m]; >= 0
  double dip_length = 1.0;       ///< to either side, over which the slope falls linearly to 0 [m]; > 0
  /// The same sideways; none: rails go on there as one.
  std::optional<double> lateral_hinge_stiffness = std::nullopt;
  /// How much lower than elsewhere the unloaded rail's top lies at a distance from the joint [m].
  double depth(double distance) const {
    const double left = 1.0 - std::abs(distance) / dip_length;
    return left > 0.0 ? dip_depth * left * left : 0.0;
  }
};

/// Sideways and in roll one spring and damper each above and below a half sleeper, as of a lumped track.
struct LateralSupport {
  double pad_stiffness = 0.0;  ///< [N/m]; > 0
  double pad_damping = 0.0;    ///< [N s/m]; >= 0
  double bed_stiffness = 0.0;  ///< [N/m]; > 0
  double bed_damping = 0.0;    ///< [N s/m]; >= 0
  double foot_width = 0.0;     ///< over which a pad resists rolling of the rail [m]; > 0
  double roll_inertia = 0.0;   ///< of the rail about its axis, over its mass [m2]; > 0
  double rail_mass = 0.0;      ///< that moves sideways at a wheel [kg]; > 0
  double sleeper_mass = 0.0;   ///< the same of half the sleepers [kg]; > 0
};

/// A rail of finite length: it begins half a bay before its first seat and ends half a bay behind its last one.
struct FlexibleTrack {
  std::string name, source;
  RailBeam rail;
  std::vector<RailSeat> seats;    ///< x increasing; at least two
  double gauge = 1.507;           ///< distance of the middles of both rails [m]
  int bay_elements = 16;          ///< beam elements from seat to seat
  int absorbing_bays = 0;         ///< at each end
  double absorption = 0.0;        ///< damping over mass at the outermost place, growing with the square from 0 [1/s]
  std::vector<RailJoint> joints;  ///< in any order, each between begin and end of the rail
  std::optional<RailSideways> sideways;   ///< none: rails bend vertically only
  std::optional<LateralSupport> lateral;  ///< none: rails that do not bend sideways do not move there
};

}  // namespace treadmark
