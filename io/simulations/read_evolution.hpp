// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/io/simulations/evolution_model.hpp"

namespace treadmark::io {

/// Reads a file with [evolve] (TOML, docs/evolve.md) with its base, a case or simulation file; the base is read once
/// for every position. overrides: "key.path=value", of the file ("evolve.distance_km=100") or of the base for all
/// positions. Throws Error(configuration) with file:line:column. Safe to call from several threads.
EvolutionFile read_evolution_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

}  // namespace treadmark::io
