// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/shape/triangle_mesh.hpp"

namespace treadmark::io {

/// One patch as VTK XML structured grid (.vts): every element a cell at its place in track axes [m] (contact axes for a
/// basic case), the fields as cell data named with their SI units. Thread-safe.
/// Errors: Error(configuration) for fields that do not match their grid.
std::string patch_to_vts(const PatchResult& patch, int case_number, int patch_number);

/// Writes to the folder: STEM_case0001_patch1.vts for every patch, STEM_case0001_patch1_block1.vts for every block of
/// points below its surface, and STEM.pvd, the collection over the cases, which opens in ParaView. Its times are those
/// given, one a case, without them the numbers of the cases.
/// Returns the paths written, the collection last. Errors: as above, and Error(configuration) when a file
/// cannot be written.
std::vector<std::filesystem::path> write_vtk(const std::filesystem::path& folder, const RunResult& run,
                                             const std::string& stem = "result", std::span<const double> times = {});

/// A sampled surface at a pose as VTK XML polygons (.vtp): points in track axes [m] in single
/// precision, quadrilaterals whose corners are all there, and the deviation from the body's mean section as point data.
/// Thread-safe.
std::string surface_to_vtp(const SampledSurface& surface, const Pose& X_TB);

/// Triangles as VTK XML polygons (.vtp), points in metres like all files for ParaView. Thread-safe.
std::string triangles_to_vtp(const TriangleMesh& mesh);

/// Writes the wheel and rail of every case where they are: STEM_wheel_1_0001.vtp and so on, one file a place where the
/// body stands, and STEM.pvd over the same times as write_vtk. Returns the paths written, the collection last; none
/// where the run has no sampled surfaces. Errors: Error(configuration) when a file cannot be written.
std::vector<std::filesystem::path> write_vtk_bodies(const std::filesystem::path& folder, const RunResult& run,
                                                    const std::string& stem = "bodies",
                                                    std::span<const double> times = {});

}  // namespace treadmark::io
