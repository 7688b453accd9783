// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/backends/spline/slices/slice_net.hpp"
#include "treadmark/model/shape/slices.hpp"

namespace treadmark::spline {

/// Coefficients of the cubic spline through values at successive positions, on the knots extended_knots(positions):
/// interpolating with not-a-knot conditions at the second and last but one position, or approximating, where the values
/// are coefficients themselves and the outer two are extrapolated linearly (de Boor 1978). Two more than values.
/// Needs at least 4 positions.
std::vector<double> line_coefficients(std::span<const double> positions, std::span<const double> values,
                                      bool approximate);

/// Samples the smoothed slices at v positions about 0.5 mm apart (equally many between two features in every slice) and
/// fits the tensor spline: interpolating in v, interpolating or approximating in u. Missing parts stay missing.
/// Outside the slices the surface goes on with the value at the first or last one; a wheel whose slices go all round is
/// closed over the gap between the last and the first slice as if slices went on for ever, unless slices.open_seam says
/// otherwise; a last slice that is the first one again, a turn later, is left out. Kinks are not looked at: see
/// split_at_kinks. Errors: Error(input_data) for fewer than 4 slices (also for a part that fewer than 4 successive
/// slices have), slices that do not increase, or features that do not fit; and the errors of fit_profile.
SliceNet fit_slices(const SliceSet& slices);

/// Points of one slice at the positions first .. first + points.size() - 1 (counted from 0); the others are missing.
struct SampledSlice {
  int first = 0;
  std::vector<NetPair> points;
};

struct SampledSlices {
  int positions = 0;
  std::vector<SampledSlice> slices;
};

/// See fit_slices.
SampledSlices sample_slices(const SliceSet& slices);

/// The net of points joined by straight lines across, cubic along: one row of equally many points a station, NaN where
/// there is none; of stations only what lies along counts. Errors: those of fit_slices.
SliceNet join_straight(const SliceSet& stations, const std::vector<std::vector<NetPair>>& points);

}  // namespace treadmark::spline
