// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/profiles/raw_points.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io::profiles {

/// The steps of the clean-up, each on its own. None depends on the unit of length.

/// Removes points nearer than the distance to the last kept point.
void remove_near_points(RawPoints& points, double distance);

/// Where the polyline turns by more than the threshold [rad] at two successive points, both become their mean.
void remove_zigzags(RawPoints& points, double threshold);

/// Deletes points with y outside [min, max]; nothing unless min < max.
void delete_outside_y(RawPoints& points, double min, double max);

/// Moves z into [min, max]; nothing unless min < max.
void clip_z(RawPoints& points, double min, double max);

/// Whether z points up, judged by the shape: the sides of a rail, the ends of a wheel profile.
bool z_points_up(const RawPoints& points, Body body);

/// Whether the points stand in the wrong order: a rail must have increasing y at its highest point, a wheel decreasing
/// y at its lowest (z down); in a sharp corner the turning direction decides.
bool order_is_wrong(const RawPoints& points, Body body);

/// Whether two parts of the polyline cross. Returns the indices of the two crossing segments in first, second.
/// Throws Error(input_data) for a tangle that would take unreasonably long to check.
bool crosses_itself(const RawPoints& points, std::size_t& first, std::size_t& second);

/// Length of the polyline.
double total_length(const RawPoints& points);

}  // namespace treadmark::io::profiles
