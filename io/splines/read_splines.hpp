// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/spline_surface.hpp"

namespace treadmark::io {

/// Whether the name ends like a file of splines: .xml (any case), of G+Smo.
bool is_spline_file(const std::filesystem::path& file);

/// The surfaces of a file of splines.
struct SplineFile {
  std::vector<SplineSurface> surfaces;      ///< in the order of the MultiPatch, or of the file
  std::vector<SplineInterface> interfaces;  ///< sides that the file says meet
};

/// Reads G+Smo's XML: the patches of its MultiPatch if it has one, else all of its Geometry: TensorBSpline2,
/// TensorNurbs2 of degrees up to kHighestDegree, THBSpline2 and HBSpline2 of degrees up to kHighestHierarchicalDegree,
/// in three dimensions. Coordinates times scale_to_mm are millimetres, since the format has no unit. asked_by: where
/// the file was named. Errors: Error(input_data) with file:line:column and the id of the geometry; Error(configuration)
/// in a build without Expat, or for a scale that is not positive.
SplineFile read_splines(const std::filesystem::path& file, double scale_to_mm = 1.0,
                        const SourcePosition& asked_by = {});

/// The same from text in memory; file is only used for messages.
SplineFile parse_splines(std::string_view text, const std::string& file, double scale_to_mm = 1.0);

/// Writes such a file in mm, with 17 digits; several surfaces as a MultiPatch, with the sides that meet as interfaces
/// and all others as its boundary. Hierarchical ones whose levels do not
/// halve all intervals say the knots of every level (manualLevels). The file appears only when complete. Errors:
/// Error(configuration) for another extension, a file that cannot be written, no surface, levels of which one has more
/// than one new knot in an interval.
void write_splines(const std::filesystem::path& file, std::span<const SplineSurface> surfaces,
                   std::span<const SplineInterface> interfaces = {});

}  // namespace treadmark::io
