// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "treadmark/model/shape/surface_doubts.hpp"
#include "treadmark/model/shape/surface_errors.hpp"

namespace treadmark::io {

/// What comments at the top of a file of slices or triangles say of the surface's errors (to_lines); null for files of
/// other kinds, those that cannot be read, and where nothing is said. Errors: Error(input_data) for damaged lines.
std::shared_ptr<const SurfaceErrors> read_surface_errors(const std::filesystem::path& file);

/// What these comments, or the head of a binary .stl, say that the import of the surface doubted; none where nothing is
/// said.
std::vector<SurfaceDoubt> read_surface_doubts(const std::filesystem::path& file);

}  // namespace treadmark::io
