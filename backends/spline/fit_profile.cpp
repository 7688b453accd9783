// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/fit_profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/profile_points.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

// Penalties below these interpolate: 1e-10 in mm^3 (unweighted) and mm^4 (weighted).
constexpr double kTinyPenaltyUnweighted = 1e-19;
constexpr double kTinyPenaltyWeighted = 1e-22;
constexpr double kKinkWeight = 100.0;       // corners hardly move
constexpr double kEndWeight = 20.0;         // nor do the ends in the weighted cubic method
constexpr double kLeastKnotSpacing = 1e-6;  // [m]

std::vector<double> interval_weights(const std::vector<double>& s, double end_factor) {
  const std::size_t n = s.size();
  std::vector<double> weights(n);
  weights[0] = end_factor * (s[1] - s[0]);
  weights[n - 1] = end_factor * (s[n - 1] - s[n - 2]);
  for (std::size_t i = 1; i + 1 < n; ++i) weights[i] = 0.5 * (s[i + 1] - s[i - 1]);
  return weights;
}

}  // namespace

ProfileSpline fit_profile(const Profile& profile) {
  using Method = SmoothingOptions::Method;
  const double strength = profile.smoothing.strength;
  if (!(strength >= 0.0) || !std::isfinite(strength))
    throw Error(ErrorKind::configuration,
                "the smoothing strength of profile '" + profile.name + "' must be 0 or positive");

  const std::vector<double> s = arc_length(profile);
  const std::vector<int> kinks = find_kinks(profile, s);
  const Method method = profile.smoothing.method;
  std::vector<double> weights(s.size(), 1.0);
  if (method == Method::weighted_spline) weights = interval_weights(s, kEndWeight);
  if (method == Method::weighted_bspline) weights = interval_weights(s, 1.0);
  for (std::size_t k = 1; k + 1 < kinks.size(); ++k) weights[static_cast<std::size_t>(kinks[k])] *= kKinkWeight;
  const ProfileData data{s, profile.y, profile.z, kinks, weights};

  // A filter of this penalty halves a sine whose wavelength is the strength.
  const double cutoff = strength / (2.0 * std::numbers::pi);
  switch (method) {
    case Method::spline:
      return fit_cubic_smoothing(data, strength <= kTinyPenaltyUnweighted ? 0.0 : strength);
    case Method::weighted_spline: {
      const double lambda = std::pow(cutoff, 4);
      return fit_cubic_smoothing(data, lambda <= kTinyPenaltyWeighted ? 0.0 : lambda);
    }
    case Method::weighted_bspline:
      return fit_bspline_smoothing(data, std::pow(cutoff, 6), std::max(kLeastKnotSpacing, 0.25 * strength));
  }
  throw Error(ErrorKind::configuration, "unknown smoothing method");
}

}  // namespace treadmark::spline
