// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/analysis/geometry/contact_functions.hpp"

namespace treadmark::geometry {

/// A wheel and a rail of one side, each given as for the right-hand side.
struct SideBodies {
  std::shared_ptr<const Section> wheel;  ///< z is the radius
  double radius = 0.0;                   ///< of the wheel at its tape line [m]
  std::shared_ptr<const Section> rail;   ///< turned to the track's axes by cant
  double cant = 0.0;                     ///< of the rail [rad]
};

/// Where wheels and rails are. Tops of both rails lie in one plane.
struct PairPlacement {
  double wheel_origins = 1.5;   ///< distance of the wheels' origins (tape lines) [m]
  std::optional<double> gauge;  ///< distance of the rails' innermost points down to the gauge height [m]
  double rail_origins = 1.5;    ///< without a gauge: distance of the rails' origins [m]
  double gauge_height = 14e-3;  ///< below the top of each rail [m]

  friend bool operator==(const PairPlacement&, const PairPlacement&) = default;
};

/// What is asked for.
struct AnalysisSettings {
  Roll roll = Roll::none;
  double yaw = 0.0;                        ///< [rad]
  double step = 0.1e-3;                    ///< of the shift [m]
  std::vector<double> amplitudes;          ///< of the conicity, > 0, increasing [m]
  std::optional<double> wanted_amplitude;  ///< of the single value, in place of the rule's [m]
  double second = 0.05e-3;                 ///< gap up to which further contacts are listed; 0: none [m]
  bool harmonic = true;                    ///< harmonic linearization too
  double farthest = 10e-3;                 ///< shifts at least looked at [m]; more where the amplitudes need them
};

/// What the contact points cover of the profiles while the wheelset moves with an amplitude; jumps cover nothing.
struct ContactSpread {
  double amplitude = 0.0;        ///< [m]
  double rail = 0.0, wheel = 0;  ///< of both sides the mean [m]
};

/// What the difference of radii is worth in a curve.
struct Steering {
  double largest_difference = 0.0;  ///< of radii before the flange touches, of both sides the less [m]
  double smallest_radius = 0.0;     ///< of a curve in which that makes the wheels roll without slip [m]
};
inline constexpr double kFlangeAngle = 0.5235987755982988;  ///< from 30 degrees on it is the flange that touches [rad]

/// The geometry of a wheelset on a track in numbers. NaN: not known, see the reasons.
struct Analysis {
  double gauge = 0.0;                          ///< NaN: a rail does not reach down to the gauge height [m]
  double rail_y_right = 0.0, rail_y_left = 0;  ///< of the rails' origins, outwards from the middle of the track [m]
  double active_faces = 0.0;                   ///< distance of the flanges' faces 10 mm below the tape lines [m]
  double wheel_origins = 0.0;                  ///< [m]
  double radius_right = 0.0, radius_left = 0;  ///< at the tape lines [m]
  double flange_thickness_right = 0.0, flange_thickness_left = 0.0;  ///< of backs 70 mm from the tape lines [m]
  ContactFunctions functions;
  RadiusDifference difference;
  std::optional<double> equilibrium;  ///< shift with equal radii [m]
  std::string no_equilibrium;         ///< why there is none
  std::vector<Conicity> conicity;     ///< at the amplitudes asked for
  std::vector<double> harmonic;       ///< the same by harmonic linearization; empty: not asked for
  Conicity single;                    ///< at the amplitude of the rule
  std::string rule;                   ///< by which that amplitude was chosen, in words
  Conicity at_3mm;
  double nonlinearity = 0.0;        ///< (tan gamma(4 mm) - tan gamma(2 mm)) / 2 mm [1/m]
  double greatest_amplitude = 0.0;  ///< [m]
  ContactSpread spread;             ///< at 3 mm
  Steering steering;
  /// Force at rail level that holds the wheelset 3 mm beside its equilibrium, over its weight and the shift: mean of
  /// both directions [1/m].
  double gravitational_stiffness = 0.0;
};

/// A wheelset on a track ready for questions. Errors: Error(configuration) for a gauge that the rails do not reach.
WheelsetOnTrack place(const SideBodies& right, const SideBodies& left, const PairPlacement& placement, Roll roll,
                      double yaw = 0.0);

/// All of it. Errors: those of place and contact_functions; Error(configuration) for amplitudes that are not positive
/// or all beyond the flanges. An amplitude that has no conicity says why. Thread-safe; parallel runs share nothing.
Analysis analyse(const SideBodies& right, const SideBodies& left, const PairPlacement& placement,
                 const AnalysisSettings& settings);

}  // namespace treadmark::geometry
