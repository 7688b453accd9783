// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "treadmark/app/simulation/contact_tables.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/solvers/vehicle/simulation.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::app {

/// What belongs to a run of a simulation and not to the simulation itself.
struct SimulationOptions {
  std::vector<std::string> settings;  ///< echo of overrides
  std::vector<std::pair<std::string, std::string>> swept;
  /// Where unfinished results are kept, with what it takes to go on; what is there already is gone on from. Empty:
  /// nowhere. The file is removed by nobody here.
  std::filesystem::path checkpoint_file;
  std::filesystem::path table_file;   ///< history so far as text, written with every checkpoint; empty: none
  ContactTables* tables = nullptr;    ///< shared by runs; null: none are
  std::mutex* store_mutex = nullptr;  ///< held while files are written: the HDF5 library may not be thread-safe
  /// Called with warnings about the start (the message of the result) before the vehicle runs; empty: not called.
  std::function<void(const std::string&)> doubt = {};
};

/// Time of the computer that a simulation took; not part of its results.
struct SimulationTimes {
  double build_s = 0.0, tables_s = 0.0, equilibrium_s = 0.0, modes_s = 0.0, integration_s = 0.0;  ///< [s]
  bool shared = false;            ///< contacts were solved on several threads at a time: their times overlap
  wheelrail::PhaseTimes contact;  ///< of the wheels with full contact, in the integration
};

/// Runs a simulation from static equilibrium to its end, or until a wheel has parted from its rail: status "derailed".
/// A numerical failure on the way gives status "failed" and the history up to there, a stop request "interrupted"; of
/// both the checkpoint can be gone on from. Results are the same to the last bit for any number of threads,
/// interruptions and resumptions. Errors: Error(configuration), Error(input_data) for input that cannot be simulated at
/// all, and for a checkpoint of another simulation; Error(numerical) without an equilibrium. Cancelled
/// (core/cancellation.hpp) where the request comes before the first step.
io::SimulationResult run_simulation(const io::SimulationFile& file, SurfaceStore& store,
                                    const SimulationOptions& options, const Progress& progress,
                                    SimulationTimes* times = nullptr);

/// Throws Error(configuration) unless a file with results or a checkpoint comes from this build, these files and
/// settings.
void require_same_simulation(const std::filesystem::path& store, const io::SimulationCheckpoint& kept,
                             const io::SimulationFile& file, const std::vector<std::string>& settings);

/// Whether a finished result lies there. Errors: as require_same_simulation.
bool is_finished(const std::filesystem::path& store, const io::SimulationFile& file,
                 const std::vector<std::string>& settings);

/// Whether a checkpoint lies there that is to be gone on from: that of a failed run leads to the same failure. Errors:
/// Error(input_data).
bool goes_on(const std::filesystem::path& checkpoint, bool also_failed = false);

/// Vehicle, track and contacts in equilibrium, without integration: static values and modes.
io::SimulationResult static_results(const io::SimulationFile& file, SurfaceStore& store,
                                    const SimulationOptions& options);

/// Warnings about profiles of wheels and rails that are files; they are part of the message of results. Errors as
/// read_profile.
std::vector<std::string> simulation_doubts(const io::SimulationFile& file);

/// A warning about forces where energies since the start do not balance; empty: they do.
std::string energy_doubt(const vehicle::EnergyBalance& now, const vehicle::EnergyBalance& start);

}  // namespace treadmark::app
