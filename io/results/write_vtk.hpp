// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::io {

/// One patch as VTK XML structured grid (.vts): every element a cell at its place in track axes [m] (contact axes for a
/// basic case), the fields as cell data named with their SI units. Thread-safe.
/// Errors: Error(configuration) for fields that do not match their grid.
std::string patch_to_vts(const PatchResult& patch, int case_number, int patch_number);

/// Writes to the folder: STEM_case0001_patch1.vts for every patch, STEM_case0001_patch1_block1.vts for every block of
/// points below its surface, and STEM.pvd, the collection over the cases (case number = time), which opens in ParaView.
/// Returns the paths written, the collection last. Errors: as above, and Error(configuration) when a file
/// cannot be written.
std::vector<std::filesystem::path> write_vtk(const std::filesystem::path& folder, const RunResult& run,
                                             const std::string& stem = "result");

}  // namespace treadmark::io
