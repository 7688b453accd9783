// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/grid.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/origin.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// Results of a simulation in time as plain data in SI units.

/// A quantity of a history.
struct HistoryColumn {
  std::string name;  ///< with its unit: "t_s", "x_m", "ws1_right.Q_N"
  std::string unit, description;
};

/// A wheel that loses or regains contact, or whose contact is chosen anew.
struct HistoryEvent {
  double time = 0.0, position = 0.0;  ///< [s], along the track [m]
  std::string wheel, kind;  ///< "contact lost", "contact regained", "full contact from here", "table from here"
};

/// A number that stands for a whole simulation.
struct NamedValue {
  std::string name;    ///< with its unit: "q_max_N"
  double value = 0.0;  ///< in the unit
  std::string unit, description;
};

/// A mode of the linearised system.
struct ModeRow {
  double frequency_Hz = 0.0, damping_ratio = 0.0;  ///< [Hz], of critical damping [-]
  std::string shape;                               ///< in words
};

/// What pictures show of a snapshot beside its fields. Stores have the flags of it only: a simulation finds it anew,
/// after a resumption too.
struct SnapshotScene {
  bool nominal = false;   ///< the instant at the start of the watched wheel
  bool drawn = false;     ///< of the watched wheel: a first passage of a pitch angle that was asked for, or a position
  Grid2 depth_grid = {};  ///< x, y of the track, x from the axle [m]
  std::vector<double> depth =
      {};                 ///< of the wheel's defect at its points [m], NaN = not known; empty: the wheel has none
  std::size_t wheel = 0;  ///< of the simulation, from 0; no store has it
};

/// A simulation, complete or not. It holds no wall-clock times, so that the results of an interrupted and resumed
/// simulation equal those of an undisturbed one.
struct SimulationResult : Origin {
  std::string status = "complete";  ///< "complete", "derailed", "interrupted" or "failed"
  std::string message;
  std::vector<HistoryColumn> columns;
  bool chosen = false;         ///< the columns were asked for by their names; no store has it
  std::vector<double> values;  ///< row by row: an instant a row, a value a column
  std::vector<HistoryEvent> events;
  std::vector<NamedValue> summary, statics;
  std::vector<ModeRow> modes;
  RunResult snapshots;                 ///< contact fields at chosen instants: a case each, with numbers of their own
  std::vector<double> snapshot_times;  ///< [s], one a case of the snapshots; may be empty
  std::vector<SnapshotScene> snapshot_scenes;              ///< one a case of the snapshots; may be empty
  std::vector<std::pair<std::string, std::string>> swept;  ///< (key, value) of the study that the simulation belongs to
  std::vector<std::byte> checkpoint;                       ///< from which it can go on; may be empty

  /// Whether there is no going on.
  bool ended() const { return status == "complete" || status == "derailed"; }
  /// Number of instants.
  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
};

/// Errors: Error(configuration) where names are empty, repeated or no names of a file's objects, where values are no
/// whole rows, snapshots and their times or scenes differ in number, or numbers of snapshots are repeated.
void check_simulation(const SimulationResult& result);

/// Index of the column of this name. Errors: Error(configuration) that names those there are.
std::size_t column_index(const SimulationResult& result, const std::string& name);

/// The values of a column, an instant each; index < columns.size().
std::vector<double> column_values(const SimulationResult& result, std::size_t index);

/// Tables with commas, a line of names first, in SI units; numbers are the shortest that read back exactly. The files
/// appear only when complete. Errors: Error(configuration) as check_simulation and for files that cannot be written.
/// Thread-safe.

/// The columns of the history, a line an instant.
void write_history_csv(const std::filesystem::path& path, const SimulationResult& result);

/// A line an event.
void write_events_csv(const std::filesystem::path& path, const SimulationResult& result);
/// A line a mode.
void write_modes_csv(const std::filesystem::path& path, const SimulationResult& result);

}  // namespace treadmark::io

namespace treadmark {

/// What is known of an event.
template <>
std::span<const Column<io::HistoryEvent>> columns();
/// What is known of a mode.
template <>
std::span<const Column<io::ModeRow>> columns();

}  // namespace treadmark
