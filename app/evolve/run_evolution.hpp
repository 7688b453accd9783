// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/histories/evolution_model.hpp"
#include "treadmark/io/simulations/evolution_model.hpp"

namespace treadmark::app {

struct EvolutionOptions {
  std::filesystem::path folder;
  bool must_exist = false;            ///< there must be an evolution in the folder
  std::vector<std::string> settings;  ///< echo of overrides
};

/// Evolves the surfaces of a file, or goes on where the folder says it was stopped: results are the same bytes for any
/// number of interruptions and threads. Every generation that stands is written at once (results keep the
/// records of the last one): its surfaces (.vdb), its
/// record (generation_0001.h5) and, if wanted, its contacts (contacts_0001.h5). Status "failed" where a contact cannot
/// be solved, "interrupted" at a stop request. Errors: those of the readers, of surfaces and of solvers for input that
/// makes no sense; Error(configuration) where the folder holds another evolution, or somebody else works in it.
io::EvolutionResult run_evolution(const io::EvolutionFile& file, const EvolutionOptions& options,
                                  const Progress& progress = {});

/// Reads and builds everything that the evolution needs, without solving. Errors: as above.
void check_evolution(const io::EvolutionFile& file);

/// evolution.json, evolution.csv and evolution.h5 into the folder, from its generations.
void write_evolution_folder(const std::filesystem::path& folder, const io::EvolutionResult& result);
/// What the points of the bodies have endured, for ParaView: FOLDER/vtk/wheel_0001.vts and rail_0001.vts of every
/// generation of the folder that has changed, and evolution.pvd, whose time is the distance [km] or, where no wheel
/// evolves, the passages. Errors: as above.
void write_evolution_vtk(const io::EvolutionFile& file, const std::filesystem::path& folder);
std::string evolution_json(const io::EvolutionResult& result);
/// For people: a line a generation.
std::string evolution_table(const io::EvolutionResult& result);

}  // namespace treadmark::app
