// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace treadmark {

/// Which of the two bodies.
enum class Body { rail, wheel };

/// How profile points are turned into a smooth curve (behaviour of the smoothing methods: Reinsch 1967, de Boor 1978).
struct SmoothingOptions {
  /// What is minimised.
  enum class Method {
    spline = 0,            ///< unweighted cubic smoothing spline, strength = lambda [m^3]
    weighted_spline = 1,   ///< weighted cubic smoothing spline, strength = cut-off wavelength [m]
    weighted_bspline = 2,  ///< weighted least-squares B-spline with f''' penalty, strength = cut-off wavelength [m]
    by_noise = 3,  ///< of what is read: as much as the noise asks for (analysis/measured/smoothing.hpp), no strength
  };
  Method method = Method::spline;
  double strength = 0.0;                  ///< 0 = interpolate; unit by method, see above
  double kink_high = 0.5235987755982988;  ///< turning angle above which a point may be a kink [rad]
  double kink_low = 0.10471975511965977;  ///< turning angle below which its neighbours must stay [rad]
  double kink_width = 2e-3;               ///< arc length on both sides in which neighbours are looked at [m]
};

struct ProfileScatter;

/// A cleaned lateral cross-section in profile coordinates: y to the right [m], z down [m].
/// Rail points run with increasing y, wheel points with decreasing y (flange at negative y with positive z).
struct Profile {
  Body body = Body::rail;
  std::vector<double> y, z;  ///< [m], same size >= 2
  std::string name;          ///< where it comes from, for messages
  SmoothingOptions smoothing;
  std::shared_ptr<const ProfileScatter> scatter;  ///< of measured points (profile_scatter.hpp); may be missing
};

}  // namespace treadmark
