// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::io {

/// Writes a simulation to one HDF5 file in SI units: /history, /events, /static, /modes, /summary, /fields (the
/// snapshots, as write_hdf5 writes cases, without wall-clock times) and /checkpoint (left out where empty); the layout
/// is in docs/histories.md. Equal results give equal bytes. The file appears only when complete. Errors: as
/// check_simulation, and Error(configuration) for fields that do not match their grid and files that cannot be written.
/// Not to be called from two threads at once.
void write_simulation(const std::filesystem::path& path, const SimulationResult& result);

/// The simulation in a file, without its snapshots, their times and scenes. Errors: Error(input_data). Not to be called
/// from two threads at once.
SimulationResult read_simulation(const std::filesystem::path& path);

/// The same without the values of the history and the checkpoint, however long they are: what was run, how it ended,
/// names of the columns, events, static values, summary, modes. Errors and threads: as read_simulation.
SimulationResult read_simulation_head(const std::filesystem::path& path);

/// Contact fields at chosen instants: cases, version and sampled surfaces, with their times and flags as far as the
/// file has them. The grids of depths in their scenes are empty.
struct SnapshotSeries {
  RunResult run;
  std::vector<double> times;          ///< [s] one a case, or none
  std::vector<SnapshotScene> scenes;  ///< one a case, or none
};

/// The snapshots in the file of a simulation. Errors: Error(input_data), as read_hdf5. Not to be called from two
/// threads at once.
SnapshotSeries read_snapshots(const std::filesystem::path& path);

/// A checkpoint, and what must be the same for a simulation that goes on from it.
struct SimulationCheckpoint {
  std::string version, git, input_sha256;
  std::vector<std::string> settings;
  std::vector<std::pair<std::string, std::string>> geometry_sha256;
  std::vector<std::byte> bytes;  ///< empty: the file has none
};

/// Errors: Error(input_data). Not to be called from two threads at once.
SimulationCheckpoint read_checkpoint(const std::filesystem::path& path);

/// Names in the stores of simulations and studies that writer and reader share.
inline constexpr const char* kSimulationFormat = "treadmark simulation 1";
inline constexpr const char* kStudyFormat = "treadmark study 1";
inline constexpr const char* kNames = "names";  // attribute of a group: its datasets in their order
inline constexpr const char* kCheckpoint = "checkpoint";
inline constexpr const char* kFields = "fields";
inline constexpr const char* kTime = "time";  // attributes of a snapshot
inline constexpr const char* kNominal = "nominal";
inline constexpr const char* kDrawn = "drawn";

}  // namespace treadmark::io
