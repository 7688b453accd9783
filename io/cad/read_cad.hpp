// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/model/profile.hpp"
#include "treadmark/model/slices.hpp"

namespace treadmark::io {

/// Whether the name ends like a file of CAD: .step .stp .iges .igs (any case).
bool is_cad_file(const std::filesystem::path& file);
/// The first two of these, which can be written.
bool is_step_file(const std::filesystem::path& file);

/// The running surface of a CAD file.
struct CadSections {
  std::variant<Profile, SliceSet> shape;  ///< one section, or slices where it changes
  std::string note;                       ///< for people: unit, faces, how it was sampled
};

/// Reads what can be touched of the faces of a STEP or IGES file: the outermost points that lines from the contact side
/// meet, z of a rail over (x, y), the radius of a wheel over (angle, y), from the highest point sideways until the
/// surface turns away, ends, or lies 45 mm below. Axes are those of Treadmark: x forward, y to the right, z down; the
/// axle of a wheel is the y axis. Units are the file's. If all faces seen are surfaces of revolution about the axle or
/// extruded along the track, the shape is one profile with points every 0.25 mm; else slices, at most 10 mm apart and
/// closer where halving a step shows more than 0.1 um. asked_by: where the file was named. Errors: Error(input_data)
/// for a file that OpenCASCADE cannot read, has no unit of length or several, holds no face or too many, has a hole
/// where it can be touched (named by the entity beside it), or sides that move; Error(configuration) where the part is
/// left out.
CadSections read_cad(const std::filesystem::path& file, Body body, double nominal_radius,
                     const SourcePosition& asked_by = {});

/// Points of a surface for write_cad.
struct CadPoints {
  Body body = Body::rail;
  /// One section (y, z; of a wheel y, radius) between two stations [m] or [rad]; else empty.
  std::vector<double> y, h;
  double from = 0.0, to = 0.0;
  /// A grid instead: row by row along the section, of so many stations.
  std::vector<Vec3> grid;
  int stations = 0;
};

/// Writes a face of a B-spline through the points, extruded or revolved where it is one section, as STEP (AP214, mm).
/// The file appears only when complete. Errors: Error(configuration) for a name that does not end in .step or .stp, or
/// a file that cannot be written.
void write_cad(const std::filesystem::path& file, const CadPoints& points);

}  // namespace treadmark::io
