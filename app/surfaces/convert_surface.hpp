// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

struct ConvertSettings {
  std::optional<Body> body;  ///< needed where the input does not tell: cases, triangles, two-column profiles
  double resolution = 0.0;   ///< [m]; 0 = default
  std::string backend;       ///< whose splines are written to a file of splines; "" = those that are given, else nurbs
  double nominal_radius = 0.0;  ///< of a wheel [m]; 0 = the case's, or that of an offset file
  double scale_to_mm = 1.0;     ///< of triangle and profile files
  /// Part that is written: along the track [m], round the wheel [rad]. The other body's range is an error.
  std::optional<std::pair<double, double>> range_x, range_theta;
  std::vector<std::string> overrides;  ///< of a case
  io::OffsetsInput offsets;            ///< a table of deviations that is added
  /// How far the file, read again, may lie from the input [m]; 0: kWrittenTolerance, of samples whose resolution is
  /// given sampled_tolerance() of it.
  double tolerance = 0.0;
};

/// What is meant by settings.tolerance.
double tolerance_of(const ConvertSettings& settings);

struct Converted {
  NaturalSurface source;
  Body body = Body::rail;
  RepresentedSurface written;  ///< what the file holds, as it would be read back
  SurfaceDifference fit;
  std::string kind;  ///< "triangles", "slices", "offsets", "CAD", "splines"
};

/// Reads any geometry (profile, slices, triangles, offsets, or the wheel or rail of the first case of a case file) and
/// writes it as triangles (.ply .stl .obj .off), slices (.slcs .slcw), offsets over the undamaged section (.vdb .nvdb),
/// CAD (.step) or splines (.xml). Offsets become offsets of another file voxel by voxel unless a resolution or a part
/// of them is asked for.
/// The file appears only where it was read again and lies near enough to the input. Errors: those of readers, backends,
/// writers and require_as_written; Error(configuration) if the body is not known or the extension means nothing.
Converted convert_surface(const std::filesystem::path& input, const std::filesystem::path& output,
                          const ConvertSettings& settings);

/// The same of a surface that is there already; what settings say of the input is not looked at.
Converted write_surface(const NaturalSurface& surface, const std::filesystem::path& output,
                        const ConvertSettings& settings);

}  // namespace treadmark::app
