// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

namespace treadmark::io {

/// Whether a .toml file has a table [simulation] and is no study; whether it has a table [study].
/// False for other kinds of files, which are not opened. Throws Error(configuration) for TOML that cannot be read.
bool is_simulation_file(const std::filesystem::path& file);
bool is_study_file(const std::filesystem::path& file);
/// Whether it has a table [evolve]; as above.
bool is_evolution_file(const std::filesystem::path& file);

}  // namespace treadmark::io
