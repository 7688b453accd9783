// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "treadmark/scans/placement/rough_axis.hpp"

namespace treadmark::scans {

/// Axis of a wheel, or of a part of one, from circles alone, for scans in which no planes can be laid through
/// neighbouring points or whose normals hardly turn: strips across a direction hold arcs about one centre, which is a
/// linear problem (Kasa 1976), so that only directions are searched for. elements: for centre and extent. Nothing if
/// the points do not look like that. residual: scatter of the radii in the strips. Deterministic.
std::optional<RoughAxis> circle_axis(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                     const SurfaceElements& elements);

/// How far radii scatter about an axis in narrow strips across it, in each of which they may grow evenly: median over
/// the strips of their robust deviations; extent if too few points lie in any. For comparing axes.
double radius_scatter(std::span<const Vec3> points, const Axis& axis, double extent);

}  // namespace treadmark::scans
