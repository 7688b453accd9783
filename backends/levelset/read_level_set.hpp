// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/backends/offset/vdb_file.hpp"
#include "treadmark/model/shape/solid_shape.hpp"

namespace treadmark::levelset {

/// A level set of half, single or double precision numbers that any program wrote with OpenVDB. scale: metres of its
/// unit; grid: its name, empty: the only one. Its transform may move and turn it; its voxels are cubes. Errors:
/// Error(input_data) for a file that is missing, empty, damaged or no VDB file, that holds no level set, or several and
/// no name, no grid of that name, one of another class or type, without values, with numbers that are none, dense
/// inside (active tiles), mirrored, sheared, with voxels that are no cubes, or not between 1 um and 100 mm, saying
/// which.
DistanceGrid read_level_set(const std::filesystem::path& file, double scale, const std::string& grid = {});
/// Of a file that is open. name: for messages.
DistanceGrid read_level_set(offset::VdbFile vdb, const std::string& name, double scale, const std::string& grid = {});

}  // namespace treadmark::levelset
