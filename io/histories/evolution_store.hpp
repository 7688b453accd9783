// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/histories/evolution_model.hpp"

namespace treadmark::io {

/// A generation by itself, exactly: what an evolution goes on from. Equal generations give equal bytes. Errors:
/// Error(configuration) for files that cannot be written; Error(input_data) for files that are no such files. Not to be
/// called from two threads at once, here and below.
void write_generation(const std::filesystem::path& path, const Generation& generation);
Generation read_generation(const std::filesystem::path& path);

/// All of them: /generation_0000 ..., copied from their files, and /table with the quantities of every generation.
void write_evolution_store(const std::filesystem::path& path, const EvolutionResult& result,
                           const std::vector<std::filesystem::path>& generations);

/// What a folder of an evolution holds: its generations, all but the last one without their records (read_generation
/// has them), and its head where that is written. Errors: as above.
EvolutionResult read_evolution_folder(const std::filesystem::path& folder);

/// Names in such a folder.
inline constexpr const char* kEvolutionIdentity = "evolution.id";
std::string generation_file(int number);
std::string contacts_file(int number);
/// Of one of the positions, from 0.
std::string simulation_file(int number, std::size_t position, std::size_t positions);

/// A line a generation: its number and its quantities.
std::string evolution_csv(const EvolutionResult& result);

}  // namespace treadmark::io
