// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::spline {

/// Fits the curve that profile.smoothing asks for. Arc length and corners come from the given points; smoothing moves
/// the curve but not the parameter. Sections between corners are joined in value only, with natural ends.
/// Errors: Error(input_data) for unusable points, Error(configuration) for a negative or non-finite strength.
ProfileSpline fit_profile(const Profile& profile);

/// The data of one smoothing problem: points (s, y, z), corners (indices, first and last included), weights.
struct ProfileData {
  std::span<const double> s, y, z;
  std::span<const int> kinks;
  std::span<const double> weights;
};

/// Minimiser of sum w (y - f)^2 + lambda * integral f''^2, for y and z each (Reinsch 1967); breaks = data positions.
/// Corner points are shared by both of their sections. lambda = 0 interpolates.
ProfileSpline fit_cubic_smoothing(const ProfileData& data, double lambda);

/// Minimiser of sum w (y - f)^2 + lambda * integral f'''^2 over cubic B-splines with about the given knot spacing [m]
/// (Eilers and Marx 1996 with the exact integral); corners are triple knots.
/// lambda below kTinyBsplinePenalty: knots at data positions, without the second and last but one of each section.
ProfileSpline fit_bspline_smoothing(const ProfileData& data, double lambda, double knot_spacing);

/// [m^6], see fit_bspline_smoothing.
inline constexpr double kTinyBsplinePenalty = 1e-42;

/// Chord length along the points [m], shifted so that s = 0 where y = 0 if y is strictly monotonic (by linear
/// interpolation; the nearest point if 0 lies outside its range), else at the point nearest to (0, 0).
/// Errors: Error(input_data) for fewer than two points, sizes that differ, non-finite or coinciding neighbours.
std::vector<double> arc_length(const Profile& profile);

/// Indices of the points where the curve has a corner, always with the first and last point. A corner turns by more
/// than kink_high while all other points within kink_width along the curve turn by at most kink_low; a single point
/// between two corners counts as one too.
std::vector<int> find_kinks(const Profile& profile, const std::vector<double>& s);

}  // namespace treadmark::spline
