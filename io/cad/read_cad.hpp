// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/profile.hpp"
#include "treadmark/model/shape/slices.hpp"
#include "treadmark/model/shape/spline_surface.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::io {

/// Whether the name ends like a file of CAD: .step .stp .iges .igs (any case).
bool is_cad_file(const std::filesystem::path& file);
/// The first two of these, which can be written.
bool is_step_file(const std::filesystem::path& file);

/// The running surface of a CAD file.
struct CadSurface {
  /// One section; or where it changes a spline, slices or triangles.
  std::variant<Profile, SliceSet, SplineSurface, TriangleMesh> shape;
  std::string note;  ///< for people: unit, faces, how it was taken
};

/// Reads what can be touched of the faces of a STEP or IGES file: the outermost points that lines from the contact side
/// meet, z of a rail over (x, y), the radius of a wheel over (angle, y), from the highest point sideways until the
/// surface turns away, ends, or lies 45 mm below. Axes are those of Treadmark: x forward, y to the right, z down; the
/// axle of a wheel is the y axis. Units are the file's. The shape is
/// - one profile with points every 0.25 mm, if all faces seen are surfaces of revolution about the axle or extruded
///   along the track;
/// - else the B-spline of the face, exactly, if one face is all that is seen and no edge leads through what is seen;
/// - else slices, at most 10 mm apart and closer where halving a step shows more than 0.1 um;
/// - triangles, where the sides move so that slices have no common width: of all faces no deeper than 45 mm.
/// asked_by: where the file was named. Errors: Error(input_data) for a file that OpenCASCADE cannot read, has no unit
/// of length or several, holds no face or too many, is larger than any wheel or rail, or has a hole where it can be
/// touched (named by the entity beside it); Error(configuration) where the part is left out.
CadSurface read_cad(const std::filesystem::path& file, Body body, double nominal_radius,
                    const SourcePosition& asked_by = {});

namespace cad {
class CadShape;
/// The same of a file that is open.
CadSurface running_surface(const CadShape& shape, Body body, double nominal_radius, const std::filesystem::path& file);
}  // namespace cad

/// A surface for write_cad.
struct CadContent {
  Body body = Body::rail;
  SplineSurface spline;  ///< no hierarchy
  /// The curve of the coefficients of least u, the first parameter, in the plane x = 0 and without weights, extruded or
  /// revolved between two places [m] or [rad].
  std::optional<std::pair<double, double>> swept;
  std::string description;  ///< for the head of the file
};

/// Writes a face of these very coefficients as STEP (AP214, mm). The file appears only when complete. Errors:
/// Error(configuration) for a name that does not end in .step or .stp, or a file that cannot be written.
void write_cad(const std::filesystem::path& file, const CadContent& content);

}  // namespace treadmark::io
