// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <utility>

#include "treadmark/backends/create.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// Reads the geometry of a wheel or rail, whatever its kind (profile, slices, triangles, offsets, a shape given in the
/// case), and builds the surface in its natural representation, with its defects. Several parts become one body. radius
/// [m]: nominal radius of a wheel; of a roller in place of a rail (SurfaceSpec::roller_radius), 0 = it is a rail.
/// Errors of the readers and backends; Error(configuration) for keys of the shape that do nothing on its kind, for
/// defects on a file of offsets or on a body of parts, and for a roller from a file of offsets.
NaturalSurface read_surface(const io::SurfaceSource& source, Body body, double radius);

/// The motion of a section that a crossing asks for.
MovingSection motion_of(const io::CrossingInput& crossing);

/// From the first to the last section of a surface given by slices, beyond which it only goes on as it ends: x of a
/// rail [m], theta of a wheel [rad]. Nothing for other surfaces, for slices all round a wheel, and for sections that a
/// key moves along the track, which go on by design.
std::optional<std::pair<double, double>> measured_range(const NaturalSurface& surface, const io::SurfaceSource& source);

/// Whether the shape of a wheel lies about its axle as it is (triangles, splines, CAD, bodies, offsets), so that it has
/// a radius of its own; sections lie at whatever nominal radius their wheel has.
bool has_own_radius(const io::SurfaceSource& wheel);

/// Whether the name ends like a file of offsets: .vdb .nvdb.
bool is_offset_file(const std::filesystem::path& file);

}  // namespace treadmark::app
