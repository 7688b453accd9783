// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "treadmark/app/surfaces/profile_check.hpp"

namespace treadmark::app {

/// Whether the name is that of triangles, slices, CAD, splines, offsets or points of a scanner.
bool is_surface_file(const std::filesystem::path& file);

/// Reads such a file and says what was understood of it: kind, unit, body, extent, which side is up, numbers of points
/// or triangles. Without a body that of the file, else the one that its place speaks for. Errors: those of the readers.
CheckedProfile check_surface(const std::filesystem::path& file, std::optional<Body> body);

/// The same for every such file that the cases of a file use, each once, with the keys of its shape. Errors as
/// read_surface.
std::vector<CheckedProfile> check_surfaces(const io::CaseFile& file);

/// Points of a scanner, without importing them: format, unit, number, extent. Errors: those of the reader;
/// Error(configuration) in a build without scans.
CheckedProfile check_cloud(const std::filesystem::path& file);
/// Whether the name is that of points of a scanner and of nothing else; false in a build without scans.
bool is_cloud_file(const std::filesystem::path& file);

}  // namespace treadmark::app
