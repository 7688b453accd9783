// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <numbers>
#include <optional>

namespace treadmark {

/// Where a wheel and a rail are, how they move, and how their contact is looked for: plain data in SI units. A
/// left-hand pair is described with its own true signs (y to the right); profiles are always given as for the
/// right-hand side.

/// Side of the track, seen along x.
enum class Side { left, right };

/// Where the rail lies on the track and how it moves.
struct Track {
  bool gauge_based = true;  ///< else rail_y0, rail_z0 place the rail's profile origin
  /// The innermost point of all that lies high enough counts; else that of the head alone, without a keeper beside a
  /// groove.
  bool gauge_at_innermost = false;
  double gauge_height = 14e-3;             ///< below the top of the rail [m]
  double gauge_width = 1.435;              ///< [m]
  double rail_y0 = 0.0, rail_z0 = 0.0;     ///< [m]
  double cant = 0.0;                       ///< rail inclination, positive = head turned towards the track centre [rad]
  double curvature = 0.0;                  ///< of the track [1/m]
  double dy = 0.0, dz = 0.0, roll = 0.0;   ///< rail irregularity [m], [rad]
  double vy = 0.0, vz = 0.0, vroll = 0.0;  ///< and its rates [m/s], [rad/s]
  friend bool operator==(const Track&, const Track&) = default;
};

/// A roller in place of the rail. Geometry::rail is then a surface of revolution about the y axis direction, placed
/// like a rail's profile: its z = 0 lies at the nominal radius, its axle nominal_radius below. Cant does not apply, s
/// along the track neither: position.x is where the wheelset's axle stands over the roller's.
struct Roller {
  double nominal_radius = 0.0;  ///< [m]; negative: the wheel runs inside a ring
  double pitch_rate = 0.0;      ///< [rad/s], of a shift [rad]; positive where a wheel on top of it rolls forward,
                                ///< negative for a ring
  friend bool operator==(const Roller&, const Roller&) = default;
};

/// Springs under a rail without mass: the rail moves until k_y dy = F_y + force_y and k_z dz = F_z + force_z, F the
/// contact force on the rail in track axes.
struct RailSprings {
  double stiffness_y = 1e6, stiffness_z = 1e6;  ///< [N/m]; stiffness_z = 0: no vertical deflection
  double force_y = 0.0, force_z = 0.0;          ///< further forces on the rail [N]
  double first_step_y = 1e-3;                   ///< length of the first lateral step where nothing better is known [m]
  friend bool operator==(const RailSprings&, const RailSprings&) = default;
};

/// Force against the change of contact force in time: F_damp = c dF/dt, its rate limited.
struct Damping {
  double normal = 0.0, tangential = 0.0;                    ///< c_n, c_t [s]
  double max_rate_normal = 0.0, max_rate_tangential = 0.0;  ///< [N/s]
  friend bool operator==(const Damping&, const Damping&) = default;
};

/// How the wheels of a wheelset are placed on its axle.
struct WheelsetDimensions {
  double flange_back_distance = 1.360;   ///< [m]
  double flange_back_position = -0.070;  ///< in wheel profile coordinates [m]
  double nominal_radius = 0.460;         ///< [m]
  std::optional<double> tape_line;       ///< y of the tape line in wheel profile coordinates [m]
  friend bool operator==(const WheelsetDimensions&, const WheelsetDimensions&) = default;
};

/// Six positions or six rates in the order of the field: longitudinal, lateral, vertical, roll, yaw, pitch.
struct SixMotion {
  double x = 0.0, y = 0.0, z = 0.0, roll = 0.0, yaw = 0.0, pitch = 0.0;  ///< [m], [rad], or per second
  friend bool operator==(const SixMotion&, const SixMotion&) = default;
};

/// Where a wheelset is, in track axes, and how it moves.
struct WheelsetState {
  SixMotion position;        ///< x = s along the track; z = 0: nominal circle touches the track plane [m], [rad]
  SixMotion velocity;        ///< [m/s], [rad/s]; rolling forward has a negative pitch rate
  SixMotion wheel_offset;    ///< deviation of this wheel of a flexible wheelset
  SixMotion wheel_velocity;  ///< and its rates
  friend bool operator==(const WheelsetState&, const WheelsetState&) = default;
};

/// Where elements lie, and how the bodies' rigid slip is found.
enum class ReferenceSurface {
  plane,               ///< tangent plane, creepages at the contact reference
  plane_surface_slip,  ///< tangent plane, rigid slip of the surfaces at every element
  curved,              ///< conformal contact: a surface between both bodies, curved across the rail
};

/// How contact is looked for.
enum class SearchMethod {
  automatic,    ///< with refine the locus where profiles are constant, beside defects; else pruned grid
  pruned_grid,  ///< heights only where conservative bounds do not rule contact out
  full_grid,    ///< heights on the whole grid: the oracle of the others
  locus,        ///< constant profiles only: where the wheel's circles come closest to the rail
};

/// Size of elements, and the rules by which they make patches.
struct ElementGrid {
  double dx = 0.5e-3, ds = 0.5e-3;  ///< element sizes [m]
  /// Each patch gets a dx or ds of its own, chosen from its size; dx, ds are for patches that have to share a raster.
  bool choose_dx = false, choose_ds = false;
  double dq_relative = 1.0;                      ///< rolling step over dx
  double angle_separation = std::numbers::pi;    ///< A_SEP [rad]
  double separation = 8e-3, combination = 4e-3;  ///< D_SEP, D_COMB [m]
  std::optional<double> turning;                 ///< D_TURN [m]; default 2 D_SEP - D_COMB
  double near_miss = -1e-3;                      ///< G_MISS [m]
  int max_elements = 20000;                      ///< of a patch; elements grow where there would be more
  bool linear_weight = false;                    ///< weight of the penetration in the contact reference; false: squared
  friend bool operator==(const ElementGrid&, const ElementGrid&) = default;
};

/// Elements and how contact is looked for.
struct Discretisation : ElementGrid {
  bool reference_at_deepest = false;
  /// Size and fineness of the first search grid; refined, or one of Conventions::contact.
  enum class SearchGrid {
    refined,          ///< coarse grid over the whole window, fine grids on what it finds
    reference_mesh,   ///< one grid whose steps follow dx, ds
    reference_steep,  ///< the same with finer lateral steps for steep slopes
    reference_locus,  ///< a contact locus on rows whose step follows ds
  } search = SearchGrid::refined;
  SearchMethod search_method = SearchMethod::automatic;
  std::string detector;  ///< of detection/detector.hpp, in place of search_method; empty: that
  /// Rolling step over dx that most steps of transient rolling have: displacements of the instant before are then
  /// interpolated between three steps that differ by 0.2 % (their error is about 1e-8). 0: always evaluated.
  double usual_dq_relative = 0.0;
  friend bool operator==(const Discretisation&, const Discretisation&) = default;
};

}  // namespace treadmark
