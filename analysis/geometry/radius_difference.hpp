// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "treadmark/core/line.hpp"

namespace treadmark::geometry {

/// Difference of the rolling radii (right minus left) over the shift of the wheelset to the right, linear between its
/// points. A jump is two points within 1e-7 m.
struct RadiusDifference {
  std::vector<double> y;   ///< strictly increasing [m]
  std::vector<double> dr;  ///< [m]
};

/// Equivalent conicity at one amplitude.
struct Conicity {
  double amplitude = 0.0;  ///< half the distance of the turning points [m]
  /// Tangent of the angle of the cone with the same wavelength; NaN where there is none.
  double tan_gamma = std::numeric_limits<double>::quiet_NaN();
  double low = 0.0, high = 0.0;  ///< turning points [m]
  std::string reason;            ///< why there is none; else empty
};

/// Motion of a wheelset by its kinematics alone (Klingel 1883; integral method of EN 15302): y'' + dr(y) / (e r0) = 0,
/// whose wavelength at an amplitude is that of a cone. All of it is exact for a difference of radii that is linear
/// between its points. Immutable, safe to use from any number of threads.
class KinematicMotion {
 public:
  /// Errors: Error(configuration) for less than two points, sizes that differ, y not increasing, numbers not finite.
  explicit KinematicMotion(RadiusDifference difference);

  const RadiusDifference& difference() const { return d_; }

  /// The shift with dr = 0 that is passed upwards and nearest to 0 [m]; nothing where there is none. On a flat stretch
  /// the place nearest to 0.
  std::optional<double> equilibrium() const { return equilibrium_; }
  /// Why there is no equilibrium; empty where there is one.
  const std::string& no_equilibrium() const { return no_equilibrium_; }

  /// (pi / I)^2 with I the integral of 1 / sqrt(S(y2) - S(y)) between the turning points, S that of dr; 0 where dr is 0
  /// all the way. amplitude > 0 [m].
  Conicity conicity(double amplitude) const;
  /// The greatest amplitude that the points allow [m]; 0 without an equilibrium.
  double greatest_amplitude() const;
  /// The same amplitude by harmonic linearization (describing function), the middle shifted so that no mean is left.
  /// NaN where it leaves the points.
  double harmonic_conicity(double amplitude) const;

  /// dr at a shift [m], NaN outside of the points.
  double at(double y) const;

 private:
  double potential(double y) const;
  double turning_point(double energy, bool right) const;
  double passage(std::size_t i, double h, double root_from, double root_to) const;
  BrokenLine line() const { return {d_.y, d_.dr}; }

  RadiusDifference d_;
  std::vector<double> s_;      ///< S at the points, 0 at the first
  std::vector<double> crest_;  ///< greatest S between the reference and the point
  std::optional<double> equilibrium_;
  double reference_ = 0.0;  ///< shift that motion goes round: the equilibrium, or the crest between two [m]
  double lowest_energy_ = 0.0, highest_energy_ = 0.0;  ///< of motion round it
  bool between_two_ = false;                           ///< the reference is a crest
  std::string no_equilibrium_;
};

/// Wavelength of the motion of a wheelset [m]: contact points e apart, radius r0 [m] (Klingel 1883); infinite for 0.
double wavelength(double tan_gamma, double contact_distance, double radius);

}  // namespace treadmark::geometry
