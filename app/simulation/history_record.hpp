// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::app {

/// What is written down of a simulation at every instant: time and place, forces of the wheels (of those with full contact also what their
/// patches are like), motions of all bodies, energies. The first wheel with full contact, or else the first one, is the watched one:
/// its columns have no prefix.
class HistoryRecord {
 public:
  HistoryRecord(const BuiltVehicle& built, const vehicle::Simulation& simulation);

  std::vector<io::HistoryColumn> columns() const;
  /// Appends the present instant.
  void append(std::vector<double>& values) const;
  /// Number of the columns before the motions of the bodies: what a table in text holds.
  std::size_t leading_columns() const { return leading_; }
  std::size_t watched_wheel() const { return watched_; }

 private:
  struct Column {
    io::HistoryColumn head;
    std::function<double()> value;
  };
  void add(std::string name, std::string unit, std::string description, std::function<double()> value);
  void add_wheel(std::size_t wheel, const std::string& prefix, bool full);
  void add_bodies();
  void add_energies();

  const vehicle::Simulation& simulation_;
  std::vector<Column> columns_;
  std::size_t leading_ = 0, watched_ = 0;
};

/// Numbers that sum up a history: largest and least forces, where and when.
std::vector<io::NamedValue> summarise(const io::SimulationResult& result, const vehicle::Simulation& simulation, const std::string& prefix = "");

}  // namespace treadmark::app
