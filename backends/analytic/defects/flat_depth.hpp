// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/analytic/defects/offset_functions.hpp"
#include "treadmark/backends/analytic/wheels/wheel_lanes.hpp"
#include "treadmark/model/shape/surface_spec.hpp"

namespace treadmark::analytic {

/// Radial depth D(theta, y) >= 0 [m] and its derivatives.
struct DepthJet {
  double d = 0.0;
  double d_theta = 0.0, d_y = 0.0;
  double d_theta_theta = 0.0, d_theta_y = 0.0, d_y_y = 0.0;
};

/// The angle from the middle of a flat to its end [rad].
double half_angle_of(const WheelFlat& flat, double nominal_radius);

/// The depths of all flats of one wheel, added up and taken off the radius: r = R + z(y) - D(theta, y).
/// Fresh: D = R - (R - d0)/cos(phi) at the nominal radius R, a chord of length L with d0 = R - sqrt(R^2 - (L/2)^2).
/// With edges of radius e, H that depth: D = (H + w)^2/(4 w) for |H| < w, where w = s^2/(2 (1/e - 1/R)) and s is the
/// slope of H along the circumference at the ends of the chord. Rounded: D = d/2 (1 + cos(2 pi R phi/L)). Both times
/// the lateral fading; phi = theta - theta_center.
class FlatDepth {
 public:
  FlatDepth() = default;
  /// Errors: Error(configuration) as check_defects.
  FlatDepth(const std::vector<WheelFlat>& flats, double nominal_radius);

  bool empty() const { return flats_.empty(); }
  /// Depth at the direction (sin theta, cos theta) = (x, z)/r.
  double depth(double x, double y, double z, double r, double& d_theta, double& d_y) const;
  DepthJet jet(double theta, double y) const;

  double max_depth() const { return max_depth_; }
  double max_d_theta() const { return max_d_theta_; }  ///< Lipschitz constants of D
  double max_d_y() const { return max_d_y_; }
  /// Angle ranges of the flats: whether any of them comes within half_range of theta.
  bool touches(double theta, double half_range) const;
  /// Range of D and Lipschitz constants over angles within half_range of theta and y in [y_min, y_max]. Conservative.
  struct Range {
    double low = 0.0, high = 0.0, max_d_theta = 0.0, max_d_y = 0.0;
  };
  Range range(double theta, double half_range, double y_min, double y_max) const;
  /// The same for D alone, faster; theta within +-3 pi.
  void depths(double theta, double half_range, double y_min, double y_max, double& low, double& high) const;
  /// For the kernels; nothing if some flat is too wide for them or has rounded edges.
  std::vector<FlatLanes> lanes() const;
  std::size_t memory_bytes() const { return flats_.capacity() * sizeof(Flat); }

 private:
  struct Flat {
    WheelFlat::Shape shape;
    double sin_center, cos_center, center, half_angle, cos_half_angle;
    double radius, depth, chord_radius, wave_number, steepest;
    double rounding;  ///< w of a fresh flat
    double y_center, half_width, y_wave_number;
    void along(double phi, double& d, double& d1, double& d2) const;
    void across(double y, double& w, double& w1, double& w2) const;
    FunctionRange along_range(double near, double far) const;
  };
  std::vector<Flat> flats_;
  double max_depth_ = 0.0, max_d_theta_ = 0.0, max_d_y_ = 0.0;
};

}  // namespace treadmark::analytic
