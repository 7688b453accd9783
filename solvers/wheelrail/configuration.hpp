// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>

#include "treadmark/core/friction.hpp"
#include "treadmark/core/material.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/detection/contact_search.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"

namespace treadmark::wheelrail {

/// One wheel on one rail: what is given, in SI units. A left-hand pair is described with its own true signs
/// (y to the right); profiles are always given as for the right-hand side.

enum class Side { left, right };

/// Where the rail lies on the track and how it moves.
struct Track {
  bool gauge_based = true;              ///< else rail_y0, rail_z0 place the rail's profile origin
  double gauge_height = 14e-3;          ///< below the top of the rail [m]
  double gauge_width = 1.435;           ///< [m]
  double rail_y0 = 0.0, rail_z0 = 0.0;  ///< [m]
  double cant = 0.0;                    ///< rail inclination, positive = head turned towards the track centre [rad]
  double curvature = 0.0;               ///< of the track [1/m]
  double dy = 0.0, dz = 0.0, roll = 0.0;   ///< rail irregularity [m], [rad]
  double vy = 0.0, vz = 0.0, vroll = 0.0;  ///< and its rates [m/s], [rad/s]
};

struct WheelsetDimensions {
  double flange_back_distance = 1.360;   ///< [m]
  double flange_back_position = -0.070;  ///< in wheel profile coordinates [m]
  double nominal_radius = 0.460;         ///< [m]
  std::optional<double> tape_line;       ///< y of the tape line in wheel profile coordinates [m]
};

/// Six positions or six rates in the order of the field: longitudinal, lateral, vertical, roll, yaw, pitch.
struct SixMotion {
  double x = 0.0, y = 0.0, z = 0.0, roll = 0.0, yaw = 0.0, pitch = 0.0;
};

struct WheelsetState {
  SixMotion position;        ///< x = s along the track; z = 0: nominal circle touches the track plane [m], [rad]
  SixMotion velocity;        ///< [m/s], [rad/s]; rolling forward has a negative pitch rate
  SixMotion wheel_offset;    ///< deviation of this wheel of a flexible wheelset
  SixMotion wheel_velocity;  ///< and its rates
};

/// The two bodies.
struct Geometry {
  std::shared_ptr<const Surface> rail, wheel;
  bool constant_profiles = true;  ///< prismatic rail and round wheel
};

/// Grid and patch rules.
struct Discretisation {
  double dx = 0.5e-3, ds = 0.5e-3;   ///< element sizes [m]
  double dq_relative = 1.0;          ///< rolling step over dx
  double angle_separation = 3.141592653589793;  ///< A_SEP [rad]
  double separation = 8e-3, combination = 4e-3; ///< D_SEP, D_COMB [m]
  std::optional<double> turning;     ///< D_TURN [m]; default 2 D_SEP - D_COMB
  double near_miss = -1e-3;          ///< G_MISS [m]
  int max_elements = 20000;
  bool linear_weight = false;
  bool reference_at_deepest = false;
  /// Size and fineness of the first search grid.
  enum class SearchGrid {
    refined,          ///< coarse grid over the whole window, fine grids on what it finds
    reference_mesh,   ///< one grid whose steps follow dx, ds as in the reference program (CONTACT)
    reference_steep,  ///< the same with its finer lateral steps for steep slopes
  } search = SearchGrid::refined;
  detection::SearchMethod search_method = detection::SearchMethod::automatic;
};

struct Problem {
  Side side = Side::right;
  Track track;
  WheelsetDimensions wheelset;
  WheelsetState state;
  /// Vertical force on the rail [N], track axes: state.position.z is then sought. Otherwise z is prescribed.
  std::optional<double> vertical_force;
  kalker::Regime regime = kalker::Regime::steady;  ///< frictionless or steady
  Discretisation discretisation;
  Material material;
  FrictionLaw friction;
  kalker::SolverSettings solver;
  int max_force_iterations = 30;
  kalker::NormalModel normal_model = kalker::NormalModel::full;            ///< full, kpec or analyn
  kalker::TangentialModel tangential_model = kalker::TangentialModel::full;
  kalker::FastsimSettings fastsim;
  kalker::InfluenceSettings influence;   ///< constant or bilinear
  /// Friction at inclinations of the rail's surface [rad], increasing; between them every number of the law is interpolated, beyond them
  /// it stays. Empty: friction is the same everywhere.
  std::vector<double> friction_inclination;
  std::vector<FrictionLaw> friction_laws;
};

}  // namespace treadmark::wheelrail
