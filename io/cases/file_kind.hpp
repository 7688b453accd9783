// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

namespace treadmark::io {

/// Whether a .toml file has a table [simulation], or [evolve], and is no study; whether it has a table [study].
/// False for other kinds of files, which are not opened. Throws Error(configuration) for TOML that cannot be read.
bool is_simulation_file(const std::filesystem::path& file);
bool is_study_file(const std::filesystem::path& file);
bool is_evolution_file(const std::filesystem::path& file);
/// [vehicle]; [track] with a name, which the track of a case has not; any table of the settings of an import.
bool is_vehicle_file(const std::filesystem::path& file);
bool is_track_file(const std::filesystem::path& file);
bool is_import_file(const std::filesystem::path& file);

}  // namespace treadmark::io
