// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::scans {

/// Unit normals of planes fitted to the nearest points, each on the side of outward.
std::vector<Vec3> estimate_normals(std::span<const Vec3> points, std::span<const Vec3> outward);

/// Bilateral projection of points on the surface they sample (Huang et al. 2013): a neighbour counts by how near it is
/// and by how much its normal agrees, so that edges sharper than about sharpness_deg stay. `rounds` times. Heights are
/// measured along the mean of the two normals: a chord of a circle is perpendicular to it, so that curved surfaces do
/// not shrink, as they do along the neighbour's normal by (distance^2 / radius) / 2.
void smooth_points(std::vector<Vec3>& points, std::span<const Vec3> outward, double sharpness_deg, int rounds);

}  // namespace treadmark::scans
