// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "treadmark/scans/placement/rough_axis.hpp"

namespace treadmark::scans {

/// Axis of a wheel scanned all round, from circles alone: for scans whose lines are so far apart that no planes can be
/// laid through neighbouring points. Begins with the direction in which the points reach least and fits circles to
/// strips across it. elements: for centre and extent. Nothing if the points do not look like that. residual: median
/// scatter of the radii in a strip.
std::optional<RoughAxis> circle_axis(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                     const SurfaceElements& elements);

/// How far radii scatter in narrow strips across an axis: median over the strips of their robust deviations. For
/// comparing axes.
double radius_scatter(std::span<const Vec3> points, const Axis& axis, double extent);

}  // namespace treadmark::scans
